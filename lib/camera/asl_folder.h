#pragma once

/// \file
/// EuRoC/ASL folders (Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016):
/// cam0/data.csv with nanosecond stamps, cam0/data/*.png, cam0/sensor.yaml with intrinsics,
/// distortion and T_BS (camera in body), and the same for cam1, which may be absent.

#include <filesystem>

#include "camera/sequence.h"

namespace ringhook {

/// True if `folder` or its subfolder mav0 holds cam0/data.csv.
[[nodiscard]] bool isAslFolder(const std::filesystem::path& folder);

/// Frames whose stamp both cameras have; c2Mc1 = inverse(T_BS of cam1) T_BS of cam0. Throws
/// InputError, also for a distortion other than radial-tangential.
[[nodiscard]] Sequence openAslFolder(const std::filesystem::path& folder);

}  // namespace ringhook

#pragma once

/// \file
/// The readers and writers behind exchange.h, one pair a format. Readers throw InputError naming
/// file and key; what they return has not been through checkRig.

#include <array>
#include <string>

#include "calib/exchange/exchange.h"
#include "calib/exchange/lens_fit.h"

namespace ringhook::exchange {

using Files = std::vector<std::filesystem::path>;

StereoRig readOpenCv(const Files& files, const ImportHints& hints);
StereoRig readVisp(const Files& files, const ImportHints& hints);
StereoRig readRos(const Files& files, const ImportHints& hints);
StereoRig readKalibr(const Files& files, const ImportHints& hints);

RigExport writeOpenCv(const StereoRig& rig);
RigExport writeVisp(const StereoRig& rig);
RigExport writeRos(const StereoRig& rig);
RigExport writeKalibr(const StereoRig& rig);

/// Both lenses in the format's model; fills loss_px and a note for each lossy one.
std::array<CameraModel, 2> tellLenses(const StereoRig& rig, LensKind kind,
                                      const std::string& format, RigExport& written);

/// Numbers with nothing lost, separated by commas, row by row.
std::string listOf(const Eigen::MatrixXd& values);

/// Length of one unit of the files' numbers [m].
inline double unitOf(const ImportHints& hints) { return hints.unit_m.value_or(1.0); }

}  // namespace ringhook::exchange

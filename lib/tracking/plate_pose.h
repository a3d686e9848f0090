#pragma once

/// \file
/// Rough pose of a tag plate from its corners in one or two views, good enough to start the joint
/// refinement of the next stage. A planar target seen from afar has two poses that explain one view
/// almost equally well (Schweighofer and Pinz, "Robust pose estimation from a planar target", PAMI
/// 2006); both answers of the infinitesimal plane-based method (Collins and Bartoli, IJCV 2014) of
/// every tag in every view are refined over all corners in all views, and the residual decides.
/// Where it cannot decide, the pose nearest to the prediction is taken.

#include <optional>
#include <vector>

#include "core/hook_values.h"
#include "core/pose.h"

namespace ringhook {

/// Root mean square of the corner residuals per axis [px]; infinite if a corner lies behind.
double cornerRms(const std::vector<CameraFeatures>& cameras, const Pose& c1Mo);

/// Least-squares pose over all corners (Levenberg-Marquardt), from `c1Mo` on.
Pose refineOnCorners(const std::vector<CameraFeatures>& cameras, Pose c1Mo);

/// \param cameras corners in groups of four, one tag after the other, as tagCorners() orders them.
/// \return c1Mo; nothing if no candidate shows every tag's face to the cameras.
std::optional<Pose> startPose(const std::vector<CameraFeatures>& cameras,
                              const std::optional<Pose>& c1Mo_predicted);

}  // namespace ringhook

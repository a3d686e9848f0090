#pragma once

/// \file
/// Residuals, Jacobians and weights of the joint pose (see joint_pose.h), one row each. Corner rows
/// come first, in pairs u, v; edge rows follow.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/hook_values.h"
#include "stereo/joint_pose.h"

namespace ringhook {

struct ResidualRow {
  double r_px = 0.0;              ///< model minus seen [px]
  Eigen::Matrix<double, 1, 6> J;  ///< dr/dd at d = 0 [px/m, px/rad]
  double sigma_px = 1.0;          ///< standard deviation [px]
  double independence = 1.0;      ///< effective over real number of sites on its edge
  double weight = 1.0;            ///< robust, 0 to 1
};

struct ResidualRows {
  std::vector<ResidualRow> rows;
  std::size_t corner_rows = 0;
};

/// Rows without weights at a pose; false if a corner, or both ends of an edge, lie behind a camera.
/// `out` keeps its memory from call to call.
bool evaluateRows(const HookView& view, const Pose& c1Mo, ResidualRows& out);

/// Fills `independence` of the edge rows; needs evaluated rows.
void countSharedEdges(const HookView& view, double correlation, ResidualRows& rows);

/// Fills the robust weights from the residuals.
void weighRows(const JointPoseOptions& options, ResidualRows& rows);

}  // namespace ringhook

#pragma once

/// \file
/// The rotation between two directions.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ringhook {

/// The smallest rotation that turns the direction of `from` into that of `to`, both not zero and in
/// one frame; of opposite directions half a turn about some axis across them.
Eigen::Quaterniond shortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace ringhook

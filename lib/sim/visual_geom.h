#pragma once

/// \file
/// MJCF text of geoms that are only looked at: they touch nothing and weigh nothing. Positions and
/// directions are in the body that the text is put into.

#include <string>

#include "core/pose.h"

namespace ringhook {

/// \param half_size along the box's own axes [m]. \param colour "r g b 1", or empty for the
/// material's own.
std::string visualBox(const Pose& pose, const Eigen::Vector3d& half_size,
                      const std::string& material, const std::string& colour = {});
/// A box along the body's axes around `centre` [m].
std::string visualBox(const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
                      const std::string& material);
/// With round ends beyond `from` and `to`; radius [m].
std::string visualCapsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                          const std::string& material);
/// With flat ends at `from` and `to`; radius [m].
std::string visualCylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                           const std::string& material);

}  // namespace ringhook

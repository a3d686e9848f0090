#pragma once

/// \file
/// Pieces of MJCF text, numbers in full precision. Lengths [m], masses [kg].

#include <Eigen/Core>
#include <string>

#include "core/pose.h"

namespace ringhook {

/// ` name="v0 v1 ..."`
std::string attribute(const char* name, const Eigen::Ref<const Eigen::VectorXd>& values);
std::string attribute(const char* name, double value);

/// Attributes that place a body or geom in its parent.
std::string placing(const Pose& pose);

/// Mass, centre of mass and inertia about it [kg m^2], axes of the body.
std::string inertial(double mass, const Eigen::Vector3d& center, const Eigen::Matrix3d& inertia);

/// A box geom by its middle and half sizes; `more`: further attributes, each with a blank before
/// it.
std::string box(const Eigen::Vector3d& pos, const Eigen::Vector3d& half, const std::string& more);

/// A capsule geom.
std::string capsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                    const std::string& more);

}  // namespace ringhook

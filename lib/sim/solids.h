#pragma once

/// \file
/// What MuJoCo's model shows at one instant as a plain list of solids, and where each lies in a
/// pinhole's image plane. The list is the one thing that renderer and exposure need to know of the
/// world. Drawn are the geoms of groups 0 to 2; a geom's own colour replaces its material's.

#include <array>
#include <vector>

#include "core/image.h"
#include "core/pose.h"

struct mjModel_;
struct mjData_;

namespace ringhook {

/// Also the order of the renderer's meshes. The thinner a round thing, the fewer faces it needs:
/// a wire is a thin capsule; a slim cylinder and a rod are thinner cylinders.
enum class SolidShape { box, capsule, wire, cylinder, slimCylinder, rod };

struct Solid {
  SolidShape shape = SolidShape::box;
  Pose fMs = Pose::Identity();    ///< its own axes in f
  Eigen::Vector3d half;           ///< half extents; of a capsule's ball [m]
  double half_length = 0.0;       ///< a capsule's: from the middle to each ball's centre, on z [m]
  std::array<float, 3> colour{};  ///< red, green, blue, 0 to 1
  float specular = 0.0F;          ///< strength of highlights and mirrored lamps, 0 to 1
  float shininess = 0.0F;         ///< 0 broad to 1 narrow highlights
  int texture = -1;               ///< of the model, shown on both z sides; -1: none
  std::array<float, 2> repeat{1.0F, 1.0F};  ///< of the texture across the solid

  /// Half extents of the box around it, in its own axes [m].
  [[nodiscard]] Eigen::Vector3d reach() const {
    return half + Eigen::Vector3d(0.0, 0.0, half_length);
  }
  /// Wall or floor: behind everything, it hides no lamp.
  [[nodiscard]] bool isSheet() const { return (reach().array() > 1.0).count() >= 2; }
};

/// All solids of the model where `data` has them: its geoms' poses must be up to date. Two lists
/// of one model have the same solids at the same places.
void takeSolids(const mjModel_& model, const mjData_& data, std::vector<Solid>& solids);

/// A pinhole in space; its image plane is an endless grid of square pixels whose pixel (0, 0) has
/// its centre on the optical axis: x/z = i / f, y/z = j / f.
struct Pinhole {
  Pose fMc;               ///< camera in f: x right, y down, z forward
  double focal_px = 0.0;  ///< [px]
};

/// Part of the image plane.
struct PlaneBox {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  ///< [px]
};

/// Smallest PlaneBox that holds the solid's box; `limit` if that reaches behind the camera.
PlaneBox footprint(const Solid& solid, const Pinhole& eye, const PlaneBox& limit);

/// Longest way [px] that a corner of the solid's box goes from one list to the other.
double imageMotion(const Solid& from, const Solid& to, const Pinhole& eye);

}  // namespace ringhook

#include "sim/solids.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ringhook {
namespace {

constexpr double kNearest = 0.05;       // in front of a camera [m]
constexpr double kThin = 0.008;         // radius below which few faces will do [m]
constexpr double kSlim = 0.042;         // radius below which some faces will do [m]
constexpr double kEndlessPlane = 10.0;  // half side of a plane without a size [m]
constexpr int kDrawnGroups = 3;

using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Corners = std::array<Eigen::Vector3d, 8>;

Corners cornersInCamera(const Solid& solid, const Pose& cMf) {
  const Pose cMs = cMf * solid.fMs;
  const Eigen::Vector3d reach = solid.reach();
  Corners corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                               (i & 4U) != 0 ? 1 : -1);
    corners[i] = cMs * reach.cwiseProduct(sign).eval();
  }
  return corners;
}

void setShape(const mjModel& model, int geom, Solid& solid) {
  const mjtNum* size = model.geom_size + 3L * geom;
  const Eigen::Vector3d ball = Eigen::Vector3d::Constant(size[0]);
  switch (model.geom_type[geom]) {
    case mjGEOM_PLANE:
      solid.half = {size[0] > 0 ? size[0] : kEndlessPlane, size[1] > 0 ? size[1] : kEndlessPlane,
                    0.001};
      solid.fMs.translation() -= 0.001 * solid.fMs.linear().col(2);
      break;
    case mjGEOM_CAPSULE:
      solid.shape = size[0] < kThin ? SolidShape::wire : SolidShape::capsule;
      solid.half = ball;
      solid.half_length = size[1];
      break;
    case mjGEOM_SPHERE:
      solid.shape = size[0] < kThin ? SolidShape::wire : SolidShape::capsule;
      solid.half = ball;
      break;
    case mjGEOM_CYLINDER:
      solid.shape = size[0] < kThin   ? SolidShape::rod
                    : size[0] < kSlim ? SolidShape::slimCylinder
                                      : SolidShape::cylinder;
      solid.half = {size[0], size[0], size[1]};
      break;
    default:
      solid.half = {size[0], size[1], size[2]};
      break;
  }
}

void setLook(const mjModel& model, int geom, Solid& solid) {
  constexpr std::array<float, 4> kUnset{0.5F, 0.5F, 0.5F, 1.0F};
  const float* rgba = model.geom_rgba + 4L * geom;
  const int material = model.geom_matid[geom];
  if (material >= 0) {
    solid.specular = model.mat_specular[material];
    solid.shininess = model.mat_shininess[material];
    solid.texture = model.mat_texid[material];
    solid.repeat = {model.mat_texrepeat[2L * material], model.mat_texrepeat[2L * material + 1]};
    if (std::equal(kUnset.begin(), kUnset.end(), rgba)) {
      rgba = model.mat_rgba + 4L * material;
    }
  }
  std::copy_n(rgba, 3, solid.colour.begin());
}

}  // namespace

void takeSolids(const mjModel_& model, const mjData_& data, std::vector<Solid>& solids) {
  solids.clear();
  for (int g = 0; g < model.ngeom; ++g) {
    if (model.geom_group[g] >= kDrawnGroups) {
      continue;
    }
    Solid solid;
    solid.fMs.linear() = Eigen::Map<const RowMatrix>(data.geom_xmat + 9L * g);
    solid.fMs.translation() = Eigen::Map<const Eigen::Vector3d>(data.geom_xpos + 3L * g);
    setShape(model, g, solid);
    setLook(model, g, solid);
    solids.push_back(solid);
  }
}

PlaneBox footprint(const Solid& solid, const Pinhole& eye, const PlaneBox& limit) {
  const Corners corners = cornersInCamera(solid, eye.fMc.inverse());
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  PlaneBox box{kEndless, kEndless, -kEndless, -kEndless};
  for (const Eigen::Vector3d& corner : corners) {
    if (corner.z() < kNearest) {
      return limit;
    }
    const double x = eye.focal_px * corner.x() / corner.z();
    const double y = eye.focal_px * corner.y() / corner.z();
    box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
           std::max(box.bottom, y)};
  }
  return box;
}

double imageMotion(const Solid& from, const Solid& to, const Pinhole& eye) {
  const Pose cMf = eye.fMc.inverse();
  const Corners before = cornersInCamera(from, cMf);
  const Corners after = cornersInCamera(to, cMf);
  double longest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].z() < kNearest || after[i].z() < kNearest) {
      continue;
    }
    const Eigen::Vector2d way =
        after[i].head<2>() / after[i].z() - before[i].head<2>() / before[i].z();
    longest = std::max(longest, eye.focal_px * way.norm());
  }
  return longest;
}

}  // namespace ringhook

#include "sim/shadow_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double kSlice = 0.05;  // of a pyramid along its axis [m]
constexpr int kMargin = 6;       // bias along the normal, bilinear look-up, rounding [texels]

Eigen::Vector3d inBox(const ShadowBox& box, const Eigen::Vector3d& point_f) {
  return box.clip.topLeftCorner<3, 3>() * point_f + box.clip.topRightCorner<3, 1>();
}

/// Around the solid, in the map's coordinates.
Box around(const Solid& solid, const ShadowBox& box) {
  const Eigen::Vector3d middle = inBox(box, solid.fMs.translation());
  const Eigen::Matrix3d axes = box.clip.topLeftCorner<3, 3>() * solid.fMs.linear();
  const Eigen::Vector3d reach = axes.cwiseAbs() * solid.reach();
  return {middle - reach, middle + reach};
}

/// A slice of a part's pyramid, from one depth to another: its corners in f [m].
using Corners = Eigen::Matrix<double, 3, 8>;

Corners slice(const SeenPart& seen, double near, double far) {
  Corners corners_f;
  int i = 0;
  for (const double depth : {near, far}) {
    const double scale = depth / seen.eye.focal_px;
    for (const int u : {seen.part.x - 1, seen.part.x + seen.part.width}) {
      for (const int v : {seen.part.y - 1, seen.part.y + seen.part.height}) {
        corners_f.col(i++) = seen.eye.fMc * Eigen::Vector3d(scale * u, scale * v, depth);
      }
    }
  }
  return corners_f;
}

/// Around the corners, in coordinates that are linear in f.
Box around(const Corners& corners_f, const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift) {
  const Corners corners = (turn * corners_f).colwise() + shift;
  return {Eigen::Vector3d(corners.rowwise().minCoeff()),
          Eigen::Vector3d(corners.rowwise().maxCoeff())};
}

/// Adds what the part shows of the solid, slice by slice of its depth. A slice counts if it meets
/// the solid's own box, and then as far as it lies in the boxes around both in the map.
void addShown(const ShadowBox& box, const SeenPart& seen, const Solid& solid, Box& to) {
  const Box whole(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0));
  const Box body = around(solid, box).intersection(whole);
  if (body.isEmpty()) {
    return;
  }
  const Box own(-solid.reach(), solid.reach());
  const Pose sMf = solid.fMs.inverse(Eigen::Isometry);
  const Eigen::Vector3d axis_f = seen.eye.fMc.linear().col(2);
  const double middle = axis_f.dot(solid.fMs.translation() - seen.eye.fMc.translation());
  const double reach = (solid.fMs.linear().transpose() * axis_f).cwiseAbs().dot(solid.reach());
  for (double near = std::max(0.0, middle - reach); near < middle + reach; near += kSlice) {
    const Corners corners_f = slice(seen, near, std::min(near + kSlice, middle + reach));
    if (around(corners_f, sMf.linear(), sMf.translation()).intersects(own)) {
      const Box here =
          around(corners_f, box.clip.topLeftCorner<3, 3>(), box.clip.topRightCorner<3, 1>());
      if (here.intersects(body)) {
        to.extend(here.intersection(body));
      }
    }
  }
}

/// Texels that hold the box's x and y, with the margin, inside the map.
Window texelsOf(const Box& part, int side) {
  if (part.isEmpty()) {
    return {};
  }
  const auto texel = [side](double clip) { return 0.5 * (clip + 1.0) * side; };
  const int x = static_cast<int>(std::floor(texel(part.min().x()))) - kMargin;
  const int y = static_cast<int>(std::floor(texel(part.min().y()))) - kMargin;
  const int end_x = static_cast<int>(std::ceil(texel(part.max().x()))) + kMargin;
  const int end_y = static_cast<int>(std::ceil(texel(part.max().y()))) + kMargin;
  return intersect({x, y, end_x - x, end_y - y}, {0, 0, side, side});
}

}  // namespace

Window shadowTexels(const ShadowBox& box, const std::vector<Solid>& solids,
                    const std::vector<SeenPart>& seen) {
  Box shown;
  for (const SeenPart& part : seen) {
    if (!part.part.empty()) {
      for (const Solid& solid : solids) {
        addShown(box, part, solid, shown);
      }
    }
  }
  return texelsOf(shown, box.side);
}

bool throwsInto(const Solid& solid, const ShadowBox& box, const Window& texels) {
  return !intersect(texelsOf(around(solid, box), box.side), texels).empty();
}

}  // namespace ringhook

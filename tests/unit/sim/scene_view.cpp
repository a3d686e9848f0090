#include "scene_view.h"

#include <algorithm>

#include "core/error.h"
#include "sim/hook_shape.h"

namespace ringhook {

using Eigen::Vector2d;
using Eigen::Vector3d;

CellOptions hookInView(double start_y) {
  CellOptions options;
  options.belt.start_y = start_y;
  options.belt.entry_y = start_y;
  return options;
}

StereoFrame frameAt(CellWorld& world, StereoCamera& camera, double time_s) {
  world.advanceTo(Time::fromSeconds(time_s));
  std::optional<StereoFrame> newest;
  while (auto frame = camera.grab(0.0)) {
    newest = std::move(frame);
  }
  if (!newest) {
    throw Error("no frame arrived");
  }
  return *newest;
}

Vector2d projected(const CameraModel& camera, const Pose& cMa, const Vector3d& point_a) {
  const Vector3d p = cMa * point_a;
  return projectNormalised(camera, p.head<2>() / p.z());
}

std::vector<Vector3d> tagCornersOnPlate(const TagPlateFace& face, std::size_t place) {
  const double h = face.tag_size / 2.0;
  const double middle = 0.5 * (static_cast<double>(face.ids.size()) - 1.0);
  const double y = (static_cast<double>(place) - middle) * face.tag_distance;
  return {{-h, y - h, 0.0}, {h, y - h, 0.0}, {h, y + h, 0.0}, {-h, y + h, 0.0}};
}

std::vector<Vector3d> tagCorners(int id) {
  const HookShape shape;
  const TagPlateFace face{
      shape.plate_width, shape.plate_height, shape.tag_size, shape.tag_distance, {0, 1}};
  std::vector<Vector3d> corners = tagCornersOnPlate(face, static_cast<std::size_t>(id));
  for (Vector3d& corner : corners) {
    corner = shape.oMk() * corner;
  }
  return corners;
}

Window around(const Vector2d& point, int side) {
  const auto from = [side](double p) {
    return std::clamp(static_cast<int>(p) - side / 2, 0, 2048 - side);
  };
  return {from(point.x()), from(point.y()), side, side};
}

}  // namespace ringhook

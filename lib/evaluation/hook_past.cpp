#include "evaluation/hook_past.h"

#include <algorithm>
#include <iterator>

#include "sim/cell_world.h"
#include "sim/hook_shape.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

constexpr double kPeriod = 0.001;  // [s]
constexpr double kMemory = 1.0;    // [s]

/// Pixel of a point in the left camera; nothing if it is behind it.
std::optional<Eigen::Vector2d> pixelOf(const CameraModel& camera, const Eigen::Vector3d& point_c1) {
  if (point_c1.z() <= 0.0) {
    return std::nullopt;
  }
  return projectNormalised(camera, point_c1.head<2>() / point_c1.z());
}

}  // namespace

HookPast::HookPast(CellWorld& world, const StereoRig& true_rig) : rig_(true_rig) {
  world.every(kPeriod, 0.0, [this, &world](Time now) {
    const CellTruth cell = truth(world);
    Instant instant;
    instant.time = now;
    for (const HookTruth& hook : cell.hooks) {
      instant.c1Mo.push_back(rig_.fMc1->inverse() * hook.fMo);
    }
    past_.push_back(std::move(instant));
    while (now - past_.front().time > kMemory) {
      past_.pop_front();
    }
  });
}

std::optional<Pose> HookPast::c1Mo(const StereoFrame& frame) const {
  const auto after = std::find_if(past_.begin(), past_.end(),
                                  [&](const Instant& p) { return p.time >= frame.time; });
  if (after == past_.end() || (after == past_.begin() && after->time != frame.time)) {
    return std::nullopt;
  }
  const auto before = after == past_.begin() ? after : std::prev(after);
  const double step = after->time - before->time;
  const double fraction = step > 0.0 ? (frame.time - before->time) / step : 0.0;
  const Window& window = frame.left_window;
  const Eigen::Vector2d middle(window.x + 0.5 * (window.width - 1),
                               window.y + 0.5 * (window.height - 1));
  const Eigen::Vector3d plate_o = HookShape{}.oMk().translation();
  std::optional<Pose> nearest;
  double least = 0.0;
  for (std::size_t i = 0; i < after->c1Mo.size(); ++i) {
    const Pose pose = interpolate(before->c1Mo[i], after->c1Mo[i], fraction);
    const auto plate = pixelOf(rig_.left, pose * plate_o);
    const auto arc = pixelOf(rig_.left, pose.translation());
    const bool seen = (plate && window.contains(plate->x(), plate->y())) ||
                      (arc && window.contains(arc->x(), arc->y()));
    if (seen && plate && (!nearest || (*plate - middle).norm() < least)) {
      nearest = pose;
      least = (*plate - middle).norm();
    }
  }
  return nearest;
}

}  // namespace ringhook

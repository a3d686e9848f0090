#include "calib/wizard/place_plate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ringhook {
namespace {

constexpr double kMargin = 70.0;  // around the tags: their border, and what the rig is off [px]
constexpr int kSizeStep = 64;     // sizes are multiples of this [px]

int roundedUp(double size) { return kSizeStep * static_cast<int>(std::ceil(size / kSizeStep)); }

/// As large as asked for, as far in the middle as the image permits.
Window around(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Window& full) {
  const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2.0 * kMargin);
  const Eigen::Vector2d middle = 0.5 * (low + high);
  const int w = std::min(roundedUp(size.x()), full.width);
  const int h = std::min(roundedUp(size.y()), full.height);
  return {std::clamp(static_cast<int>(middle.x()) - w / 2, 0, full.width - w),
          std::clamp(static_cast<int>(middle.y()) - h / 2, 0, full.height - h), w, h};
}

}  // namespace

TagPlate plateInItsOwnFrame(TagPlate plate) {
  plate.oMk = Pose::Identity();
  return plate;
}

PlateWatch::PlateWatch(const StereoRig& rig, const TagPlate& plate)
    : plate_(plateInItsOwnFrame(plate)),
      rectifier_(rig),
      tracker_(plate_),
      full_{0, 0, rig.left.width, rig.left.height},
      windows_{full_, full_} {}

Outcome<HookView> PlateWatch::see(const StereoFrame& frame) {
  Outcome<HookView> view = tracker_.track(rectifier_.rectify(frame), std::nullopt);
  if (view && view->cameras.size() != 2) {
    return Refusal{"not in both images"};
  }
  return view;
}

void PlateWatch::watchOver(const std::vector<Pose>& c1Mo) {
  for (int side = 0; side < 2; ++side) {
    const PinholeView camera = rectifier_.view(side);
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low;
    for (const Pose& pose : c1Mo) {
      for (const PlateTag& tag : plate_.tags) {
        for (const Eigen::Vector3d& corner : tagCorners(plate_, tag)) {
          if (const auto pixel = camera.project(pose * corner)) {
            const Eigen::Vector2d raw = rectifier_.distortPoint(side, *pixel);
            low = low.cwiseMin(raw);
            high = high.cwiseMax(raw);
          }
        }
      }
    }
    const bool any = (low.array() <= high.array()).all();
    windows_[static_cast<std::size_t>(side)] = any ? around(low, high, full_) : full_;
  }
}

}  // namespace ringhook

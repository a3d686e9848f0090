#include "calib/wizard/place_plate.h"

#include <algorithm>
#include <cmath>

namespace ringhook {
namespace {

constexpr double kMargin = 70.0;  // around the tags: their border, and motion until it acts [px]
constexpr int kSizeStep = 64;     // sizes are multiples of this [px]
constexpr int kMostMisses = 20;   // then the whole images are read again

int roundedUp(double size) { return kSizeStep * static_cast<int>(std::ceil(size / kSizeStep)); }

/// As large as asked for, as far in the middle as the image permits.
Window centred(const Eigen::Vector2d& middle, int width, int height, const Window& full) {
  const int w = std::min(width, full.width);
  const int h = std::min(height, full.height);
  return {std::clamp(static_cast<int>(middle.x()) - w / 2, 0, full.width - w),
          std::clamp(static_cast<int>(middle.y()) - h / 2, 0, full.height - h), w, h};
}

}  // namespace

TagPlate plateInItsOwnFrame(TagPlate plate) {
  plate.oMk = Pose::Identity();
  return plate;
}

PlateWatch::PlateWatch(const StereoRig& rig, const TagPlate& plate)
    : rectifier_(rig),
      tracker_(plateInItsOwnFrame(plate)),
      full_{0, 0, rig.left.width, rig.left.height},
      windows_{full_, full_} {}

void PlateWatch::restart() {
  windows_ = {full_, full_};
  misses_ = 0;
}

Outcome<HookView> PlateWatch::see(const StereoFrame& frame) {
  Outcome<HookView> view = tracker_.track(rectifier_.rectify(frame), std::nullopt);
  if (view && view->cameras.size() == 2) {
    misses_ = 0;
    follow(*view);
    return view;
  }
  if (++misses_ > kMostMisses) {
    restart();
  }
  return view ? Outcome<HookView>(Refusal{"not in both images"}) : view;
}

void PlateWatch::follow(const HookView& view) {
  for (int side = 0; side < 2; ++side) {
    const auto index = static_cast<std::size_t>(side);
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    for (const CornerFeature& corner : view.cameras[index].corners) {
      const Eigen::Vector2d raw = rectifier_.distortPoint(side, corner.pixel);
      low = low.cwiseMin(raw);
      high = high.cwiseMax(raw);
    }
    const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2.0 * kMargin);
    const bool sized = windows_[index] != full_;
    windows_[index] = centred(
        0.5 * (low + high), std::max(roundedUp(size.x()), sized ? windows_[index].width : 0),
        std::max(roundedUp(size.y()), sized ? windows_[index].height : 0), full_);
  }
}

}  // namespace ringhook

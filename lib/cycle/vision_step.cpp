#include "cycle/vision_step.h"

#include <algorithm>
#include <utility>

#include "cycle/belt_geometry.h"
#include "cycle/hook_sight.h"
#include "prediction/search_window.h"
#include "stereo/joint_pose.h"

namespace ringhook {
namespace {

constexpr double kPivotTolerance = 0.06;  // [m]; a wrong detection is off by decimetres
constexpr double kEntrance = 0.10;        // [m]; before and after the search travels
constexpr double kErrorHorizon = 0.1;     // [s]; of the prediction error that is reported
constexpr double kLongestInterval = 0.2;  // [s]; further ahead windows would only grow

HookFilterOptions filterOptions(const CellConfig& cell, const Pose& fMc1) {
  HookFilterOptions options;
  options.fMc1 = fMc1;
  options.pivot_o = cell.hook.pivot_o;
  options.pendulum_length_m = cell.hook.pendulum_length_m;
  options.warm_up_s = cell.vision.warm_up_s;
  options.belt_direction_f = cell.belt.direction_f;
  return options;
}

}  // namespace

double expectedInterval(const std::optional<double>& last_s, double rate_hz) {
  const double period_s = 1.0 / rate_hz;
  return std::clamp(last_s.value_or(period_s), period_s, std::max(period_s, kLongestInterval));
}

VisionStep::VisionStep(const CellConfig& cell, const StereoRig& rig, TrackerKind tracker)
    : cell_(cell),
      fMc1_(requireRobotCamera(rig, cell.rig)),
      rectifier_(rig),
      sight_(makeHookSight(cell, fMc1_, tracker)),
      filter_(filterOptions(cell, fMc1_)) {
  const Pose c1Mf = fMc1_.inverse();
  for (int side = 0; side < 2; ++side) {
    Window rectified;
    for (const Pose& fMo : searchPoses(cell_)) {
      rectified = unite(rectified, searchWindow(rectifier_.view(side), c1Mf * fMo,
                                                Covariance6::Zero(), sight_.outline_o, {}));
    }
    search_windows_[side] = rectifier_.rawWindow(side, rectified);
  }
  windows_ = search_windows_;
}

VisionReport VisionStep::process(const StereoFrame& frame) {
  VisionReport report;
  report.time = frame.time;
  const bool searched = state_ == VisionState::kSearching;
  const Outcome<HookFix> fix = see(frame);
  if (fix) {
    take(*fix, report);
  } else {
    miss(fix.reason(), report);
  }
  const bool rate_changed = searched != (state_ == VisionState::kSearching);
  const auto last_s = last_frame_ ? std::optional(frame.time - *last_frame_) : std::nullopt;
  frame_interval_s_ = expectedInterval(rate_changed ? std::nullopt : last_s, rateHz());
  last_frame_ = frame.time;
  planWindows(frame.time);
  report.state = state_;
  return report;
}

Outcome<HookFix> VisionStep::see(const StereoFrame& frame) {
  const RectifiedFrame rectified = rectifier_.rectify(frame);
  std::optional<Pose> expected = predicted(frame.time);
  if (!expected && sight_.find) {
    const Outcome<Pose> found = sight_.find(rectified);
    if (!found) {
      return Refusal{found.reason()};
    }
    expected = *found;
  }
  const Outcome<HookView> view = sight_.tracker->track(rectified, expected);
  if (!view) {
    return Refusal{view.reason()};
  }
  const Outcome<HookFix> fix = fixFromView(*view);
  if (!fix) {
    return fix;
  }
  const Pose fMo = fMc1_ * fix->c1Mo;
  if (state_ == VisionState::kSearching && !comesIn(cell_, fMo, kEntrance)) {
    return Refusal{"not a hook that comes in"};
  }
  const std::string objection = whyNotOnBelt(cell_, fMo, kPivotTolerance);
  return objection.empty() ? fix : Outcome<HookFix>(Refusal{objection});
}

std::optional<Pose> VisionStep::predicted(Time time) const {
  const Outcome<HookEstimate> estimate = filter_.predict(time);
  if (!estimate) {
    return std::nullopt;
  }
  return fMc1_.inverse() * estimate->fMo;
}

void VisionStep::take(const HookFix& fix, VisionReport& report) {
  const Outcome<FilterUpdate> update = filter_.update(fix);
  if (!update) {
    miss(update.reason(), report);
    return;
  }
  report.fix = fix;
  report.nis = update->nis;
  misses_ = 0;
  state_ = filter_.ready() ? VisionState::kTracking : VisionState::kWarmingUp;
  compareWithPast(fix, report);
}

void VisionStep::miss(const std::string& reason, VisionReport& report) {
  report.reason = reason;
  if (state_ == VisionState::kSearching) {
    return;
  }
  ++misses_;
  if (misses_ >= cell_.vision.lost_after_frames || filter_.lost()) {
    restart();
  }
}

void VisionStep::compareWithPast(const HookFix& fix, VisionReport& report) {
  while (past_.size() > 1 && fix.time - past_[1].time >= kErrorHorizon) {
    past_.pop_front();
  }
  // Half a frame of tolerance: the horizon need not be a multiple of the frame period.
  const double tolerance = 0.5 / cell_.vision.rate_hz;
  if (!past_.empty() && std::abs(fix.time - past_.front().time - kErrorHorizon) < tolerance) {
    const Outcome<HookEstimate> then = predictHook(past_.front(), fix.time);
    if (then) {
      const Eigen::Vector3d seen = (fMc1_ * fix.c1Mo).translation();
      report.error_100ms_m = (then->fMo.translation() - seen).norm();
    }
  }
  if (const std::optional<HookFilterState> now = filter_.state(); now && now->ready) {
    past_.push_back(*now);
  }
}

void VisionStep::restart() {
  filter_.restart();
  past_.clear();
  misses_ = 0;
  last_frame_.reset();
  state_ = VisionState::kSearching;
  windows_ = search_windows_;
}

std::optional<HookFilterState> VisionStep::estimate() const {
  return state_ == VisionState::kSearching ? std::nullopt : filter_.state();
}

double VisionStep::rateHz() const {
  return state_ == VisionState::kSearching ? cell_.vision.search_rate_hz : cell_.vision.rate_hz;
}

std::optional<Window> VisionStep::windowAt(Time exposure, int side) const {
  const Outcome<HookEstimate> hook = filter_.predict(exposure);
  if (!hook) {
    return std::nullopt;
  }
  SearchWindowOptions options;
  options.margin_px = sight_.margin_px;
  const Window rectified = searchWindow(rectifier_.view(side), fMc1_.inverse() * hook->fMo,
                                        hook->covariance, sight_.outline_o, options);
  return rectifier_.rawWindow(side, rectified);
}

/// The hook at every exposure that these windows may act on: a camera in real time takes them up
/// some exposures later.
void VisionStep::planWindows(Time now) {
  for (int side = 0; side < 2; ++side) {
    Window raw;
    for (int lag = 1; lag <= cell_.vision.window_lag_frames; ++lag) {
      raw = unite(raw, windowAt(now + lag * frame_interval_s_, side).value_or(Window{}));
    }
    const bool known = state_ != VisionState::kSearching && !raw.empty();
    windows_[side] = known ? raw : search_windows_[side];
  }
}

}  // namespace ringhook

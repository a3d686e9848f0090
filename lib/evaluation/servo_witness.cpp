#include "evaluation/servo_witness.h"

#include <algorithm>
#include <utility>

#include "robot/rx60/kinematics.h"

namespace ringhook {
namespace {

constexpr double kHangTime = 2.0;      // [s] after the release, when physics is asked
constexpr std::size_t kPastMax = 100;  // arm periods that are remembered

}  // namespace

ServoWitness::ServoWitness(const CellWorld& world, const Pose& fMc1, const rx60::Geometry& arm,
                           const Eigen::Vector3d& release_o,
                           std::function<void(const AttemptTruth&)> on_judged)
    : world_(world),
      fMc1_(fMc1),
      arm_(arm),
      release_o_(release_o),
      on_judged_(std::move(on_judged)),
      limits_(rx60::limits()) {}

void ServoWitness::startAttempt(OpenRecording open_recording) {
  open_recording_ = std::move(open_recording);
  attempt_ = {};
  released_at_.reset();
  judged_ = false;
}

void ServoWitness::endAttempt() {
  open_recording_ = nullptr;
  if (recording_) {
    recording_->close();
    recording_.reset();
  }
}

void ServoWitness::onFrame(const StereoFrame& frame, const VisionReport& report, double age_s) {
  countFrame(report, age_s, statistics_);
  if (report.fix) {
    seen_fMo_ = fMc1_ * report.fix->c1Mo;
  }
  const std::optional<Pose> fMo = trueHook(frame.time, seen_fMo_);
  if (report.fix && fMo) {
    statistics_.fix_error_m.add((seen_fMo_.translation() - fMo->translation()).norm());
  }
  const bool begin = report.state == VisionState::kTracking && report.fix;
  if (open_recording_ && report.state != VisionState::kSearching && (recording_ || begin)) {
    recordFrame(frame, fMo);
  }
}

void ServoWitness::recordFrame(const StereoFrame& frame, const std::optional<Pose>& fMo) {
  if (!recording_) {
    recording_ = open_recording_(fMc1_.inverse() * seen_fMo_);
  }
  recording_->addFrame(frame);
  if (fMo) {
    recording_->addTruth(frame.time, fMc1_.inverse() * *fMo);
  }
}

std::optional<Pose> ServoWitness::trueHook(Time time, const Pose& near_fMo) const {
  const auto after = std::find_if(past_.begin(), past_.end(),
                                  [time](const HookInstant& p) { return p.time >= time; });
  if (after == past_.end() || (after == past_.begin() && after->time != time)) {
    return std::nullopt;
  }
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < after->fMo.size(); ++i) {
    const auto distance = [&](std::size_t k) {
      return (after->fMo[k].translation() - near_fMo.translation()).norm();
    };
    nearest = distance(i) < distance(nearest) ? i : nearest;
  }
  if (after->time == time) {
    return after->fMo[nearest];
  }
  const auto before = std::prev(after);
  return interpolate(before->fMo[nearest], after->fMo[nearest],
                     (time - before->time) / (after->time - before->time));
}

void ServoWitness::onCommand(const ArmState& state, const TaskCommand& command) {
  const CellTruth cell = truth(world_);
  HookInstant instant;
  instant.time = cell.time;
  for (const HookTruth& hook : cell.hooks) {
    instant.fMo.push_back(hook.fMo);
  }
  past_.push_back(std::move(instant));
  if (past_.size() > kPastMax) {
    past_.pop_front();
  }
  if (recording_) {
    recording_->addRobot(state.time, state.position, rx60::forward(arm_, state.position));
  }
  countCommand(state, command, limits_, statistics_);
  if (command.phase == TaskPhase::kLower) {
    const Eigen::Vector3d ring_f = cell.fMr.translation();
    double nearest = 1e9;
    for (const HookTruth& hook : cell.hooks) {
      const Eigen::Vector3d ring_o = hook.fMo.inverse() * ring_f;
      nearest = std::min(nearest, (ring_o - release_o_).head<2>().norm());
    }
    attempt_.insertion_error_m.add(nearest);
  }
  if (command.close_gripper && !*command.close_gripper) {
    released_at_ = state.time;
  }
  judge(state.time, cell);
}

void ServoWitness::judge(Time now, const CellTruth& cell) {
  if (cell.held_ring >= 0 && !released_at_) {
    attempt_.ring = cell.held_ring;
    attempt_.peak_contact_n = cell.rings[cell.held_ring].peak_force_in_grip;
  }
  if (judged_ || !released_at_ || attempt_.ring < 0 || now - *released_at_ < kHangTime) {
    return;
  }
  judged_ = true;
  attempt_.hanging = cell.rings[attempt_.ring].hanging;
  on_judged_(attempt_);
}

}  // namespace ringhook

#include "cycle/task_control.h"

#include <array>

#include "cycle/back_off.h"
#include "cycle/belt_geometry.h"
#include "cycle/task_paths.h"

namespace ringhook {
namespace {

// What says nothing against the hook, and may be over when it is tried again.
constexpr const char* kStale = "hook's estimate stale";
constexpr const char* kOffPath = "ring off its path while lowering";
constexpr int kMostTries = 2;

}  // namespace

const char* phaseName(TaskPhase phase) {
  static constexpr std::array kNames = {"load",  "grip",    "standby", "wait",  "approach", "align",
                                        "lower", "release", "retreat", "watch", "back off", "done"};
  return kNames.at(static_cast<std::size_t>(phase));
}

TaskControl::TaskControl(const CellConfig& cell, const rx60::Geometry& arm)
    : cell_(cell), path_parameters_(pathParameters(cell)), motion_(cell, arm) {}

void TaskControl::startAttempt() {
  result_ = {};
  fresh_ = true;
  hook_.reset();
  hook_seen_ = false;
  phase_ = ring_held_ ? TaskPhase::kStandby : TaskPhase::kLoad;
}

bool TaskControl::hookDone() const {
  return phase_ == TaskPhase::kWatch || phase_ == TaskPhase::kDone;
}

TaskCommand TaskControl::step(const ArmState& state, const std::optional<HookFilterState>& hook) {
  if (fresh_) {
    fresh_ = false;
    result_.started = phase_start_ = state.time;
  }
  hook_seen_ = hook.has_value();
  if (hook) {
    hook_ = hook;
  }
  TaskCommand command;
  const TaskPhase phase = phase_;
  switch (phase) {
    case TaskPhase::kLoad:
      command = coarse(state, cell_.arm.load_rad, TaskPhase::kGrip);
      break;
    case TaskPhase::kGrip:
      command = grip(state);
      break;
    case TaskPhase::kStandby:
      command = coarse(state, cell_.arm.standby_rad, TaskPhase::kWait);
      break;
    case TaskPhase::kWait:
      command = wait(state);
      break;
    case TaskPhase::kBackOff:
      command = backOff(state);
      break;
    case TaskPhase::kWatch:
    case TaskPhase::kDone:
      command = resting(state);
      break;
    default:
      command = follow(state);
  }
  command.phase = phase;
  command.close_gripper = gripper_order_;
  gripper_order_.reset();
  result_.ended = state.time;
  return command;
}

TaskCommand TaskControl::coarse(const ArmState& state, const JointVector& target, TaskPhase next) {
  const Outcome<JointVector> velocity = motion_.moveTo(state, target);
  TaskCommand command;
  if (!velocity) {
    abort(velocity.reason(), state);
    command.velocity = motion_.rest(state);
    return command;
  }
  command.velocity = *velocity;
  if (motion_.arrived(state)) {
    enter(next, state);
  }
  return command;
}

TaskCommand TaskControl::grip(const ArmState& state) {
  if (!ring_held_) {
    gripper_order_ = ring_held_ = true;
  }
  if (state.time - phase_start_ >= cell_.arm.gripper_time_s) {
    enter(TaskPhase::kStandby, state);
  }
  TaskCommand command;
  command.velocity = motion_.rest(state);
  return command;
}

TaskCommand TaskControl::wait(const ArmState& state) {
  TaskCommand command;
  command.velocity = motion_.rest(state);
  if (result_.tries > 0 && !hook_seen_) {
    abort("hook lost", state);
  } else if (hook_seen_ && hook_->ready && !stale(state)) {
    if (const Outcome<HookEstimate> now = predictHook(*hook_, state.time)) {
      meet(*now, state);
    }
  } else if (state.time - phase_start_ > cell_.task.hook_timeout_s) {
    abort("no hook came", state);
  }
  return command;
}

/// Begins the approach once the hook is in the window, unless it will leave too soon.
void TaskControl::meet(const HookEstimate& hook, const ArmState& state) {
  const double travel = hookTravel(cell_, hook.fMo);
  const double speed = hookTravelSpeed(cell_, hook);
  if (travel + std::abs(speed) * insertionTime(cell_, path_parameters_) > cell_.belt.pick_to_m) {
    abort("hook came too late for the arm's window", state);
  } else if (travel >= cell_.belt.pick_from_m) {
    ++result_.tries;
    result_.abort_reason.clear();
    result_.met = result_.met.value_or(state.time);
    const Pose oMr = hook.fMo.inverse() * motion_.ringPose(state.position);
    enterPath(TaskPhase::kApproach, InsertionPhase::kApproach, oMr, state);
  }
}

TaskCommand TaskControl::follow(const ArmState& state) {
  const std::string objection = whyNotFollow(state);
  const Outcome<FollowCommand> followed =
      objection.empty()
          ? motion_.follow(state, *hook_, samplePath(path_, state.time - phase_start_))
          : Outcome<FollowCommand>(Refusal{objection});
  TaskCommand command;
  if (!followed) {
    if (phase_ == TaskPhase::kRelease || phase_ == TaskPhase::kRetreat) {
      enter(TaskPhase::kWatch, state);
    } else {
      abort(followed.reason(), state);
    }
    command.velocity = motion_.rest(state);
    return command;
  }
  command.velocity = followed->velocity;
  command.error_m = followed->error.translation_m;
  command.limited = followed->limited;
  advance(state, followed->error.translation_m);
  return command;
}

void TaskControl::advance(const ArmState& state, double error_m) {
  const bool path_done = state.time - phase_start_ >= pathDuration(path_);
  // The next path starts where the last one ended, not where the ring is: a path that starts at
  // the ring would take the tracking error with it.
  const Pose oMr = path_.back().oMr_end;
  switch (phase_) {
    case TaskPhase::kApproach:
      if (path_done) {
        enterPath(TaskPhase::kAlign, InsertionPhase::kAlign, oMr, state);
      }
      break;
    case TaskPhase::kAlign:
      advanceFromAlign(state, error_m);
      break;
    case TaskPhase::kLower:
      result_.tracking_error_m.add(error_m);
      if (error_m > cell_.task.abort_tolerance_m) {
        abort(kOffPath, state);
      } else if (path_done) {
        gripper_order_ = ring_held_ = false;
        result_.released = true;
        result_.released_at = state.time;
        enterPath(TaskPhase::kRelease, InsertionPhase::kHold, oMr, state);
      }
      break;
    case TaskPhase::kRelease:
      if (path_done) {
        enterPath(TaskPhase::kRetreat, InsertionPhase::kRetreat, oMr, state);
      }
      break;
    default:
      if (path_done) {
        enter(TaskPhase::kWatch, state);
      }
  }
}

void TaskControl::advanceFromAlign(const ArmState& state, double error_m) {
  const double since = state.time - phase_start_ - pathDuration(path_);
  if (since < 0.0 || error_m > cell_.task.align_tolerance_m) {
    aligned_since_.reset();
  } else if (!aligned_since_) {
    aligned_since_ = state.time;
  }
  if (aligned_since_ && state.time - *aligned_since_ >= cell_.task.align_dwell_s) {
    enterPath(TaskPhase::kLower, InsertionPhase::kLower, path_.back().oMr_end, state);
  } else if (since > cell_.task.align_timeout_s) {
    abort("ring could not be aligned in time", state);
  }
}

TaskCommand TaskControl::backOff(const ArmState& state) {
  TaskCommand command;
  const double s = state.time - phase_start_;
  if (!path_.empty() && s < pathDuration(path_) && hook_) {
    const Outcome<FollowCommand> followed = motion_.follow(state, *hook_, samplePath(path_, s));
    if (followed) {
      command.velocity = followed->velocity;
      command.error_m = followed->error.translation_m;
      command.limited = followed->limited;
      return command;
    }
  }
  command.velocity = motion_.rest(state);
  if (command.velocity.isZero()) {
    const bool again = may_try_again_ && hook_seen_ && !stale(state);
    enter(again ? TaskPhase::kWait : TaskPhase::kDone, state);
  }
  return command;
}

TaskCommand TaskControl::resting(const ArmState& state) {
  TaskCommand command;
  command.velocity = motion_.rest(state);
  if (phase_ == TaskPhase::kWatch &&
      (!result_.released_at || state.time - *result_.released_at >= cell_.task.watch_s)) {
    enter(TaskPhase::kDone, state);
  }
  return command;
}

void TaskControl::enter(TaskPhase phase, const ArmState& state) {
  phase_ = phase;
  phase_start_ = state.time;
  aligned_since_.reset();
}

void TaskControl::enterPath(TaskPhase phase, InsertionPhase path, const Pose& oMr,
                            const ArmState& state) {
  path_ = planPhase(path, oMr, path_parameters_);
  enter(phase, state);
}

void TaskControl::abort(const std::string& reason, const ArmState& state) {
  const bool waits_again = phase_ == TaskPhase::kWait && result_.tries > 0;
  result_.abort_reason = waits_again ? result_.abort_reason : reason;
  result_.released = false;
  const bool near_hook = phase_ >= TaskPhase::kApproach && phase_ <= TaskPhase::kLower;
  const bool may_pass = near_hook && (reason == kStale || reason == kOffPath);
  may_try_again_ = may_pass && result_.tries < kMostTries;
  const std::optional<Pose> fMo = near_hook ? hookNow(state) : std::nullopt;
  path_.clear();
  if (fMo) {
    path_ = planBackOff(fMo->inverse() * motion_.ringPose(state.position), path_parameters_);
  }
  enter(TaskPhase::kBackOff, state);
}

std::string TaskControl::whyNotFollow(const ArmState& state) const {
  // The ring that is let go bumps the hook, and a filter that gates well then loses it. The gripper
  // opens and leaves by the last estimate, for as long as that can be predicted.
  if (phase_ == TaskPhase::kRelease || phase_ == TaskPhase::kRetreat) {
    return {};
  }
  if (!hook_seen_) {
    return "hook lost";
  }
  if (stale(state)) {
    return kStale;
  }
  const std::optional<Pose> fMo = hookNow(state);
  const bool inserting = phase_ == TaskPhase::kApproach || phase_ == TaskPhase::kAlign;
  const bool left = fMo && inserting && hookTravel(cell_, *fMo) > cell_.belt.pick_to_m;
  return left ? "hook left the arm's window" : "";
}

bool TaskControl::stale(const ArmState& state) const {
  return state.time - hook_->time > cell_.vision.stale_after_s;
}

std::optional<Pose> TaskControl::hookNow(const ArmState& state) const {
  if (!hook_) {
    return std::nullopt;
  }
  const Outcome<HookEstimate> now = predictHook(*hook_, state.time);
  return now ? std::optional<Pose>(now->fMo) : std::nullopt;
}

}  // namespace ringhook

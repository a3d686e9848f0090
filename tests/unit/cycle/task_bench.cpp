#include "task_bench.h"

#include <algorithm>
#include <cmath>

#include "robot/rx60/kinematics.h"

namespace ringhook::test {
namespace {

constexpr long kStepsPerFrame = 5;  // 50 Hz of frames on 250 Hz of arm states
constexpr long kLongest = 15000;    // steps: a minute
constexpr double kRounding = 1e-9;

Pose camera() {
  Eigen::Matrix3d R;
  R << 0, 0, -1, 1, 0, 0, 0, -1, 0;  // looks along -x of f, rows down
  Pose fMc1 = Pose::Identity();
  fMc1.linear() = R;
  fMc1.translation() << 1.75, -0.2, 0.7;
  return fMc1;
}

HookFilterOptions filterOptions(const CellConfig& cell) {
  HookFilterOptions options;
  options.fMc1 = camera();
  options.pivot_o = cell.hook.pivot_o;
  options.pendulum_length_m = cell.hook.pendulum_length_m;
  options.warm_up_s = cell.vision.warm_up_s;
  return options;
}

}  // namespace

TaskBench::TaskBench(const CellConfig& the_cell, const MovingHook& the_hook)
    : cell(the_cell),
      hook(the_hook),
      task(the_cell, rx60::rx60()),
      fMc1_(camera()),
      filter_(filterOptions(cell)) {
  state_.position = cell.arm.load_rad;
  state_.velocity.setZero();
  state_.motion_possible = true;
  task.startAttempt();
}

void TaskBench::step(Sight sight) {
  observe(sight);
  const TaskCommand command =
      task.step(state_, sight == Sight::kNothing ? std::nullopt : estimate_);
  check(command.velocity);
  note(command);
  state_.position += kArmPeriod * command.velocity;
  state_.velocity = command.velocity;
  state_.time = state_.time + kArmPeriod;
  ++step_count_;
}

void TaskBench::observe(Sight sight) {
  if (sight == Sight::kFresh && step_count_ % kStepsPerFrame == 0) {
    if (!filter_.update(hook.fix(cell, fMc1_, state_.time))) {
      ++refused_fixes;
    }
    estimate_ = filter_.state();
  }
}

void TaskBench::check(const JointVector& velocity) {
  const JointLimits limits = rx60::limits();
  const JointVector next = state_.position + kArmPeriod * velocity;
  const JointVector acceleration = (velocity - state_.velocity) / kArmPeriod;
  const auto broke = [&](const char* what) {
    broken_limits.push_back(std::string(what) + " at t = " + std::to_string(seconds()));
  };
  if (!velocity.allFinite() || (velocity.cwiseAbs() - limits.velocity).maxCoeff() > kRounding) {
    broke("speed");
  }
  if ((acceleration.cwiseAbs() - limits.acceleration).maxCoeff() > kRounding / kArmPeriod) {
    broke("acceleration");
  }
  if ((limits.lower - next).maxCoeff() > kRounding ||
      (next - limits.upper).maxCoeff() > kRounding) {
    broke("position");
  }
  ++commands;
}

void TaskBench::note(const TaskCommand& command) {
  if (phases.empty() || phases.back() != command.phase) {
    phases.push_back(command.phase);
  }
  if (command.close_gripper) {
    orders.push_back({*command.close_gripper, command.phase, ring_o()});
  }
  if (command.phase == TaskPhase::kRelease) {
    worst_hold_m = std::max(worst_hold_m, (ring_o().translation() - cell.task.release_o).norm());
  }
}

bool TaskBench::runTo(TaskPhase phase, Sight sight) {
  for (long i = 0; i < kLongest && !task.finished() && task.phase() != phase; ++i) {
    step(sight);
  }
  return task.phase() == phase;
}

bool TaskBench::finish(Sight sight) { return runTo(TaskPhase::kDone, sight); }

Pose TaskBench::ring_o() const {
  const Pose fMr = rx60::forward(rx60::rx60(), state_.position) * cell.arm.eMr;
  return hook.at(cell, state_.time).inverse() * fMr;
}

}  // namespace ringhook::test

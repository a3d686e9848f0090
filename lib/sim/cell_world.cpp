#include "sim/cell_world.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "sim/cell_state.h"
#include "sim/mujoco_handles.h"

namespace ringhook {
namespace {

/// A periodic action: call number n happens at anchor + n * period.
struct Periodic {
  double anchor_s = 0.0;
  double period_s = 0.0;
  long long count = 0;  ///< calls done or skipped since the anchor
  std::function<void(Time)> action;

  [[nodiscard]] long long nextStep(double step) const {
    return std::llround((anchor_s + static_cast<double>(count) * period_s) / step);
  }
};

void requirePositive(double period_s) {
  if (!(period_s > 0.0) || !std::isfinite(period_s)) {
    throw Error("The simulated cell was asked for a period of " + std::to_string(period_s) +
                " s; it must be positive.");
  }
}

}  // namespace

struct CellWorld::Impl {
  explicit Impl(const CellOptions& options) : cell(makeCellState(options)) {}

  [[nodiscard]] Time now() const {
    const auto step_ns = std::llround(cell.options.physics_step * 1e9);
    return Time::fromNanoseconds(cell.steps * step_ns);
  }

  /// Calls what is due at this very step; actions registered meanwhile start later.
  void callActions() {
    const std::size_t count = periodic.size();
    for (std::size_t i = 0; i < count; ++i) {
      while (periodic[i].nextStep(cell.options.physics_step) < cell.steps) {
        ++periodic[i].count;
      }
      if (periodic[i].nextStep(cell.options.physics_step) == cell.steps) {
        ++periodic[i].count;
        const auto action = periodic[i].action;
        action(now());
      }
    }
  }

  CellState cell;
  std::vector<Periodic> periodic;
  bool advancing = false;
};

CellWorld::CellWorld(const CellOptions& options) : impl_(std::make_unique<Impl>(options)) {}
CellWorld::~CellWorld() = default;

const CellOptions& CellWorld::options() const { return impl_->cell.options; }
Time CellWorld::time() const { return impl_->now(); }

void CellWorld::advanceTo(Time time) {
  if (std::exchange(impl_->advancing, true)) {
    throw Error("The simulated cell cannot be advanced from inside one of its own callbacks.");
  }
  try {
    if (impl_->cell.steps == 0) {
      impl_->callActions();
    }
    while (impl_->now() < time) {
      stepCell(impl_->cell);
      impl_->callActions();
    }
  } catch (...) {
    impl_->advancing = false;
    throw;
  }
  impl_->advancing = false;
}

int CellWorld::every(double period_s, double phase_s, std::function<void(Time)> action) {
  requirePositive(period_s);
  Periodic periodic{phase_s, period_s, 0, std::move(action)};
  const double step = options().physics_step;
  const bool started = impl_->cell.steps > 0;
  while (periodic.nextStep(step) < impl_->cell.steps + (started ? 1 : 0)) {
    ++periodic.count;
  }
  impl_->periodic.push_back(std::move(periodic));
  return static_cast<int>(impl_->periodic.size()) - 1;
}

void CellWorld::setPeriod(int id, double period_s) {
  requirePositive(period_s);
  Periodic& periodic = impl_->periodic.at(static_cast<std::size_t>(id));
  if (periodic.count > 0) {
    periodic.anchor_s += static_cast<double>(periodic.count - 1) * periodic.period_s;
    periodic.count = 1;
  }
  periodic.period_s = period_s;
}

void CellWorld::setJointVelocity(const JointVector& joint_velocity, double duration_s) {
  impl_->cell.velocity = joint_velocity;
  impl_->cell.command_ends = impl_->cell.steps + std::llround(duration_s / options().physics_step);
}

JointVector CellWorld::jointReading() const {
  JointVector reading;
  for (int i = 0; i < 6; ++i) {
    reading[i] = impl_->cell.data->qpos[impl_->cell.arm_qpos[i]] - impl_->cell.draw.zero_error[i];
  }
  return reading;
}

void CellWorld::setGripper(bool closed) {
  if (closed) {
    closeGripper(impl_->cell);
  } else {
    openGripper(impl_->cell);
  }
}

bool CellWorld::gripperClosed() const { return impl_->cell.gripper_closed; }

void CellWorld::holdBoard(const std::optional<Pose>& fMt) { placeBoard(impl_->cell, fMt); }

MujocoHandles mujocoHandles(const CellWorld& world) {
  return {world.impl_->cell.model.get(), world.impl_->cell.data.get()};
}

const CellState& cellState(const CellWorld& world) { return world.impl_->cell; }

}  // namespace ringhook

#include "sim/drives.h"

#include <algorithm>

#include "robot/rx60/kinematics.h"
#include "sim/cell_state.h"

namespace ringhook {
namespace {

/// Acceleration that takes a joint from its state to `goal` in one step.
double deadBeat(double position, double velocity, double goal, double step) {
  return ((goal - position) / step - velocity) / step;
}

void moveSetPoints(CellState& cell) {
  const double step = cell.options.physics_step;
  static const JointLimits limits = rx60::limits();
  if (cell.steps >= cell.command_ends) {
    cell.velocity.setZero();
  }
  cell.set_point =
      (cell.set_point + step * cell.velocity).cwiseMax(limits.lower).cwiseMin(limits.upper);
  const double next_s = static_cast<double>(cell.steps + 1) * step;
  cell.belt_set_point = beltTravel(cell.draw.belt, next_s);
}

}  // namespace

void driveMotions(CellState& cell) {
  const mjModel* m = cell.model.get();
  mjData* d = cell.data.get();
  const double step = cell.options.physics_step;
  moveSetPoints(cell);
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(m->nv);
  for (int i = 0; i < 6; ++i) {
    acceleration[cell.arm_dof[i]] = deadBeat(d->qpos[cell.arm_qpos[i]], d->qvel[cell.arm_dof[i]],
                                             cell.set_point[i] + cell.draw.zero_error[i], step);
  }
  acceleration[cell.belt_dof] =
      deadBeat(d->qpos[cell.belt_qpos], d->qvel[cell.belt_dof], cell.belt_set_point, step);
  Eigen::VectorXd force(m->nv);
  mj_mulM(m, d, force.data(), acceleration.data());
  const auto apply = [&](int dof) {
    d->qfrc_applied[dof] = force[dof] + d->qfrc_bias[dof] - d->qfrc_passive[dof];
  };
  std::for_each(std::begin(cell.arm_dof), std::end(cell.arm_dof), apply);
  apply(cell.belt_dof);
}

}  // namespace ringhook

#include "sim/leapfrog.h"

#include "sim/cell_state.h"

namespace ringhook {

void beginLeap(CellState& cell) {
  for (HookSlot& hook : cell.hooks) {
    for (int axis = 0; axis < 2; ++axis) {
      mjtNum& rate = cell.data->qvel[hook.dof[axis]];
      if (!hook.swinging || hook.unstaggered) {
        hook.staggered_rate[axis] = rate;
      }
      rate = hook.staggered_rate[axis];
    }
  }
}

void endLeap(CellState& cell) {
  const double step = cell.options.physics_step;
  for (HookSlot& hook : cell.hooks) {
    for (int axis = 0; axis < 2; ++axis) {
      mjtNum& rate = cell.data->qvel[hook.dof[axis]];
      const double half_kick = 0.5 * (rate - hook.staggered_rate[axis]);
      if (hook.unstaggered) {
        rate -= half_kick;
        cell.data->qpos[hook.qpos[axis]] -= step * half_kick;
      }
      hook.staggered_rate[axis] = rate;
      rate += half_kick;
    }
    hook.unstaggered = false;
  }
}

}  // namespace ringhook

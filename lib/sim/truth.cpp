#include "sim/truth.h"

#include "sim/cell_model.h"
#include "sim/cell_state.h"
#include "sim/cell_world.h"
#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kFloorClearance = 0.10;
constexpr double kSlow = 0.3;

HookTruth hookTruth(const CellState& cell, std::size_t index) {
  const HookSlot& slot = cell.hooks[index];
  HookTruth hook;
  hook.fMo = bodyPose(cell, slot.body);
  hook.twist_f = bodyTwist(cell, slot.body);
  hook.swing_about_x = cell.data->qpos[slot.qpos[0]];
  hook.swing_about_y = cell.data->qpos[slot.qpos[1]];
  hook.fMp = Pose::Identity();
  hook.fMp.translation() = hook.fMo * hookPivot(cell.draw.hooks[index].pivot_height);
  hook.swinging = slot.swinging;
  return hook;
}

int linkedHook(const std::vector<HookTruth>& hooks, const Pose& fMr, double radius) {
  for (std::size_t i = 0; i < hooks.size(); ++i) {
    const Pose rMo = fMr.inverse() * hooks[i].fMo;
    std::vector<Eigen::Vector3d> line = hookCentreline();
    for (Eigen::Vector3d& point : line) {
      point = rMo * point;
    }
    if (crossings(line, radius) % 2 != 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

/// Speed of the ring's centre as seen from the hook.
double relativeSpeed(const RingTruth& ring, const HookTruth& hook) {
  const Eigen::Vector3d arm = ring.fMr.translation() - hook.fMo.translation();
  const Eigen::Vector3d carried = hook.twist_f.head<3>() + hook.twist_f.tail<3>().cross(arm);
  return (ring.twist_f.head<3>() - carried).norm();
}

RingTruth ringTruth(const CellState& cell, const RingSlot& slot,
                    const std::vector<HookTruth>& hooks) {
  RingTruth ring;
  ring.fMr = bodyPose(cell, slot.body);
  ring.twist_f = bodyTwist(cell, slot.body);
  ring.in_magazine = slot.place == RingPlace::magazine;
  ring.held = slot.place == RingPlace::gripper;
  ring.hook_force = slot.hook_force;
  ring.peak_force_in_grip = slot.peak_force_in_grip;
  ring.hook_impulse = slot.hook_impulse;
  ring.gripper_impulse = slot.gripper_impulse;
  ring.touching_gripper = slot.gripper_force > 0.0;
  ring.linked_hook = linkedHook(hooks, ring.fMr, cell.options.ring.radius());
  if (ring.linked_hook >= 0) {
    ring.speed_on_hook = relativeSpeed(ring, hooks[static_cast<std::size_t>(ring.linked_hook)]);
  }
  ring.hanging = ring.linked_hook >= 0 && slot.place == RingPlace::loose &&
                 !ring.touching_gripper && ring.fMr.translation().z() > kFloorClearance &&
                 ring.speed_on_hook < kSlow;
  return ring;
}

ContactTruth contactTruth(const CellState& cell, const ContactSlot& slot) {
  ContactTruth contact;
  contact.body_a = mj_id2name(cell.model.get(), mjOBJ_BODY, slot.body[0]);
  contact.body_b = mj_id2name(cell.model.get(), mjOBJ_BODY, slot.body[1]);
  contact.point_f = slot.point_f;
  contact.normal_f = slot.normal_f;
  contact.normal_force = slot.normal_force;
  contact.friction_force = slot.friction_force;
  return contact;
}

void addMachines(const CellState& cell, CellTruth& all) {
  all.belt_travel = cell.data->qpos[cell.belt_qpos];
  all.belt_speed = cell.data->qvel[cell.belt_dof];
  for (int i = 0; i < 6; ++i) {
    all.joints[i] = cell.data->qpos[cell.arm_qpos[i]];
  }
  all.reported_joints = all.joints - cell.draw.zero_error;
  all.fMe = bodyPose(cell, cell.flange_body);
  all.fMr = all.fMe * gripPose(cell.options);
  all.gripper_closed = cell.gripper_closed;
  all.held_ring = cell.held_ring;
  all.grip_force = cell.grip_force;
}

}  // namespace

CellTruth truth(const CellWorld& world) {
  const CellState& cell = cellState(world);
  CellTruth all;
  all.time = world.time();
  for (std::size_t i = 0; i < cell.hooks.size(); ++i) {
    all.hooks.push_back(hookTruth(cell, i));
  }
  for (const RingSlot& slot : cell.rings) {
    all.rings.push_back(ringTruth(cell, slot, all.hooks));
  }
  for (const ContactSlot& slot : cell.contacts) {
    all.contacts.push_back(contactTruth(cell, slot));
  }
  addMachines(cell, all);
  return all;
}

int crossings(const std::vector<Eigen::Vector3d>& line_r, double radius) {
  int count = 0;
  for (std::size_t i = 1; i < line_r.size(); ++i) {
    const Eigen::Vector3d& from = line_r[i - 1];
    const Eigen::Vector3d& to = line_r[i];
    if ((from.z() < 0.0) == (to.z() < 0.0)) {
      continue;
    }
    const Eigen::Vector3d at = from + (to - from) * (from.z() / (from.z() - to.z()));
    if (at.head<2>().norm() < radius) {
      count += to.z() < 0.0 ? -1 : 1;
    }
  }
  return count;
}

}  // namespace ringhook

#include "sim/cell_state.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "sim/cell_forces.h"
#include "sim/cell_model.h"
#include "sim/drives.h"
#include "sim/leapfrog.h"

namespace ringhook {
namespace {

constexpr double kAwayZ = -5.0;  // of a board that nobody holds: below the floor [m]

std::string numbered(const char* stem, int number) {
  return std::string(stem).append(std::to_string(number));
}

void require(bool good, const char* sentence) {
  if (!good) {
    throw InputError(std::string("The cell is impossible: ") + sentence);
  }
}

void checkOptions(const CellOptions& o) {
  require(o.physics_step >= 1e-5 && o.physics_step <= 1e-3,
          "physics_step must be between 0.00001 and 0.001 s.");
  require(o.hook.count >= 1 && o.hook.count <= 100, "hook.count must be between 1 and 100.");
  require(o.ring.count >= 1 && o.ring.count <= 100, "ring.count must be between 1 and 100.");
  require(o.ring.segments >= 24, "ring.segments must be at least 24.");
  require(o.ring.clearance > 0.0 && o.ring.clearance < 0.05,
          "ring.clearance must be between 0 and 0.05 m.");
  require(o.hook.spacing >= 0.2, "hook.spacing must be at least 0.2 m.");
  require(o.hook.swing_least >= 0.0 && o.hook.swing_least <= 1.0,
          "hook.swing_least must be between 0 and 1.");
  require(o.belt.acceleration > 0.0 && o.belt.jerk > 0.0 && o.belt.pitch > 0.0,
          "belt.acceleration, jerk and pitch must be positive.");
  double ripple = 0.0;
  for (const double fraction : o.belt.ripple) {
    ripple += std::abs(fraction);
  }
  require(ripple < 1.0, "belt.ripple must sum up to less than 1.");
}

void indexGeoms(CellState& cell) {
  const mjModel& m = *cell.model;
  cell.owner.assign(static_cast<std::size_t>(m.ngeom), GeomOwner::none);
  cell.ring_of_geom.assign(static_cast<std::size_t>(m.ngeom), -1);
  for (int g = 0; g < m.ngeom; ++g) {
    const auto slot = static_cast<std::size_t>(g);
    const std::string body = mj_id2name(&m, mjOBJ_BODY, m.geom_bodyid[g]);
    if (body.starts_with("hook")) {
      cell.owner[slot] = GeomOwner::hook;
    } else if (body.starts_with("link") || body.starts_with("jaw")) {
      cell.owner[slot] = GeomOwner::tool;
    } else if (body.starts_with("ring")) {
      cell.owner[slot] = GeomOwner::ring;
      cell.ring_of_geom[slot] = std::stoi(body.substr(4));
    }
  }
}

void indexModel(CellState& cell) {
  const mjModel& m = *cell.model;
  const auto qpos = [&](const std::string& joint) {
    return m.jnt_qposadr[findObject(m, mjOBJ_JOINT, joint)];
  };
  const auto dof = [&](const std::string& joint) {
    return m.jnt_dofadr[findObject(m, mjOBJ_JOINT, joint)];
  };
  for (int i = 0; i < 6; ++i) {
    const std::string joint = numbered("j", i + 1);
    cell.arm_qpos[i] = qpos(joint);
    cell.arm_dof[i] = dof(joint);
  }
  cell.belt_qpos = qpos("belt");
  cell.belt_dof = dof("belt");
  cell.flange_body = findObject(m, mjOBJ_BODY, "link6");
  for (int i = 0; i < cell.options.hook.count; ++i) {
    const std::string name = numbered("hook", i);
    cell.hooks.push_back({findObject(m, mjOBJ_BODY, name),
                          {qpos(name + "_x"), qpos(name + "_y")},
                          {dof(name + "_x"), dof(name + "_y")}});
  }
  for (int i = 0; i < cell.options.ring.count; ++i) {
    const std::string name = numbered("ring", i);
    RingSlot slot;
    slot.body = findObject(m, mjOBJ_BODY, name);
    slot.qpos = qpos(name);
    slot.dof = dof(name);
    slot.grip = findObject(m, mjOBJ_EQUALITY, numbered("grip", i));
    cell.rings.push_back(slot);
  }
  indexGeoms(cell);
}

void placeRing(CellState& cell, const RingSlot& ring, const Pose& fMr, const Twist& twist_f) {
  mjtNum* q = cell.data->qpos + ring.qpos;
  const Eigen::Quaterniond rotation(fMr.linear());
  const double values[7] = {fMr.translation().x(), fMr.translation().y(), fMr.translation().z(),
                            rotation.w(),          rotation.x(),          rotation.y(),
                            rotation.z()};
  mju_copy(q, values, 7);
  // A free joint's velocity: linear in f, angular in the body.
  Twist velocity = twist_f;
  velocity.tail<3>() = fMr.linear().transpose() * twist_f.tail<3>();
  mju_copy(cell.data->qvel + ring.dof, velocity.data(), 6);
}

double jawAngle(const CellState& cell) {
  return cell.gripper_closed ? 0.0 : cell.options.gripper.opening_angle;
}

/// Hooks upstream of the entry hang still; there they are set swinging.
void holdHooks(CellState& cell) {
  for (std::size_t i = 0; i < cell.hooks.size(); ++i) {
    HookSlot& hook = cell.hooks[i];
    if (hook.swinging) {
      continue;
    }
    const double y = cell.options.belt.start_y -
                     static_cast<double>(i) * cell.options.hook.spacing + cell.belt_set_point;
    hook.swinging = y >= cell.options.belt.entry_y - 1e-9;
    hook.unstaggered = hook.swinging;
    for (int axis = 0; axis < 2; ++axis) {
      cell.data->qpos[hook.qpos[axis]] = hook.swinging ? cell.draw.hooks[i].angle[axis] : 0.0;
      cell.data->qvel[hook.dof[axis]] = hook.swinging ? cell.draw.hooks[i].rate[axis] : 0.0;
    }
  }
}

void holdMagazine(CellState& cell) {
  for (std::size_t i = 0; i < cell.rings.size(); ++i) {
    if (cell.rings[i].place == RingPlace::magazine) {
      placeRing(cell, cell.rings[i], magazinePose(static_cast<int>(i)), Twist::Zero());
    }
  }
}

/// Brings everything that depends on positions and velocities up to date.
void refresh(CellState& cell) { mj_step1(cell.model.get(), cell.data.get()); }

bool hookNear(const CellState& cell, const Eigen::Vector3d& point_f) {
  for (const HookSlot& hook : cell.hooks) {
    const double distance = (bodyPose(cell, hook.body).translation() - point_f).norm();
    if (distance < cell.options.gripper.feeder_clearance) {
      return true;
    }
  }
  return false;
}

}  // namespace

CellState makeCellState(const CellOptions& options) {
  checkOptions(options);
  CellState cell;
  cell.options = options;
  cell.draw = drawCell(options);
  cell.model = loadModel(cellModelXml(options, cell.draw));
  cell.data = makeData(*cell.model);
  indexModel(cell);
  cell.set_point = options.arm.initial_joints;
  for (int i = 0; i < 6; ++i) {
    cell.data->qpos[cell.arm_qpos[i]] = cell.set_point[i] + cell.draw.zero_error[i];
  }
  cell.data->qvel[cell.belt_dof] = beltSpeed(cell.draw.belt, 0.0);
  for (const char* jaw : {"upper", "lower"}) {
    const int joint = findObject(*cell.model, mjOBJ_JOINT, jaw);
    cell.data->qpos[cell.model->jnt_qposadr[joint]] = options.gripper.opening_angle;
  }
  holdHooks(cell);
  holdMagazine(cell);
  refresh(cell);
  return cell;
}

void stepCell(CellState& cell) {
  mjModel* m = cell.model.get();
  mjData* d = cell.data.get();
  driveMotions(cell);
  d->ctrl[0] = d->ctrl[1] = jawAngle(cell);
  beginLeap(cell);
  mj_step2(m, d);
  endLeap(cell);
  ++cell.steps;
  recordForces(cell);
  holdHooks(cell);
  holdMagazine(cell);
  refresh(cell);
  checkHealth(*d);
}

void openGripper(CellState& cell) {
  cell.gripper_closed = false;
  if (cell.held_ring >= 0) {
    RingSlot& ring = cell.rings[static_cast<std::size_t>(cell.held_ring)];
    cell.model->eq_active[ring.grip] = 0;
    ring.place = RingPlace::loose;
    cell.held_ring = -1;
    refresh(cell);
  }
}

void closeGripper(CellState& cell) {
  if (cell.gripper_closed) {
    return;
  }
  cell.gripper_closed = true;
  const Pose fMr = bodyPose(cell, cell.flange_body) * gripPose(cell.options);
  if (hookNear(cell, fMr.translation())) {
    return;
  }
  for (std::size_t i = 0; i < cell.rings.size(); ++i) {
    RingSlot& ring = cell.rings[i];
    if (ring.place != RingPlace::magazine) {
      continue;
    }
    Twist twist_f = bodyTwist(cell, cell.flange_body);
    const Eigen::Vector3d arm = fMr.translation() - bodyPose(cell, cell.flange_body).translation();
    twist_f.head<3>() += twist_f.tail<3>().cross(arm);
    placeRing(cell, ring, fMr, twist_f);
    ring.place = RingPlace::gripper;
    cell.model->eq_active[ring.grip] = 1;
    cell.held_ring = static_cast<int>(i);
    refresh(cell);
    return;
  }
}

void placeBoard(CellState& cell, const std::optional<Pose>& fMt) {
  const mjModel& m = *cell.model;
  const int body = mj_name2id(&m, mjOBJ_BODY, "board");
  if (body < 0) {
    throw Error("The simulated cell has no calibration board to hold.");
  }
  const Pose where = fMt.value_or(Pose(Eigen::Translation3d(0.0, 0.0, kAwayZ)));
  if (!where.matrix().allFinite()) {
    throw Error("The calibration board cannot be held at a pose that is not finite.");
  }
  const Eigen::Quaterniond q(where.linear());
  const double rotation[4] = {q.w(), q.x(), q.y(), q.z()};
  mju_copy(cell.data->mocap_pos + 3L * m.body_mocapid[body], where.translation().data(), 3);
  mju_copy(cell.data->mocap_quat + 4L * m.body_mocapid[body], rotation, 4);
  refresh(cell);
}

Pose bodyPose(const CellState& cell, int body) {
  using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Map<const RowMatrix>(cell.data->xmat + 9L * body);
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(cell.data->xpos + 3L * body);
  return pose;
}

Twist bodyTwist(const CellState& cell, int body) {
  mjtNum rotation_first[6];
  mj_objectVelocity(cell.model.get(), cell.data.get(), mjOBJ_XBODY, body, rotation_first, 0);
  Twist twist_f;
  twist_f << Eigen::Map<const Eigen::Vector3d>(rotation_first + 3),
      Eigen::Map<const Eigen::Vector3d>(rotation_first);
  return twist_f;
}

}  // namespace ringhook

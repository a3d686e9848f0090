#pragma once

/// \file
/// The inside of the simulated world: MuJoCo's model and data, where everything is in them, and the
/// bookkeeping that MuJoCo does not do (who holds which ring, which hook swings yet, forces seen).
/// Includes MuJoCo: for .cpp files of sim only.

#include <optional>
#include <vector>

#include "core/pose.h"
#include "sim/cell_draw.h"
#include "sim/mujoco_model.h"

namespace ringhook {

class CellWorld;

enum class RingPlace { magazine, gripper, loose };

struct HookSlot {
  int body = 0;
  int qpos[2] = {0, 0};               ///< of the swing about x_f, y_f
  int dof[2] = {0, 0};                ///< likewise
  bool swinging = false;              ///< past the entry
  bool unstaggered = false;           ///< set swinging at this very instant: see leapfrog.h
  double staggered_rate[2] = {0, 0};  ///< swing rates half a step ago [rad/s]
};

struct RingSlot {
  int body = 0;
  int qpos = 0;  ///< first of seven
  int dof = 0;   ///< first of six
  int grip = 0;  ///< weld to the flange
  RingPlace place = RingPlace::magazine;
  double hook_force = 0.0;          ///< sum of normal contact forces with hooks, last step [N]
  double peak_force_in_grip = 0.0;  ///< largest of those while gripped [N]
  double gripper_force = 0.0;       ///< sum of normal contact forces with the tool, last step [N]
  double hook_impulse = 0.0;        ///< time integral of hook_force since time zero [N s]
  double gripper_impulse = 0.0;     ///< likewise of gripper_force [N s]
};

/// A contact that pressed during the last step.
struct ContactSlot {
  int body[2] = {0, 0};
  Eigen::Vector3d point_f;      ///< [m]
  Eigen::Vector3d normal_f;     ///< unit, from body[0] to body[1]
  double normal_force = 0.0;    ///< [N]
  double friction_force = 0.0;  ///< along the surface [N]
};

enum class GeomOwner { none, hook, tool, ring };

struct CellState {
  CellOptions options;
  CellDraw draw;
  ModelPtr model;
  DataPtr data;
  std::vector<HookSlot> hooks;
  std::vector<RingSlot> rings;
  std::vector<GeomOwner> owner;       ///< of each geom
  std::vector<int> ring_of_geom;      ///< index of the ring, or -1
  std::vector<ContactSlot> contacts;  ///< of the last step
  int arm_dof[6] = {};                ///< also their qpos on this model: see makeCellState
  int arm_qpos[6] = {};
  int belt_dof = 0;
  int belt_qpos = 0;
  int flange_body = 0;
  long long steps = 0;                         ///< physics steps done
  JointVector set_point;                       ///< nominal joints [rad]
  JointVector velocity = JointVector::Zero();  ///< commanded [rad/s]
  long long command_ends = 0;                  ///< step at which the command ends
  double belt_set_point = 0.0;                 ///< travel since time zero [m]
  bool gripper_closed = false;
  int held_ring = -1;
  double grip_force = 0.0;  ///< of the weld on the held ring, last step [N]
};

/// The cell at time zero. Throws Error naming the option that makes it impossible.
CellState makeCellState(const CellOptions& options);

/// One physics step; afterwards all positions and velocities are those of the new instant.
void stepCell(CellState& cell);

void openGripper(CellState& cell);
void closeGripper(CellState& cell);

/// See CellWorld::holdBoard.
void placeBoard(CellState& cell, const std::optional<Pose>& fMt);

/// Pose of a body's frame in f.
Pose bodyPose(const CellState& cell, int body);
/// Velocity of a body's frame origin, expressed in f.
Twist bodyTwist(const CellState& cell, int body);

/// The world's inside, for sim/truth.cpp.
const CellState& cellState(const CellWorld& world);

}  // namespace ringhook

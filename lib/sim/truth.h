#ifndef RINGHOOK_TRUTH_ALLOWED
#error \
    "sim/truth.h is the simulated cell's ground truth: link ringhook::truth (tests, evaluation, app)"
#endif
#pragma once

/// \file
/// What is really the case in the simulated cell. Only tests, evaluation and app may know: the
/// macro above comes with the target ringhook::truth, which the loop's stages do not link.

#include <string>
#include <vector>

#include "core/joints.h"
#include "core/pose.h"
#include "core/time.h"

namespace ringhook {

class CellWorld;

struct HookTruth {
  Pose fMo;                    ///< hook in f
  Twist twist_f;               ///< of the hook at o, expressed in f [m/s, rad/s]
  double swing_about_x = 0.0;  ///< first hinge, axis x_f; 0 hanging [rad]
  double swing_about_y = 0.0;  ///< second hinge, axis y after the first; 0 hanging [rad]
  Pose fMp;                    ///< pivot; moves with the belt, always parallel to f
  bool swinging = false;       ///< false upstream of the entry, where the hook hangs locked
};

struct RingTruth {
  Pose fMr;                         ///< ring in f
  Twist twist_f;                    ///< of the ring at r, expressed in f [m/s, rad/s]
  bool in_magazine = false;         ///< still waiting in the feeder
  bool held = false;                ///< gripped
  int linked_hook = -1;             ///< hook whose bar passes through the ring's disk, or -1
  double hook_force = 0.0;          ///< normal contact forces with hooks, now, summed [N]
  double peak_force_in_grip = 0.0;  ///< the largest hook_force while it was gripped [N]
  double hook_impulse = 0.0;        ///< time integral of hook_force since time zero [N s]
  double gripper_impulse = 0.0;     ///< likewise of the forces with jaws, palm or arm [N s]
  bool touching_gripper = false;    ///< contact with jaws, palm or arm
  double speed_on_hook = 0.0;       ///< of the ring's centre relative to the linked hook [m/s]
  bool hanging = false;             ///< linked, loose, clear of the gripper, above the floor and
                                    ///< slower than 0.3 m/s relative to its hook
};

/// A contact that pressed during the last physics step.
struct ContactTruth {
  std::string body_a;           ///< a body of sim/cell_model.h; world is the floor
  std::string body_b;           ///< likewise
  Eigen::Vector3d point_f;      ///< where [m]
  Eigen::Vector3d normal_f;     ///< unit, from a to b
  double normal_force = 0.0;    ///< [N]
  double friction_force = 0.0;  ///< along the surface [N]
};

struct CellTruth {
  Time time;
  std::vector<HookTruth> hooks;  ///< most downstream first
  std::vector<RingTruth> rings;
  std::vector<ContactTruth> contacts;
  double belt_travel = 0.0;     ///< since time zero, along +y_f [m]
  double belt_speed = 0.0;      ///< [m/s]
  JointVector joints;           ///< as they really stand [rad]
  JointVector reported_joints;  ///< as the encoders say, off by the zero errors [rad]
  bool gripper_closed = false;
  Pose fMe;                 ///< flange
  Pose fMr;                 ///< where the gripper holds a ring, whether it does or not
  int held_ring = -1;       ///< index, or -1
  double grip_force = 0.0;  ///< between gripper and held ring [N]
};

/// The world at world.time().
CellTruth truth(const CellWorld& world);

/// How often, with sign, the open line passes upwards through the disk of `radius` [m] in the
/// ring's x-y plane; the line's points are in r [m]. Odd means that ring and line are linked.
int crossings(const std::vector<Eigen::Vector3d>& line_r, double radius);

}  // namespace ringhook

#pragma once

/// \file
/// Everything that may differ from one simulated cell to the next, with the default cell's values:
/// belt, hooks, rings, arm errors, gripper, air, and the ranges of their seeded randomisation. The
/// estimator never shares these numbers: it has to find pendulum length, damping and belt speed by
/// itself, and every seed makes them differ a little from the nominal ones given here.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/joints.h"
#include "sim/belt_profile.h"
#include "sim/scene_options.h"

namespace ringhook {

/// From low to high, every value alike.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Overhead belt, moving along +y_f; how: belt_profile.h.
struct BeltOptions {
  double x = 0.42;             ///< of the pivots in f [m]
  double pivot_z = 1.05;       ///< of the pivots in f [m]
  double start_y = -0.65;      ///< first hook's pivot in f at time zero [m]
  double entry_y = -0.65;      ///< hooks hang locked upstream of here, and swing from here on [m]
  double speed = 0.05;         ///< of the drive when it runs, along +y_f [m/s]
  double speed_spread = 0.02;  ///< actual speed is speed * (1 + uniform(-spread, +spread))
  double start_s = 0.0;        ///< stands until then; 0: runs at time zero [s]
  int stops = 0;               ///< how often it stops and starts again
  Range run_s{4.0, 8.0};       ///< from a start's beginning to the next stop's beginning [s]
  Range stand_s{1.0, 3.0};     ///< from a stop's beginning to the next start's [s], or longer if
                               ///< the ramp takes longer
  double acceleration = 0.4;   ///< of starts and stops, at most [m/s^2]
  double jerk = 4.0;           ///< likewise [m/s^3]
  double pitch = 0.1;          ///< of the chain on its sprocket [m]
  std::vector<double> ripple;  ///< harmonics 1, 2, ... as fractions of the speed; sum below 1
  std::optional<BeltProfile> profile;  ///< exactly this motion, instead of all the above from speed
                                       ///< on; for tests and for belts that were measured
};

/// Hooks on the belt; their shape is in hook_body.h.
struct HookOptions {
  int count = 3;
  double spacing = 0.80;             ///< between pivots, each one upstream of the last [m]
  double swing_about_x = 0.0523599;  ///< amplitude at the entry, swing along the belt [rad]
  double swing_about_y = 0.0523599;  ///< amplitude at the entry, swing towards the cameras [rad]
  double swing_least = 1.0;          ///< actual amplitudes are the above * uniform(swing_least, 1)
  double length_spread = 0.02;       ///< pivot height above o is 0.450 * (1 + uniform(-s, +s))
  double pivot_friction = 2e-4;      ///< Coulomb, each hinge [N m]
  double pivot_damping = 5e-4;       ///< viscous, each hinge [N m s/rad]
  double damping_spread = 0.30;      ///< on both of the above, each times (1 + uniform(-s, +s))
};

/// Steel rings waiting in the feeder's magazine.
struct RingOptions {
  int count = 6;
  double clearance = 0.013;      ///< inner radius minus half the bar's diagonal [m]
  double wire_diameter = 0.006;  ///< [m]
  int segments = 32;             ///< capsules that make up the torus, at least 24
  double friction = 0.25;        ///< steel on steel, sliding

  /// From the ring's centre to the wire's inside [m].
  [[nodiscard]] double innerRadius() const { return clearance + 0.0067; }
  /// From the ring's centre to the wire's centreline [m].
  [[nodiscard]] double radius() const { return innerRadius() + 0.5 * wire_diameter; }
};

/// Joints [rad] that hold the ring at about (0.26, -0.25, 0.66) m in placing orientation. Elbow
/// low, where sin q5 stays above 0.95 over the whole pick window; with the elbow high the wrist
/// passes through its singularity in the middle of it.
inline JointVector startingJoints() {
  JointVector q;
  q << -1.557614, 1.531212, -1.657695, 1.557719, 1.572459, 0.126472;
  return q;
}

/// The arm's start and its errors.
struct ArmOptions {
  /// Nominal joints at time zero [rad].
  JointVector initial_joints = startingJoints();
  /// Standard deviation of each joint's constant zero error [rad]; at the placing pose it moves
  /// the ring by 0.18 mm per axis (root mean square over axes and seeds).
  double zero_error_sigma = 4.2e-4;
};

/// Gripper and feeder: see cell_model.h.
struct GripperOptions {
  double rim_distance = 0.12;     ///< from the flange to the gripped wire's centreline, on z_e [m]
  double opening_angle = 1.5708;  ///< of each jaw [rad]
  /// The feeder hands a ring to a closing empty gripper unless a hook's o is nearer than this [m].
  double feeder_clearance = 0.20;
};

struct CellOptions {
  std::uint64_t seed = 1;         ///< of every random draw in the cell
  double physics_step = 0.0005;   ///< [s]; whole microseconds
  double air_density = 1.2;       ///< [kg/m^3]; zero for vacuum
  double air_viscosity = 1.8e-5;  ///< [Pa s]; zero for vacuum
  BeltOptions belt;
  HookOptions hook;
  RingOptions ring;
  ArmOptions arm;
  GripperOptions gripper;
  SceneOptions scene;
};

/// A belt that stands still with its hook out of everybody's sight, as for calibrating: nothing
/// passes in front of the cameras, nothing throws its shadow.
inline void parkBelt(CellOptions& options) {
  constexpr double kOutOfView = -4.0;  // y_f [m]
  options.belt.speed = 0.0;
  options.belt.profile.reset();
  options.belt.stops = 0;
  options.belt.start_y = kOutOfView;
  options.belt.entry_y = 0.0;
  options.hook.count = 1;
  options.ring.count = 1;
  options.scene.occluder.count = 0;
}

}  // namespace ringhook

#pragma once

/// \file
/// How an overhead chain conveyor moves: its drive runs, starts and stops on S-curves, and the
/// chain adds a ripple. A sprocket turns evenly, but the chain lies on it as a polygon, so its
/// speed rises and falls once per pitch (polygon or chordal action; Niemann and Winter,
/// "Maschinenelemente III", chapter on chain drives). With u the drive's travel, p the pitch and
/// harmonics k = 1, 2, ...
///     travel s = u + sum f_k p / (2 pi k) (sin(2 pi k u / p + phi_k) - sin phi_k)
///     speed  v = u' (1 + sum f_k cos(2 pi k u / p + phi_k)),   ripple frequency k u' / p.
/// All in closed form: nothing is integrated numerically, so no error adds up along the belt.

#include <vector>

namespace ringhook {

/// The drive goes from the speed it has to another one.
struct SpeedChange {
  double begin_s = 0.0;  ///< [s]; not before the change in front of it has ended
  double to = 0.0;       ///< [m/s]
};

/// One harmonic of the chain's ripple.
struct BeltRipple {
  double fraction = 0.0;  ///< amplitude as a fraction of the drive's speed
  double phase = 0.0;     ///< at time zero [rad]
};

struct BeltProfile {
  double initial_speed = 0.0;        ///< of the drive until the first change [m/s]
  std::vector<SpeedChange> changes;  ///< in the order of time
  double acceleration = 0.4;         ///< of the drive in a change, at most [m/s^2]
  double jerk = 4.0;                 ///< likewise [m/s^3]
  double pitch = 0.1;                ///< of the chain [m]
  std::vector<BeltRipple> ripple;    ///< harmonics 1, 2, ... of speed / pitch
};

/// How long the drive takes to change its speed by `difference` [m/s]: [s].
double changeDuration(const BeltProfile& profile, double difference);

/// Chain speed along the belt at `time_s` >= 0: [m/s].
double beltSpeed(const BeltProfile& profile, double time_s);
/// Chain travel from time zero to `time_s` >= 0: [m].
double beltTravel(const BeltProfile& profile, double time_s);

}  // namespace ringhook

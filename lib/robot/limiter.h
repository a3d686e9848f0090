#pragma once

/// \file
/// The gate between every control law and the arm: whatever velocity is wanted, NaN and infinities
/// included, what leaves keeps every limit, in each period and for ever after: joint positions,
/// speeds, accelerations and jerks, tool speed, slower joints near singularities, a workspace box.
///
/// Law: the wanted vector is shortened as a whole into the joint and tool speeds permitted here and
/// now, so that the ring slows down on its line; each joint steps towards it with bounded
/// acceleration and jerk (robot/jerk_step.h); the step is taken only if braking from there on keeps
/// every limit (robot/stop_check.h). Otherwise the greatest share of the wanted vector is
/// taken, found by bisection, for which it does; share zero is the braking verified one period ago.
///
/// The arm follows late, so the place of the joints is estimated: the commands sent so far added
/// up, ahead of the measurement by no more than what the last `lag_periods` explain. An arm that is
/// beyond a position limit or the box, switched on there, may come back and not go further out.
/// Accelerations and jerks are assumptions (rx60::limits()).
///
/// What holds exactly if the arm executes each command: positions less the margin, tool speed and
/// joint speeds on both ends of every period, the tool's place between periods. Lag and noise of
/// the measurement eat the margin. After a change to manual mode the tool brakes to the lower
/// speed.

#include <limits>

#include "robot/stop_check.h"

namespace ringhook {

inline constexpr double kToolSpeedAutomatic = rx60::kCartesianSpeedLimit;  ///< [m/s]
inline constexpr double kToolSpeedManual = 0.25;                           ///< [m/s] (ISO 10218-1)

struct LimiterSettings {
  rx60::Geometry geometry = rx60::rx60();
  JointLimits limits = rx60::limits();
  double velocity_fraction = 1.0;     ///< of the nominal joint speeds, above 0 and up to 1
  double position_margin_rad = 5e-4;  ///< kept from the joint limits
  Eigen::Vector3d tool_e =
      Eigen::Vector3d::Zero();  ///< the point on the flange that is limited [m]
  double tool_speed_automatic_m_s = kToolSpeedAutomatic;
  double tool_speed_manual_m_s = kToolSpeedManual;
  double singular_below = 2e-3;  ///< |det J| [m^3] below which joint speeds shrink linearly,
  double least_share = 0.1;      ///< down to this share at the singularity
  WorkspaceBox box{Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                   Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  int lag_periods = 3;    ///< a measurement may be this late, 0 to 8
  double jump_rad = 0.1;  ///< a measurement further off, or beyond the limits, is not believed
  double period_s = 0.004;
};

enum class OperatingMode { kAutomatic, kManual };

/// A velocity to send, and which limits bent it.
struct LimitedVelocity {
  JointVector velocity = JointVector::Zero();  ///< [rad/s]
  bool speed = false;
  bool position = false;
  bool acceleration = false;
  bool jerk = false;
  bool tool_speed = false;
  bool singular = false;
  bool workspace = false;
  bool bad_input = false;  ///< something not finite, or a measurement that cannot be: braking

  [[nodiscard]] bool limited() const {
    return speed || position || acceleration || jerk || tool_speed || singular || workspace ||
           bad_input;
  }
};

class Limiter {
 public:
  /// Throws InputError for settings that are not finite or out of range.
  explicit Limiter(const LimiterSettings& settings);

  /// The velocity to send for the coming period. Call once a period and send what it returns.
  /// \param wanted [rad/s]  \param measured where the joints were last seen [rad]
  LimitedVelocity limit(const JointVector& wanted, const JointVector& measured,
                        OperatingMode mode = OperatingMode::kAutomatic);

  /// The arm is known to stand still, wherever it is.
  void reset();

  /// The joint limits with the margin taken off: where the arm may be sent.
  [[nodiscard]] JointLimits reach() const;

  [[nodiscard]] const JointVector& velocity() const { return velocity_; }  ///< last one [rad/s]

 private:
  static constexpr int kLongestLag = 8;

  bool observe(const JointVector& measured);
  [[nodiscard]] bool atRest() const;
  [[nodiscard]] StopBounds boundsNow(OperatingMode mode) const;
  [[nodiscard]] JointRates rates() const;
  void remember(const JointRates& rates, const JointVector& target);

  LimiterSettings settings_;
  JointPlace place_{JointVector::Zero(), JointVector::Zero(), JointVector::Zero()};
  bool place_known_ = false;
  JointVector velocity_ = JointVector::Zero();      ///< sent last [rad/s]
  JointVector acceleration_ = JointVector::Zero();  ///< that led to it [rad/s^2]
  JointVector target_ = JointVector::Zero();        ///< stepped towards last [rad/s]
  std::array<JointVector, kLongestLag> sent_;       ///< newest first [rad/s]
};

}  // namespace ringhook

#pragma once

/// \file
/// The 2007 report's test of its Kalman filter (Jeyabalan, Fork project, section 6.3.1, table 6.3),
/// repeated on pictures of the simulated cell. There the arm carried the marker along y in 21 steps
/// of 29.34 mm, and was the reference. Here a hook that does not swing hangs on a belt that runs
/// evenly with 29.34 mm/s; a stereo pair is taken once a second and goes the product's own way:
/// rectified, tags detected, joint pose, into f by the rig that the loop is told. The simulated
/// truth is the reference. Its errors, that of the camera against the robot included, stand beside
/// the report's; and beside the same with the cameras where they truly stand, which takes away
/// exactly the constant rigid error of the camera-robot calibration.
///
/// Each position is predicted one second before, from the fourth one on: three make a parabola. Two
/// filters, constant acceleration (5.1 to 5.5) and constant velocity, with dt = 1 s and the fix's
/// own covariance. What pushes them: a conveyor whose speed wanders by 1 % (standard deviation)
/// while it passes. White acceleration of density q changes a speed by sqrt(q T) in T, white jerk
/// by sqrt(q T^3 / 3) (Bar-Shalom, Li, Kirubarajan, 2001, section 6.2). Before the first pair
/// nothing is known of the speed, and the acceleration is one that such a conveyor wanders to. A
/// model that swings has no place here: one sample a second does not show a swing of 1.2 s, and
/// there is none.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prediction/constant_acceleration.h"

namespace ringhook {

/// One stereo pair; pairs are a second apart.
struct TrackingStep {
  Vector9 truth = Vector9::Zero();         ///< of the followed point, in f
  Eigen::Vector3d seen_f;                  ///< position by stereo [m]
  Eigen::Matrix3d covariance_f;            ///< of seen_f, as the fix says [m^2]
  int features = 0;                        ///< residuals of the fix; 32: all corners, both views
  std::optional<Vector9> by_acceleration;  ///< predicted for this pair from the pairs before
  std::optional<Vector9> by_velocity;      ///< likewise; its acceleration is 0
  double nis = 0.0;                        ///< of the constant-acceleration filter, 3 degrees
};

/// Absolute errors: their mean and standard deviation (mm, mm/s, mm/s^2).
struct ErrorSpread {
  double mean = 0.0;
  double deviation = 0.0;
};

/// The report's "mean of mean error" and "mean of standard deviation error". Not of none.
ErrorSpread meanOf(std::span<const ErrorSpread> spreads);

struct TrackingErrors {
  std::array<ErrorSpread, 3> seen;             ///< x, y, z by stereo [mm]
  ErrorSpread distance;                        ///< between positions of consecutive pairs [mm]
  std::array<ErrorSpread, 9> by_acceleration;  ///< one step before: x y z, vx vy vz, ax ay az
  std::array<ErrorSpread, 9> by_velocity;      ///< likewise
  double nis = 0.0;                            ///< mean per degree of freedom; 1 if consistent
};

/// Lets both filters follow what was seen and notes what they predicted.
void predictSteps(std::vector<TrackingStep>& steps);
/// Precondition: at least six steps, predicted.
TrackingErrors errorsOf(const std::vector<TrackingStep>& steps);

/// One point of the hook, seen with one idea of where the cameras stand.
struct TrackingCase {
  std::vector<TrackingStep> steps;
  TrackingErrors errors;
};

/// What is followed and what is known of the cameras' place.
enum TrackingView : std::size_t {
  kPlateAsTold,   ///< the tag plate's centre, as the report's marker; the rig that the loop is told
  kPlateTrueRig,  ///< the same; cameras where they truly stand in f
  kHookAsTold,    ///< the hook's origin, 0.2 m below, where the ring goes; the rig as told
  kTrackingViews
};

/// One passage of a hook: lamps, noise of the sensors and errors of the calibration are the seed's.
struct TrackingSequence {
  std::uint64_t seed = 1;
  std::array<TrackingCase, kTrackingViews> views;
  std::string first_png;  ///< left picture of the first pair, with what was seen in it
  std::string last_png;   ///< of the last pair
};

struct TrackingExperiment {
  static constexpr double kGoalMm = 0.2;    ///< mean one-step error of x, y, z, plate, rig as told
  std::vector<TrackingSequence> sequences;  ///< the first one is what the tables tell of
};

struct TrackingOptions {
  std::uint64_t first_seed = 1;
  int sequences = 5;                   ///< >= 1
  std::function<void(double)> step{};  ///< told the part done before each; may throw to stop
};

/// Throws Error if a pair shows no hook, DeviceError without OpenGL.
TrackingExperiment runTrackingExperiment(const TrackingOptions& options = {});

/// What to print.
std::string trackingTable(const TrackingExperiment& experiment);
/// summary.json.
std::string trackingJson(const TrackingExperiment& experiment);
/// summary.json, steps.csv and report.html. Throws InputError if the folder is no good.
void writeTrackingOutputs(const std::filesystem::path& folder,
                          const TrackingExperiment& experiment);

}  // namespace ringhook

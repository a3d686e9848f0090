#include "calib/solve/verify_judge.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <cmath>

#include "core/angle.h"
#include "prediction/chi_square.h"

namespace ringhook {
namespace {

constexpr double kAlarm = 1e-3;         // probability of a false alarm by chance
constexpr double kMuchNoise = 2.0;      // times what the evidence promises
constexpr double kUsualViews = 12.0;    // of a calibration that does not tell
constexpr double kDoubtPerViews = 3.0;  // see doc/calibration-check.md
constexpr double kRowShare = 0.5;       // of the promised rows, by which they may drift
constexpr double kFocalShare = 0.1;     // of the misfit that focal lengths must explain

/// The accepted rig was made from views as noisy as these: their noise is in what is compared, and
/// lens parameters were estimated from them too.
double doubtFactor(const StereoRig& rig, int views) {
  const double made_from = rig.views ? std::max(1, *rig.views) : kUsualViews;
  return 1.0 + kDoubtPerViews * views / made_from;
}

void fillMove(const RigFits& fits, double variance, Verification& result) {
  const Vector8 sigma = (variance * fits.moved.covariance.diagonal()).cwiseSqrt();
  // The camera moves by the inverse of what its picture does.
  result.moved.translation_m = -fits.moved.change.head<3>();
  result.moved.rotation_rad = -fits.moved.change.segment<3>(3);
  result.moved.translation_sigma_m = sigma.head<3>();
  result.moved.rotation_sigma_rad = sigma.segment<3>(3);
  result.moved.chi_square = (fits.held.squares - fits.moved.squares) / variance;
  result.moved.limit = chiSquareQuantile(1.0 - kAlarm, 6.0);
  result.focal.left_share = fits.both.change[6];
  result.focal.right_share = fits.both.change[7];
  result.focal.chi_square = (fits.moved.squares - fits.both.squares) / variance;
  result.focal.limit = chiSquareQuantile(1.0 - kAlarm, 2.0);
}

std::string moveInWords(const CameraMove& m) {
  int axis = 0;
  m.rotation_rad.cwiseAbs().maxCoeff(&axis);
  const char name = "xyz"[axis];
  return fmt::format(
      "as if the right camera had turned by {:.3f} deg (mostly about its {} axis: {:.3f} +- "
      "{:.3f}) "
      "and shifted by {:.2f} mm against the left one",
      m.rotation_rad.norm() / kDegree, name, m.rotation_rad[axis] / kDegree,
      m.rotation_sigma_rad[axis] / kDegree, 1e3 * m.translation_m.norm());
}

std::string rowsInWords(const RowDrift& rows) {
  return fmt::format("rows differ by {:.3f} px RMS where {:.3f} px are expected", rows.rms_px,
                     rows.expected_px);
}

std::string costInWords(const Verification& v) {
  return fmt::format("used as it is, the rig misplaces points {:.2f} m away by {:.2f} mm",
                     v.distance_m, 1e3 * v.moved.cost_m);
}

/// Are rows off by more than promised, or points by more than is harmless?
bool ofConsequence(const Verification& v, const RowDrift& after, double tolerance_m) {
  const double drift =
      std::sqrt(std::max(0.0, v.rows.rms_px * v.rows.rms_px - after.rms_px * after.rms_px));
  return drift > kRowShare * v.rows.expected_px || v.moved.cost_m > tolerance_m;
}

/// Does a baseline that is longer or shorter explain what six parameters explain? With information
/// L of the change d, the best multiple of the baseline's direction u leaves
/// d^T L d - (u^T L d)^2 / u^T L u, chi-square of five degrees of freedom.
bool baselineAlone(const RigFits& fits, double variance) {
  const Covariance6 L = fits.moved.covariance.topLeftCorner<6, 6>().inverse() / variance;
  const Eigen::Matrix<double, 6, 1> d = fits.moved.change.head<6>();
  Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
  u.head<3>() = fits.held.rig.c2Mc1.translation().normalized();
  const double along = u.dot(L * d);
  return d.dot(L * d) - along * along / u.dot(L * u) < chiSquareQuantile(1.0 - kAlarm, 5.0);
}

void changed(const RigFits& fits, double variance, Verification& v) {
  const double explained = fits.held.squares - fits.both.squares;
  const double by_focal = fits.moved.squares - fits.both.squares;
  const bool focal = v.focal.chi_square > v.focal.limit && by_focal > kFocalShare * explained;
  const bool focal_alone = fits.refocused.squares < fits.moved.squares;
  if (focal || focal_alone) {
    const Vector8& c = focal_alone ? fits.refocused.change : fits.both.change;
    v.state = RigState::kRecalibrate;
    v.reasons.push_back(
        fmt::format("a moved camera does not explain what is seen: focal lengths have changed by "
                    "{:+.2f} % left "
                    "and {:+.2f} % right (focus, zoom or temperature); calibrate anew",
                    100.0 * c[6], 100.0 * c[7]));
    return;
  }
  if (baselineAlone(fits, variance)) {
    v.state = RigState::kRecalibrate;
    v.reasons.push_back(
        fmt::format("lengths come out {:+.2f} % wrong: the baseline has changed, the cameras have "
                    "turned a little towards each other, or the target's size is not as stated; "
                    "measure the target, else calibrate anew",
                    100.0 * v.bar.mean_m / v.bar.known_m));
    return;
  }
  v.state = RigState::kMoved;
  v.reasons.push_back(moveInWords(v.moved) + "; fasten the cameras and calibrate anew");
}

}  // namespace

void judgeRig(const StereoRig& rig, const RigFits& fits, const RowDrift& after, double tolerance_m,
              Verification& v) {
  v.corner_sigma_px = std::sqrt(fits.both.squares / fits.both.freedom);
  const double noise = std::max(v.corner_sigma_px, 1e-3);
  const double variance = noise * noise * doubtFactor(rig, v.views);
  fillMove(fits, variance, v);
  const bool significant = v.moved.chi_square > v.moved.limit ||
                           (fits.held.squares - fits.refocused.squares) / variance > v.focal.limit;
  if (significant && ofConsequence(v, after, tolerance_m)) {
    changed(fits, variance, v);
  } else if (v.corner_sigma_px > kMuchNoise * v.expected_sigma_px) {
    v.state = RigState::kRecalibrate;
    v.reasons.push_back(fmt::format(
        "points scatter by {:.3f} px per axis where {:.3f} px are expected, and no motion of a "
        "camera explains it: look at focus, light and the target, then calibrate anew",
        v.corner_sigma_px, v.expected_sigma_px));
  } else if (std::abs(v.bar.mean_m) > std::max(tolerance_m, 5e-3 * v.bar.known_m)) {
    v.state = RigState::kRecalibrate;
    v.reasons.push_back(fmt::format(
        "a bar of {:.2f} mm measures {:+.2f} mm more: the scale is wrong, or the target's size is "
        "not as stated",
        1e3 * v.bar.known_m, 1e3 * v.bar.mean_m));
  } else {
    v.reasons.push_back("the rig holds: no change that is both significant and of consequence");
  }
  v.reasons.push_back(rowsInWords(v.rows));
  if (v.state != RigState::kOk) {
    v.reasons.push_back(costInWords(v));
  }
}

}  // namespace ringhook

// What the figures of a finished calibration are worth, in one word and one sentence.

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "calib/solve/stereo_calibration.h"

namespace ringhook {
namespace {

// doc/calibration.md gives the reasons.
constexpr double kGood_px = 0.3;
constexpr double kUsable_px = 0.6;
constexpr double kGoodRelativeUncertainty = 2e-3;
constexpr double kUsableRelativeUncertainty = 1e-2;
constexpr double kOverfit = 1.5;

double relativeUncertainty(const StereoCalibration& c) {
  const CameraModel& left = c.rig.left;
  const CameraModel& right = c.rig.right.value();
  const double focal = std::min({left.K(0, 0), left.K(1, 1), right.K(0, 0), right.K(1, 1)});
  return std::max(c.uncertainty->focal_px / focal, c.uncertainty->baseline_m / baseline(c.rig));
}

std::string figuresOf(const StereoCalibration& c) {
  return fmt::format("reprojection {:.3f} px and held-out rows {:.3f} px", c.rms_px,
                     c.heldout_vertical_disparity_px);
}

}  // namespace

std::string toString(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "good";
    case Grade::kUsable:
      return "usable";
    case Grade::kPoor:
      break;
  }
  return "poor";
}

Verdict judge(const StereoCalibration& c) {
  if (!c.uncertainty) {
    return {Grade::kPoor,
            "the views leave a parameter undetermined: tilt the board in different directions"};
  }
  const double rows = c.heldout_vertical_disparity_px;
  const double worst = std::max(c.rms_px, rows);
  const double relative = relativeUncertainty(c);
  const std::string figures = figuresOf(c);
  if (!(worst <= kUsable_px)) {
    return {Grade::kPoor,
            figures + fmt::format(", where at most {:.1f} px can be used: look for blur, a "
                                  "bent board, or images that are not pairs",
                                  kUsable_px)};
  }
  if (relative > kUsableRelativeUncertainty) {
    return {Grade::kPoor,
            fmt::format("focal length or baseline is known to {:.2f} % only: tilt the board "
                        "more and bring it closer",
                        100.0 * relative)};
  }
  if (rows > kOverfit * std::sqrt(2.0) * c.corner_sigma_px) {
    return {Grade::kUsable, figures +
                                ": unseen views fit worse than the ones used, so the views "
                                "are too few or too much alike"};
  }
  if (worst > kGood_px) {
    return {Grade::kUsable,
            figures + fmt::format(", where {:.1f} px is good: sharper or more evenly lit "
                                  "pictures and a flatter board help",
                                  kGood_px)};
  }
  if (relative > kGoodRelativeUncertainty) {
    return {Grade::kUsable,
            figures + fmt::format(", but focal length or baseline is known to {:.2f} % "
                                  "only: tilt the board more",
                                  100.0 * relative)};
  }
  return {Grade::kGood, figures + ", both as expected of sharp pictures and a flat board"};
}

}  // namespace ringhook

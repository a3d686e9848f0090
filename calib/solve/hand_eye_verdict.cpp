#include "calib/solve/hand_eye_verdict.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "calib/solve/sentence.h"
#include "core/angle.h"

namespace ringhook {
namespace {

constexpr double kWellTurned = 15.0 * kDegree;  // RMS of a flange's turns about one axis
constexpr double kPositionPoint = 16.27;        // chi-square, 3 degrees, 99.9 %

// Turns between all pairs of flange poses, expressed in the flange.
Eigen::Matrix3d turnScatter(const std::vector<PosePair>& pairs) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      const Eigen::Vector3d turn =
          thetaU(pairs[i].fMe.linear().transpose() * pairs[j].fMe.linear());
      sum += turn * turn.transpose();
      n += 1.0;
    }
  }
  return sum / std::max(n, 1.0);
}

std::string axisName(const Eigen::Vector3d& direction) {
  static constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return kNames.at(static_cast<std::size_t>(axis));
}

Verdict poor(const std::string& why, const std::string& advice) {
  return {Grade::kPoor, advice.empty() ? why : why + "; " + advice};
}

// The reasons that do not need the uncertainty.
std::optional<Verdict> contradiction(const HandEyeResult& r, const VerdictLimits& limits) {
  const double median_m = r.better_convention.median_m;
  if (!r.better_convention.words.empty()) {
    std::vector<double> all;
    for (const PairError& e : r.errors) {
      all.push_back(std::hypot(e.translation_m, kErrorLever * e.rotation_rad));
    }
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                     all.end());
    return poor("the pairs fit " + decimals(all[all.size() / 2] / median_m, 0) +
                    " times better if " + r.better_convention.words,
                "correct that and calibrate again");
  }
  const auto n = static_cast<double>(r.used.size());
  if (static_cast<double>(r.rejected.size()) > limits.rejected_share * n) {
    return poor(std::to_string(r.rejected.size()) + " of " + std::to_string(r.used.size()) +
                    " pairs contradict the others",
                "check that the arm stood still and that rows of robot and target belong together");
  }
  return std::nullopt;
}

}  // namespace

double boundFactor(double residuals) {
  return std::sqrt(kPositionPoint / leastNoiseShare(residuals));
}

std::string motionAdvice(const std::vector<PosePair>& pairs) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(turnScatter(pairs));
  const Eigen::Vector3d rms = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  // With one axis well turned the second decides; which of the flange's own axes is nearest.
  if (rms[0] > kWellTurned || (rms[1] > kWellTurned && rms[0] > 0.3 * rms[1])) {
    return {};
  }
  if (rms[2] < kWellTurned) {
    return "turn the flange more: by 30 degrees and more about each of its x, y and z axes (now " +
           degrees(rms[2]) + " RMS about the axis turned most)";
  }
  const int weak = rms[1] < kWellTurned ? 1 : 0;
  return "add poses with the flange turned by 30 degrees and more about its " +
         axisName(eigen.eigenvectors().col(weak)) + " axis as well (now " + degrees(rms[weak]) +
         " RMS, against " + degrees(rms[2]) + " about the axis turned most)";
}

Verdict judge(const HandEyeResult& r, const VerdictLimits& limits) {
  if (const auto verdict = contradiction(r, limits)) {
    return *verdict;
  }
  const std::string turn = r.advice.empty() ? "add pairs" : r.advice;
  if (!r.sigmas) {
    return poor("the motions leave the camera's pose undetermined", turn);
  }
  const auto kept = static_cast<double>(r.used.size() - r.rejected.size());
  const double factor = boundFactor(3.0 * kept - 6.0);
  const double camera = factor * r.sigmas->camera_m;
  const double angle = factor * r.sigmas->camera_rad;
  const double workspace = factor * r.sigmas->workspace_m;
  if (!(camera <= limits.usable_m) || !(angle <= limits.usable_rad)) {
    return poor(
        "the camera's pose may be wrong by " + millimetres(camera) + " and " + degrees(angle),
        turn);
  }
  if (r.heldout.translation_m > limits.heldout_ratio * r.residual.translation_m + 1e-6) {
    return poor("pairs left out are missed by " + millimetres(r.heldout.translation_m) +
                    ", those fitted by " + millimetres(r.residual.translation_m) +
                    ": too few pairs",
                turn);
  }
  const std::string found = "points in the middle of the views come to within " +
                            millimetres(r.sigmas->workspace_m) + " (standard deviation; at most " +
                            millimetres(workspace) + "), the camera's own position to " +
                            millimetres(r.sigmas->camera_m);
  if (workspace <= limits.good_m) {
    return {Grade::kGood, found};
  }
  return {Grade::kUsable, found + "; more pairs" +
                              (r.advice.empty() ? std::string() : ", or " + r.advice + ",") +
                              " will make it better"};
}

}  // namespace ringhook

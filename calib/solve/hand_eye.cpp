#include "calib/solve/hand_eye.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/solve/hand_eye_starts.h"
#include "calib/solve/hand_eye_verdict.h"
#include "calib/solve/sentence.h"
#include "calib/solve/small_statistics.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kSubsets = 60;
constexpr std::size_t kRefinedStarts = 3;
constexpr double kNoMotion = 1e-4;  // [rad]; the flange was never turned

using Matrix3 = Eigen::Matrix3d;

void requireMotion(const std::vector<PosePair>& pairs) {
  if (pairs.size() < kFewestPairs) {
    throw InputError("expected at least " + std::to_string(kFewestPairs) + " pairs, found " +
                     std::to_string(pairs.size()) + ": 15 and more are good practice");
  }
  const bool turned = std::any_of(pairs.begin(), pairs.end(), [&](const PosePair& pair) {
    return thetaU(pairs[0].fMe.linear().transpose() * pair.fMe.linear()).norm() > kNoMotion;
  });
  if (!turned) {
    throw InputError(
        "the flange has the same orientation in all pairs: turn it by 30 degrees and more about at "
        "least two of its axes between the pairs");
  }
}

// Where the targets were seen, in c [m].
Eigen::Vector3d middle(const std::vector<PosePair>& pairs, const std::vector<bool>& used) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (used[i]) {
      sum += pairs[i].cMt.translation();
      n += 1.0;
    }
  }
  return sum / n;
}

HandEyeSigmas sigmasOf(const Covariance12& C, const Eigen::Vector3d& point_c) {
  Eigen::Matrix<double, 3, 6> move;  // of the point by the camera's twist
  move << Matrix3::Identity(), -skew(point_c);
  return {largestSigma(C.block<3, 3>(0, 0)), largestSigma(C.block<3, 3>(3, 3)),
          largestSigma(C.block<3, 3>(6, 6)), largestSigma(C.block<3, 3>(9, 9)),
          largestSigma(move * C.topLeftCorner<6, 6>() * move.transpose())};
}

HandEyeSigmas larger(const HandEyeSigmas& a, const HandEyeSigmas& b) {
  return {std::max(a.camera_m, b.camera_m), std::max(a.camera_rad, b.camera_rad),
          std::max(a.target_m, b.target_m), std::max(a.target_rad, b.target_rad),
          std::max(a.workspace_m, b.workspace_m)};
}

std::string reasonOf(const PairError& error) {
  return millimetres(error.translation_m) + " and " + degrees(error.rotation_rad) +
         " from where the others put it";
}

void describePairs(const std::vector<PosePair>& pairs, HandEyeResult& result) {
  result.rejected.clear();
  result.errors.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    result.errors.push_back(pairError(result.pose, pairs[i], result.setup));
    if (!result.used[i]) {
      result.rejected.push_back({pairs[i].name, i, reasonOf(result.errors.back())});
    }
  }
}

void compareClosedForms(const std::vector<PosePair>& pairs, HandEyeResult& result) {
  result.closed_forms.clear();
  for (const ClosedForm form : closedForms()) {
    ClosedFormResult line;
    line.name = toString(form);
    if (const auto pose = solveClosedForm(form, pairs, result.setup)) {
      line.solved = true;
      line.median_m = medianError(*pose, pairs, result.setup);
      line.rms = rmsError(*pose, pairs, result.used, result.setup);
      line.from_result_m = (pose->camera.translation() - result.pose.camera.translation()).norm();
    }
    result.closed_forms.push_back(line);
  }
}

// The best starts refined; the one that leaves the least median error.
HandEyeFit refineBest(const std::vector<PosePair>& pairs, const std::vector<Start>& starts,
                      HandEyeResult& result) {
  HandEyeFit best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(kRefinedStarts, starts.size()); ++i) {
    HandEyeFit fit = fitHandEye(pairs, result.setup, starts[i].pose);
    const double median_m = medianError(fit.pose, pairs, result.setup);
    if (median_m < least) {
      least = median_m;
      best = std::move(fit);
      result.solver = starts[i].name;
    }
  }
  return best;
}

// The fit as believed, or under the weights that predict pairs left out clearly better.
void takeFit(const std::vector<PosePair>& pairs, const HandEyeFit& fit, HandEyeResult& result) {
  WeighedFit taken{believedWeights(pairs), fit.pose, fit.noise, fit.covariance, {}};
  const auto kept = std::count(fit.used.begin(), fit.used.end(), true);
  if (fit.covariance && kept >= static_cast<std::ptrdiff_t>(kFewestToWeigh)) {
    result.weighings = fitInEveryWay(pairs, result.setup, fit);
    taken = result.weighings[chosenFit(result.weighings)];
  }
  result.pose = taken.pose;
  result.noise = taken.noise;
  result.covariance = taken.covariance;
  result.weights = taken.weights;
  result.used = fit.used;
}

}  // namespace

bool weightsRefuted(const HandEyeResult& result) {
  return !result.weighings.empty() && result.weights != result.weighings.front().weights;
}

HandEyeResult calibrateRobotCamera(const std::vector<PosePair>& pairs, EyeSetup setup,
                                   const StepHook& hook) {
  requireMotion(pairs);
  HandEyeResult result;
  result.setup = setup;
  hook(0.0, "closed forms");
  const std::vector<Start> starts = handEyeStarts(pairs, setup, closedForms(), kSubsets);
  if (starts.empty()) {
    throw Error("no closed form solves these pairs: " + motionAdvice(pairs));
  }
  hook(0.3, "refining");
  takeFit(pairs, refineBest(pairs, starts, result), result);
  hook(0.6, "other conventions");
  result.better_convention = betterConvention(pairs, setup, medianError(result.pose, pairs, setup));
  hook(0.8, "leaving pairs out");
  judgeHandEye(pairs, result);
  hook(1.0, toString(result.verdict.grade));
  return result;
}

void judgeHandEye(const std::vector<PosePair>& pairs, HandEyeResult& result) {
  describePairs(pairs, result);
  compareClosedForms(pairs, result);
  result.residual = rmsError(result.pose, pairs, result.used, result.setup);
  result.advice = motionAdvice(pairs);
  result.sigmas.reset();
  const std::size_t kept = pairs.size() - result.rejected.size();
  if (result.covariance && kept >= 3) {
    const LeftOut left_out = leaveEachOut(
        pairs, result.setup, {result.weights, result.pose, result.noise, result.covariance, {}},
        result.used);
    result.left_out = left_out.errors;
    result.heldout = left_out.rms;
    const Eigen::Vector3d point_c = middle(pairs, result.used);
    result.sigmas =
        larger(sigmasOf(*result.covariance, point_c), sigmasOf(left_out.jackknife, point_c));
  }
  result.verdict = judge(result);
}

}  // namespace ringhook

#include "calib/solve/plate_views.h"

#include <algorithm>
#include <cmath>

#include "calib/solve/plate_bundle.h"
#include "core/error.h"
#include "stereo/joint_pose.h"

namespace ringhook {
namespace {

constexpr double kLeastSigma = 0.005;  // [px]; images without noise

// Each view's own pose; a view that tells none goes to `blind`. Returns the views that do.
std::vector<PlateView> sighted(const std::vector<PlateView>& views,
                               std::vector<RejectedPair>& blind) {
  std::vector<PlateView> kept;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto fix = fixFromView(views[i].seen);
    if (fix) {
      kept.push_back(views[i]);
      kept.back().seen.c1Mo_start = fix->c1Mo;
    } else {
      blind.push_back({views[i].name, i, fix.reason()});
    }
  }
  return kept;
}

// Corner noise per axis from what the single poses leave, six unknowns a view.
double cornerSigma(const std::vector<PlateView>& views) {
  double sum = 0.0;
  double freedom = 0.0;
  for (const PlateView& view : views) {
    const auto fix = fixFromView(view.seen);
    if (fix) {
      sum += fix->rms_px * fix->rms_px * fix->features;
      freedom += fix->features - 6.0;
    }
  }
  return std::max(kLeastSigma, std::sqrt(sum / std::max(freedom, 1.0)));
}

std::vector<PosePair> pairsOf(std::vector<PlateView>& views, double sigma_px) {
  std::vector<PosePair> pairs;
  for (PlateView& view : views) {
    for (CameraFeatures& camera : view.seen.cameras) {
      for (CornerFeature& corner : camera.corners) {
        corner.sigma_px = sigma_px;
      }
    }
    const auto fix = fixFromView(view.seen);
    if (!fix) {
      throw Error(view.name + ": the plate's pose is lost on refinement: " + fix.reason());
    }
    pairs.push_back({view.name, view.fMe, fix->c1Mo, fix->covariance});
  }
  return pairs;
}

/// With few views every zero error would explain noise.
constexpr std::ptrdiff_t kFewestForZeros = 12;
constexpr double kOtherArm = 1e-3;  // from the kinematics of an RX60 [m]

/// How far the flange is from where an arm's kinematics puts it, at most [m].
double farthest(const std::vector<PlateView>& views, const rx60::Geometry& arm) {
  double worst = 0.0;
  for (const PlateView& view : views) {
    const double d =
        (rx60::forward(arm, *view.joints).translation() - view.fMe.translation()).norm();
    worst = std::max(worst, d);
  }
  return worst;
}

/// The RX60 that gave the views' fMe: as it came, or with the zeros told. Nothing for another arm's
/// joints, or none.
std::optional<rx60::Geometry> armBehind(const std::vector<PlateView>& views,
                                        const JointVector& told_zeros_rad) {
  if (!std::all_of(views.begin(), views.end(),
                   [](const auto& v) { return v.joints.has_value(); })) {
    return std::nullopt;
  }
  rx60::Geometry plain = rx60::rx60();
  rx60::Geometry told = plain;
  told.zero = told_zeros_rad;
  const rx60::Geometry& arm = farthest(views, told) < farthest(views, plain) ? told : plain;
  return farthest(views, arm) < kOtherArm ? std::optional(arm) : std::nullopt;
}

void refineFromCorners(const std::vector<PlateView>& views, PlateCalibration& calibration) {
  HandEyeResult& result = calibration.result;
  const BundleResult bundle = refineOnPlates(views, result.used, result.setup, result.pose,
                                             calibration.corner_sigma_px, result.noise);
  result.pose = bundle.pose;
  result.covariance = bundle.covariance;
  calibration.rms_px = bundle.rms_px;
  calibration.arm_rms_px = bundle.arm_rms_px;
  judgeHandEye(calibration.pairs, result);
}

/// Of a result that is not taken from the corners: what its pairs contradict them by.
void describeCorners(const std::vector<PlateView>& views, PlateCalibration& calibration) {
  const HandEyeResult& result = calibration.result;
  std::vector<Pose> seen;
  for (const PosePair& pair : calibration.pairs) {
    seen.push_back(pair.cMt);
  }
  calibration.rms_px = cornerRms(views, result.used, seen);
  calibration.arm_rms_px =
      cornerRms(views, result.used, predictedPlates(views, result.setup, result.pose));
}

void findZeros(const std::vector<PlateView>& views, const rx60::Geometry& arm, ZeroChoice choice,
               PlateCalibration& calibration) {
  HandEyeResult& result = calibration.result;
  std::vector<JointVector> joints;
  for (const PlateView& view : views) {
    joints.push_back(*view.joints);
  }
  const JointZeros zeros = fitJointZeros(calibration.pairs, joints, arm, result);
  calibration.zeros = zeros;
  calibration.zeros->zero_rad += arm.zero;
  if (choice == ZeroChoice::kKeep || !zerosPay(result.left_out, zeros.left_out)) {
    return;
  }
  calibration.zeros_used = true;
  calibration.arm_zeros_rad = calibration.zeros->zero_rad;
  calibration.pairs = withZeros(calibration.pairs, joints, arm, zeros.zero_rad);
  result.pose = zeros.pose;
  result.covariance = zeros.covariance;
  result.noise = zeros.noise;
  result.weights = PairWeights::kViews;
  judgeHandEye(calibration.pairs, result);
  // The judge leaves pairs out with the zeros kept; here they were found anew each time.
  result.left_out = zeros.left_out;
  result.heldout = zeros.heldout;
}

}  // namespace

PlateCalibration calibrateFromViews(const std::vector<PlateView>& views, EyeSetup setup,
                                    ZeroChoice choice, const StepHook& hook,
                                    const JointVector& told_zeros_rad) {
  PlateCalibration calibration;
  std::vector<PlateView> kept = sighted(views, calibration.blind);
  calibration.corner_sigma_px = cornerSigma(kept);
  calibration.pairs = pairsOf(kept, calibration.corner_sigma_px);
  calibration.result = calibrateRobotCamera(calibration.pairs, setup, hook);
  HandEyeResult& result = calibration.result;
  if (!result.sigmas || !result.better_convention.words.empty()) {
    return calibration;  // nothing that could be refined
  }
  if (result.weights == PairWeights::kViews) {
    refineFromCorners(kept, calibration);
  } else {
    describeCorners(kept, calibration);
  }
  calibration.plain_heldout = result.heldout;
  const auto used = std::count(result.used.begin(), result.used.end(), true);
  if (const auto arm = armBehind(kept, told_zeros_rad)) {
    calibration.arm_zeros_rad = arm->zero;
    if (used >= kFewestForZeros && result.verdict.grade != Grade::kPoor) {
      findZeros(kept, *arm, choice, calibration);
    }
  }
  return calibration;
}

}  // namespace ringhook

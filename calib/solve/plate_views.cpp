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
constexpr std::size_t kFewestForZeros = 12;
constexpr double kOtherArm = 1e-3;  // from the kinematics of an RX60 [m]

std::optional<JointZeros> zerosOf(const std::vector<PlateView>& views,
                                  const PlateCalibration& calibration) {
  const HandEyeResult& result = calibration.result;
  std::vector<JointVector> joints;
  for (const PlateView& view : views) {
    // Another arm's joints would be nonsense here.
    if (view.joints &&
        (rx60::forward(rx60::rx60(), *view.joints).translation() - view.fMe.translation()).norm() <
            kOtherArm) {
      joints.push_back(*view.joints);
    }
  }
  const auto used =
      static_cast<std::size_t>(std::count(result.used.begin(), result.used.end(), true));
  if (joints.size() != calibration.pairs.size() || used < kFewestForZeros ||
      result.verdict.grade == Grade::kPoor) {
    return std::nullopt;
  }
  return fitJointZeros(calibration.pairs, joints, rx60::rx60(), result);
}

}  // namespace

PlateCalibration calibrateFromViews(const std::vector<PlateView>& views, EyeSetup setup,
                                    const StepHook& hook) {
  PlateCalibration calibration;
  std::vector<PlateView> kept = sighted(views, calibration.blind);
  calibration.corner_sigma_px = cornerSigma(kept);
  calibration.pairs = pairsOf(kept, calibration.corner_sigma_px);
  calibration.result = calibrateRobotCamera(calibration.pairs, setup, hook);
  HandEyeResult& result = calibration.result;
  if (!result.sigmas || !result.better_convention.words.empty()) {
    return calibration;  // nothing that could be refined
  }
  const BundleResult bundle = refineOnPlates(kept, result.used, setup, result.pose,
                                             calibration.corner_sigma_px, result.noise);
  result.pose = bundle.pose;
  result.covariance = bundle.covariance;
  calibration.rms_px = bundle.rms_px;
  calibration.arm_rms_px = bundle.arm_rms_px;
  judgeHandEye(calibration.pairs, result);
  calibration.zeros = zerosOf(kept, calibration);
  return calibration;
}

}  // namespace ringhook

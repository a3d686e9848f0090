#pragma once

/// \file
/// Robot-camera calibration from pose pairs, without prompts: several closed forms and random small
/// subsets as starts, all judged by one measure; robust refinement of the best; wrong pairs named;
/// mistaken conventions named; held-out errors by leaving pairs out; uncertainty from the
/// covariance and from the jackknife; a verdict that refuses what the pairs do not show.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/closed_forms.h"
#include "calib/solve/hand_eye_fit.h"
#include "calib/solve/pair_weights.h"
#include "calib/solve/stereo_calibration.h"

namespace ringhook {

/// Two pairs determine the twelve unknowns at best, a third would contradict, a fourth tells who is
/// wrong.
constexpr std::size_t kFewestPairs = 4;
/// Fewer pairs left out one by one tell nothing of weights.
constexpr std::size_t kFewestToWeigh = 6;

/// A closed form on all pairs, as it came.
struct ClosedFormResult {
  std::string name;
  bool solved = false;         ///< false: it gave no answer
  double median_m = 0.0;       ///< medianError [m]
  PairError rms;               ///< over the pairs used
  double from_result_m = 0.0;  ///< distance of its camera from the refined one [m]
};

struct RejectedPair {
  std::string name;
  std::size_t index = 0;  ///< among the pairs given, from 0
  std::string reason;     ///< a phrase for a table
};

/// What the pairs would say if they were written in another convention.
struct Convention {
  std::string words;      ///< as in "the robot poses are inverted"; empty: as given
  double median_m = 0.0;  ///< medianError of the best start [m]
};

/// Standard deviations: the largest over directions, of the model and the jackknife.
struct HandEyeSigmas {
  double camera_m = 0.0;     ///< position of the camera
  double camera_rad = 0.0;   ///< its orientation
  double target_m = 0.0;     ///< position of the target in its holder
  double target_rad = 0.0;   ///< its orientation
  double workspace_m = 0.0;  ///< of a point seen where the targets were, brought to the holder
};

struct HandEyeResult {
  EyeSetup setup = EyeSetup::kEyeToHand;
  HandEye pose;
  std::optional<Covariance12> covariance;  ///< of (a, b), see hand_eye_fit.h; model's
  std::optional<HandEyeSigmas> sigmas;     ///< absent: the pairs leave a motion undetermined
  PairNoise noise;
  PairWeights weights = PairWeights::kPairs;  ///< under which `pose` is least squares
  std::vector<WeighedFit> weighings;  ///< the ways to weigh that were compared; may be empty
  PairError residual;                 ///< RMS over the pairs used
  PairError heldout;                  ///< RMS of pairs predicted by a fit without them
  std::vector<RejectedPair> rejected;
  std::vector<PairError> errors;    ///< of every pair given
  std::vector<PairError> left_out;  ///< of every pair used: predicted by a fit without it
  std::vector<bool> used;           ///< one per pair given
  std::string solver;               ///< the start that the result came from
  std::vector<ClosedFormResult> closed_forms;
  Convention better_convention;  ///< words empty: none explains the pairs better
  std::string advice;            ///< which motion would tell most; may be empty
  Verdict verdict;
};

/// The whole job. Throws InputError below kFewestPairs pairs or for pairs without any motion, and
/// whatever `hook` throws. Everything else comes as a verdict: kPoor means that the pose must not
/// be used.
HandEyeResult calibrateRobotCamera(const std::vector<PosePair>& pairs, EyeSetup setup,
                                   const StepHook& hook);

/// Whether pairs left out spoke clearly against the weights that were believed first.
bool weightsRefuted(const HandEyeResult& result);

/// Fills everything behind `pose`, `used`, `noise`, `weights` and `covariance` of a result that was
/// refined elsewhere (by reprojection) from these pairs.
void judgeHandEye(const std::vector<PosePair>& pairs, HandEyeResult& result);

}  // namespace ringhook

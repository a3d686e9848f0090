#pragma once

/// \file
/// The motion models that trajectories are judged with, by name, the first of them the one that the
/// project uses; and how the others are made fair peers. A linear filter is as good as its process
/// noise, which no law of theirs tells. Each of them gets, in hindsight, the densities with which
/// it predicts this very trajectory best: the least geometric mean over the horizons of its RMS,
/// over a grid of powers of ten and then of halves between, one density after the other, twice
/// round. No causal filter could know them; ours is given nothing of the kind.

#include <memory>
#include <string>
#include <vector>

#include "evaluation/trajectory_evaluation.h"

namespace ringhook {

struct ModelSettings {
  double sample_sigma = 1e-3;      ///< measurement noise [rad or m]
  std::optional<double> length_m;  ///< of the linear pendulums; without it they find their own
  double damping_per_s = 0.0;      ///< with length_m: c of phi'' = -(g/L) phi - c phi'
};

/// All that are known, in their order.
[[nodiscard]] const std::vector<std::string>& motionModelNames();

/// "all" or a list; throws InputError listing the known names for another, or for one named twice.
[[nodiscard]] std::vector<std::string> chosenModels(const std::vector<std::string>& names);

/// A model, ready for the first sample.
struct TunedModel {
  std::unique_ptr<MotionModel> model;
  /// Chosen for it: white acceleration [m^2/s^3 or rad^2/s^3] or jerk [.../s^5]; of a pendulum: of
  /// swing, pivot and height. Empty: nothing was.
  std::vector<double> densities;
};

/// The model for `trajectory`; a peer tuned on all of it. Precondition: `name` is known.
[[nodiscard]] TunedModel makeTunedModel(const std::string& name, const Trajectory& trajectory,
                                        const std::vector<HorizonTruth>& truth,
                                        const ModelSettings& settings, double warm_up_s);

}  // namespace ringhook

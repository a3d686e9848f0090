#pragma once

/// \file
/// Motion models judged on a recorded trajectory, side by side and causally: every model goes over
/// the samples once; after each sample it says where the trajectory will be a horizon later, and
/// what is measured then, interpolated as a line between the two samples about that instant, is the
/// judge. The measurement noise of the judge is in every error, alike for all models.
///
/// All models are judged on the same predictions: those made after the warm-up, once the slowest
/// model predicts. A model that never does is left out. NIS is judged over the same time: of a
/// consistent filter it is chi-square distributed, its mean is its degrees of freedom and 95 % of
/// it lies between the quantiles 0.025 and 0.975 (Bar-Shalom, Li, Kirubarajan, 2001, section 5.4).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/trajectory_file.h"
#include "prediction/motion_model.h"

namespace ringhook {

/// Measured numbers a horizon ahead of each sample.
struct HorizonTruth {
  double horizon_s = 0.0;
  Eigen::MatrixXd ahead;  ///< predictedSize x samples [rad or m]; NaN: not measured then
};

/// One model's way over a trajectory.
struct ModelRun {
  std::string name;
  std::string note;
  std::vector<Eigen::MatrixXd> errors;  ///< [horizon] predictedSize x samples, predicted less
                                        ///< measured [rad or m], by the sample after which it was
                                        ///< predicted; NaN: no prediction or no truth
  std::vector<FilterUpdate> updates;    ///< [sample]; 0 degrees: no innovation, or refused
  std::vector<std::vector<NamedParameter>> parameters;  ///< [sample], after it
  std::size_t refused = 0;                              ///< samples that the model did not take
};

struct HorizonResult {
  double horizon_s = 0.0;
  double rms = 0.0;                      ///< of the errors per coordinate [rad or m]
  std::optional<double> horizontal_rms;  ///< of the horizontal distance, of points [m]
  std::size_t samples = 0;               ///< predictions judged
};

struct ModelSummary {
  std::string name;
  std::string note;
  bool predicts = false;  ///< false: never began, and the rest says nothing
  std::vector<HorizonResult> horizons;
  double nis_mean = 0.0;
  int nis_degrees = 0;                     ///< of freedom: what nis_mean should be
  double nis_inside_95 = 0.0;              ///< share of samples inside the 95 % band
  std::vector<NamedParameter> parameters;  ///< at the end
  std::size_t refused = 0;
};

/// What is measured `horizon_s` after each sample; nothing where two samples about that instant are
/// more than 5 usual steps apart.
[[nodiscard]] HorizonTruth truthAhead(const Trajectory& trajectory, double horizon_s);

/// Gives the model every sample; asks it after every `stride`-th.
[[nodiscard]] ModelRun runModel(MotionModel& model, const Trajectory& trajectory,
                                const std::vector<HorizonTruth>& truth, std::size_t stride = 1);

/// First sample from which on predictions are judged: `warm_up_s` after the first sample, and once
/// every model that predicts at all does so.
[[nodiscard]] std::size_t firstJudged(const Trajectory& trajectory,
                                      const std::vector<ModelRun>& runs, double warm_up_s);

/// In the order of the runs.
[[nodiscard]] std::vector<ModelSummary> summariseRuns(const Trajectory& trajectory,
                                                      const std::vector<HorizonTruth>& truth,
                                                      const std::vector<ModelRun>& runs,
                                                      double warm_up_s);

}  // namespace ringhook

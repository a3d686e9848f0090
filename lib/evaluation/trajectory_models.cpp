#include "evaluation/trajectory_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "prediction/linear_motion.h"
#include "prediction/pendulum_motion.h"
#include "prediction/swing_motion.h"

namespace ringhook {
namespace {

using Densities = std::vector<double>;
using Model = std::unique_ptr<MotionModel>;

/// What a model is made from.
struct Making {
  TrajectoryKind kind;
  double frame_s;
  ModelSettings settings;
};

PendulumMotionOptions pendulumOptions(const Making& making, const Densities& densities) {
  PendulumMotionOptions options;
  options.sample_sigma = making.settings.sample_sigma;
  options.frame_s = making.frame_s;
  options.length_m = making.settings.length_m;
  options.damping_per_s = making.settings.damping_per_s;
  options.swing_density = densities[0];
  if (densities.size() > 1) {
    options.pivot_density = densities[1];
    options.height_density = densities[2];
  }
  return options;
}

Model constantVelocity(const Making& making, const Densities& densities) {
  return makeConstantVelocity(making.kind, {making.settings.sample_sigma, densities[0]});
}
Model constantAcceleration(const Making& making, const Densities& densities) {
  return makeConstantAcceleration(making.kind, {making.settings.sample_sigma, densities[0]});
}
Model reportPendulum(const Making& making, const Densities& densities) {
  return makeReportPendulum(making.kind, pendulumOptions(making, densities));
}
Model exactPendulum(const Making& making, const Densities& densities) {
  return makeExactPendulum(making.kind, pendulumOptions(making, densities));
}

Model sphericalPendulum(const Making& making, const Densities&) {
  return makeSwingMotion(making.kind, {making.settings.sample_sigma});
}

struct Entry {
  const char* name;
  Model (*make)(const Making&, const Densities&);
  int angle_densities;  ///< process noises of a model of angles; 0: nothing to tune
  int point_densities;  ///< of a model of points
};

constexpr std::array<Entry, 5> kEntries = {{{"spherical-pendulum", sphericalPendulum, 0, 0},
                                            {"exact-pendulum", exactPendulum, 1, 3},
                                            {"report-pendulum", reportPendulum, 1, 3},
                                            {"constant-acceleration", constantAcceleration, 1, 1},
                                            {"constant-velocity", constantVelocity, 1, 1}}};

/// A linear pendulum's length and damping do not depend on its noise: found once, told from then
/// on.
Making started(const Entry& entry, Making making, const Densities& densities,
               const Trajectory& trajectory) {
  const Model model = entry.make(making, densities);
  for (std::size_t i = 0; i < trajectory.times.size() && model->parameters().empty(); ++i) {
    static_cast<void>(model->update(trajectory.times[i], trajectory.values[i]));
  }
  for (const NamedParameter& parameter : model->parameters()) {
    if (parameter.key == "length_m") {
      making.settings.length_m = parameter.value;
    } else if (parameter.key == "damping_per_s") {
      making.settings.damping_per_s = parameter.value;
    }
  }
  return making;
}

/// Mean of the logarithms of the RMS at the horizons.
double badness(MotionModel& model, const Trajectory& trajectory,
               const std::vector<HorizonTruth>& truth, double warm_up_s) {
  constexpr std::size_t kAsked = 1500;  // predictions that tell well enough
  const std::size_t stride = 1 + trajectory.times.size() / kAsked;
  const std::vector<ModelRun> run = {runModel(model, trajectory, truth, stride)};
  const ModelSummary summary = summariseRuns(trajectory, truth, run, warm_up_s).front();
  double sum = 0.0;
  for (const HorizonResult& result : summary.horizons) {
    sum += std::log(std::max(result.rms, 1e-12));
  }
  return summary.predicts && std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

constexpr int kLowestPower = -7;  // of ten, of a density
constexpr int kHighestPower = 6;
constexpr double kAsGood = 5e-4;  // of the sum of logarithms: half a thousandth of an RMS

/// The least of `cost` over one density, the others held; of all that are as good, the smallest
/// density, for the more is pushed into a filter the less it says of its own doubt.
template <class Cost>
void descendOne(Densities& densities, std::size_t which, const Cost& cost) {
  std::vector<std::pair<double, double>> tried;  // power of ten, cost
  const auto attempt = [&](double power) {
    densities[which] = std::pow(10.0, power);
    tried.emplace_back(power, cost(densities));
  };
  for (int power = kLowestPower; power <= kHighestPower; ++power) {
    attempt(power);
  }
  const auto costOf = [](const auto& one) { return one.second; };
  const auto best = std::ranges::min_element(tried, {}, costOf)->first;
  attempt(best - 0.5);
  attempt(best + 0.5);
  const double least = std::ranges::min_element(tried, {}, costOf)->second;
  std::ranges::sort(tried);
  const auto chosen =
      std::ranges::find_if(tried, [=](const auto& one) { return one.second <= least + kAsGood; });
  densities[which] = std::pow(10.0, chosen == tried.end() ? 0.0 : chosen->first);
}

template <class Cost>
Densities descend(Densities densities, const Cost& cost) {
  const int rounds = densities.size() > 1 ? 2 : 1;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < densities.size(); ++i) {
      descendOne(densities, i, cost);
    }
  }
  return densities;
}

}  // namespace

const std::vector<std::string>& motionModelNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    all.reserve(kEntries.size());
    for (const Entry& entry : kEntries) {
      all.emplace_back(entry.name);
    }
    return all;
  }();
  return names;
}

std::vector<std::string> chosenModels(const std::vector<std::string>& names) {
  const auto& known = motionModelNames();
  if (names.empty() || (names.size() == 1 && names.front() == "all")) {
    return known;
  }
  std::string list = "all";
  for (const auto& name : known) {
    list += ", " + name;
  }
  for (const auto& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError("--models " + name + ": expected one of: " + list);
    }
    if (std::count(names.begin(), names.end(), name) > 1) {
      throw InputError("--models: expected each name once, found " + name + " again");
    }
  }
  return names;
}

TunedModel makeTunedModel(const std::string& name, const Trajectory& trajectory,
                          const std::vector<HorizonTruth>& truth, const ModelSettings& settings,
                          double warm_up_s) {
  const Entry& entry = *std::find_if(kEntries.begin(), kEntries.end(),
                                     [&name](const Entry& one) { return name == one.name; });
  const Making making{trajectory.kind, medianStep(trajectory), settings};
  const int count = isAngular(trajectory.kind) ? entry.angle_densities : entry.point_densities;
  if (count == 0) {
    return {entry.make(making, {}), {}};
  }
  const Densities densities(static_cast<std::size_t>(count), 1.0);
  const Making known = started(entry, making, densities, trajectory);
  const Densities best = descend(densities, [&](const Densities& trial) {
    return badness(*entry.make(known, trial), trajectory, truth, warm_up_s);
  });
  return {entry.make(making, best), best};
}

}  // namespace ringhook

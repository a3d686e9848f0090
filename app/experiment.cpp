#include "app/experiment.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/options.h"
#include "app/progress.h"
#include "core/error.h"
#include "evaluation/noise_experiment.h"
#include "evaluation/pendulum_experiment.h"
#include "evaluation/prediction_experiment.h"
#include "evaluation/tracking_experiment.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

struct ExperimentFlags {
  std::string name;
  std::string out;
  std::string json;
  int seeds = 0;  ///< 0: as many as the experiment takes by itself
};

void runPendulum(const ExperimentFlags& flags) {
  JsonFile json(flags.json);
  const PendulumExperiment experiment = runPendulumExperiment();
  const fs::path folder =
      flags.out.empty() ? fs::path("out/experiment-pendulum") : fs::path(flags.out);
  writePendulumOutputs(folder, experiment);
  json.commit(pendulumJson(experiment));
  std::printf("%swritten: %s (report.html, summary.json, trajectories.csv)\n",
              pendulumTable(experiment).c_str(), folder.string().c_str());
}

void runNoise(const ExperimentFlags& flags) {
  JsonFile json(flags.json);
  const NoiseExperiment experiment = runNoiseExperiment();
  const fs::path folder =
      flags.out.empty() ? fs::path("out/experiment-noise") : fs::path(flags.out);
  writeNoiseOutputs(folder, experiment);
  json.commit(noiseJson(experiment));
  std::printf("%swritten: %s (report.html, summary.json, noise.csv)\n",
              noiseTable(experiment).c_str(), folder.string().c_str());
}

void runPrediction(const ExperimentFlags& flags) {
  JsonFile json(flags.json);
  PredictionCounts counts;
  if (flags.seeds > 0) {
    counts.seeds = counts.stops = counts.consistency = flags.seeds;
  }
  Progress progress("predicting");
  const auto hook = hookFor(progress);
  const PredictionExperiment experiment =
      runPredictionExperiment(counts, [&](double done) { hook(done, ""); });
  const fs::path folder =
      flags.out.empty() ? fs::path("out/experiment-prediction") : fs::path(flags.out);
  writePredictionOutputs(folder, experiment);
  json.commit(predictionJson(experiment));
  std::printf("%swritten: %s (report.html, summary.json, stop.csv)\n",
              predictionTable(experiment).c_str(), folder.string().c_str());
}

void runTracking(const ExperimentFlags& flags) {
  JsonFile json(flags.json);
  TrackingExperiment experiment;
  {
    Progress progress("looking at 21 steps");
    const auto hook = hookFor(progress);
    TrackingOptions options;
    options.step = [&](double done) { hook(done, ""); };
    experiment = runTrackingExperiment(options);
  }
  const fs::path folder =
      flags.out.empty() ? fs::path("out/experiment-tracking") : fs::path(flags.out);
  writeTrackingOutputs(folder, experiment);
  json.commit(trackingJson(experiment));
  std::printf("%swritten: %s (report.html, summary.json, steps.csv)\n",
              trackingTable(experiment).c_str(), folder.string().c_str());
}

struct Experiment {
  const char* name;
  void (*run)(const ExperimentFlags&);
};

constexpr Experiment kExperiments[] = {{"pendulum", runPendulum},
                                       {"noise", runNoise},
                                       {"prediction", runPrediction},
                                       {"tracking", runTracking}};

void runExperiment(const ExperimentFlags& flags) {
  std::string known;
  for (const Experiment& experiment : kExperiments) {
    if (flags.name == experiment.name) {
      if (flags.seeds > 0 && experiment.run != runPrediction) {
        throw InputError("evaluate experiment " + flags.name +
                         ": --seeds is for the experiment prediction, expected none");
      }
      experiment.run(flags);
      return;
    }
    known += (known.empty() ? "" : ", ") + std::string(experiment.name);
  }
  throw InputError("evaluate experiment " + flags.name + ": expected one of: " + known);
}

}  // namespace

void addExperimentCommand(CLI::App& evaluate) {
  auto flags = std::make_shared<ExperimentFlags>();
  CLI::App& command = addCommand(
      evaluate, "experiment", "Repeat an experiment of the 2007 report beside its own numbers.",
      "pendulum: 1 m, 1 kg, released at 1 rad, D = 0 and 0.5; and the cell's "
      "hook.\n"
      "noise: the step-wise motion, predicted with other and other noise "
      "values.\n"
      "prediction: simulated hooks that travel and swing, seen for 3 s; a belt "
      "that stops.\n"
      "tracking: 21 simulated pairs of pictures, positions and one-step "
      "predictions.\n"
      "Example: ringhook evaluate experiment pendulum --json pendulum.json");
  command.add_option("NAME", flags->name, "pendulum, noise, prediction or tracking")->required();
  command.add_option("--out", flags->out, "folder for the results (out/experiment-NAME)");
  command.add_option("--seeds", flags->seeds, "prediction: runs of each kind (200, 500 and 1000)")
      ->check(CLI::Range(1, 1000000));
  addJsonOption(command, flags->json, "also write summary.json to this file");
  command.callback([flags] { runExperiment(*flags); });
}

}  // namespace ringhook

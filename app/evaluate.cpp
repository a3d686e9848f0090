#include "app/evaluate.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

#include "app/experiment.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/trajectory.h"
#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "camera/sequence.h"
#include "camera/visp_camera_xml.h"
#include "core/error.h"
#include "evaluation/sequence_outputs.h"
#include "evaluation/summary_json.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

struct SequenceFlags {
  std::string folder;
  std::string left;
  std::string right;
  std::string rig;
  std::string target;
  std::string settings;
  std::string start;
  std::string truth;
  std::vector<std::string> methods;
  double gate_mm = 10.0;
  double rate_hz = 0.0;
  std::string out;
  std::string json;
};

constexpr auto kExample = R"(Examples:
  ringhook evaluate sequence datasets/visp-cube --method edges,edges-visp --out out/cube
  ringhook evaluate sequence --left 'left/*.png' --right 'right/*.png' --rig rig.yaml --target marker.yaml)";

ImageSize sizeOf(const GrayImage& image) { return {image.width, image.height}; }

/// Size of the first left image, for a ViSP camera file that does not tell it.
ImageSize firstImageSize(const SequenceFlags& flags, const Sequence& sequence) {
  if (!sequence.frames.empty()) {
    return sizeOf(readGrayImage(sequence.frames.front().left));
  }
  if (isVideoName(flags.left)) {
    const auto image = VideoReader(flags.left).next();
    return image ? sizeOf(*image) : ImageSize{};
  }
  const auto files = filesMatching(flags.left);
  return files.empty() ? ImageSize{} : sizeOf(readGrayImage(files.front()));
}

/// What the folder says, with the flags in front of it.
Sequence describedSequence(const SequenceFlags& flags) {
  if (flags.folder.empty() == flags.left.empty()) {
    throw InputError("evaluate sequence: expected either a sequence folder or --left");
  }
  Sequence sequence;
  if (flags.folder.empty()) {
    sequence.name = fs::path(flags.left).stem().string();
    std::replace_if(
        sequence.name.begin(), sequence.name.end(),
        [](char c) { return c == '*' || c == '?' || c == '%' || c == '['; }, '_');
  } else {
    sequence = openSequence(flags.folder);
  }
  if (!flags.rig.empty()) {
    sequence.rig_file = flags.rig;
    sequence.rig.reset();
  }
  if (!flags.target.empty()) {
    sequence.target_file = flags.target;
  }
  if (!flags.settings.empty()) {
    sequence.settings_file = flags.settings;
  }
  if (!flags.start.empty()) {
    sequence.c1Mo_start = poseFromText(flags.start, "--start");
  }
  if (!flags.truth.empty()) {
    sequence.c1Mo_truth = readStampedPoses(flags.truth);
  }
  return sequence;
}

StereoRig rigOf(const SequenceFlags& flags, const Sequence& sequence) {
  if (sequence.rig) {
    return *sequence.rig;
  }
  if (sequence.rig_file.empty()) {
    throw InputError("--rig is missing: expected rig.yaml or a ViSP camera file (.xml)");
  }
  const bool visp = sequence.rig_file.extension() == ".xml";
  return loadAnyRig(sequence.rig_file, visp ? firstImageSize(flags, sequence) : ImageSize{});
}

double rateOf(const SequenceFlags& flags) {
  if (flags.rate_hz > 0.0) {
    return flags.rate_hz;
  }
  const double stored = isVideoName(flags.left) ? VideoReader(flags.left).rateHz() : 0.0;
  return stored > 0.0 ? stored : 30.0;
}

std::unique_ptr<ReplayStereoCamera> openCamera(const SequenceFlags& flags, const Sequence& sequence,
                                               const CameraModel& model) {
  if (flags.folder.empty()) {
    return std::make_unique<ReplayStereoCamera>(flags.left, flags.right, rateOf(flags), model.width,
                                                model.height);
  }
  return std::make_unique<ReplayStereoCamera>(sequence, model.width, model.height);
}

std::vector<EvaluationMethod> makeMethods(const SequenceFlags& flags, const Sequence& sequence,
                                          bool stereo) {
  std::vector<EvaluationMethod> methods;
  auto names = flags.methods;
  if (names.empty()) {
    names.push_back(defaultMethod(sequence.target_file));
  }
  for (const auto& name : names) {
    methods.push_back(makeMethod(name, sequence.target_file, sequence.settings_file, stereo));
  }
  return methods;
}

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<MethodRun> trackAll(ReplayStereoCamera& camera, const StereoRig& rig,
                                std::vector<EvaluationMethod>& methods, const Sequence& sequence) {
  Progress progress("tracking");
  const std::size_t expected = std::max<std::size_t>(1, camera.expectedFrames());
  SequenceRunOptions options;
  options.c1Mo_start = sequence.c1Mo_start;
  options.c1Mo_truth = sequence.c1Mo_truth;
  options.clock_s = steadySeconds;
  options.proceed = [&](std::size_t done) {
    progress.show(static_cast<double>(done) / static_cast<double>(expected),
                  "frame " + std::to_string(done));
    return !interruptRequested();
  };
  return runSequence(camera, Rectifier(rig), methods, options);
}

/// Prints, and throws if the job failed.
void conclude(const SequenceOutputs& outputs, const fs::path& folder) {
  std::printf("%s", summaryTable(outputs.summaries).c_str());
  for (const auto& summary : outputs.summaries) {
    if (summary.false_poses && *summary.false_poses > 0) {
      std::printf("%s: %zu poses are wrong by more than %g mm\n", summary.method.c_str(),
                  *summary.false_poses, outputs.gate_mm);
    }
  }
  std::printf("written: %s (report.html, summary.json, estimate.tum, frames.csv)\n",
              folder.string().c_str());
  std::fflush(stdout);
  if (outputs.interrupted) {
    throw Interrupted("stopped after " + std::to_string(outputs.runs.front().frames.size()) +
                      " frames; their results are in " + folder.string());
  }
  if (outputs.summaries.front().frames_tracked == 0) {
    const auto& frames = outputs.runs.front().frames;
    throw Error("the target was not found in any frame of " + outputs.sequence + ": " +
                (frames.empty() ? "there is no frame" : frames.back().reason));
  }
}

void evaluateSequence(const SequenceFlags& flags) {
  const Sequence sequence = describedSequence(flags);
  if (sequence.target_file.empty()) {
    throw InputError("--target is missing: expected a tag plate (.yaml) or a model (.cao)");
  }
  if (!(flags.gate_mm > 0.0)) {
    throw InputError("--gate-mm: expected a positive number of millimetres");
  }
  const StereoRig rig = rigOf(flags, sequence);
  const auto camera = openCamera(flags, sequence, rig.left);
  const bool both =
      flags.folder.empty() ? !flags.right.empty() : !sequence.frames.front().right.empty();
  JsonFile json(flags.json);
  auto methods = makeMethods(flags, sequence, both && rig.right);
  SequenceOutputs outputs;
  outputs.sequence = sequence.name;
  outputs.target = sequence.target_file.filename().string();
  outputs.notes = sequence.notes;
  outputs.gate_mm = flags.gate_mm;
  outputs.runs = trackAll(*camera, rig, methods, sequence);
  outputs.interrupted = interruptRequested() && !camera->finished();
  for (const auto& run : outputs.runs) {
    outputs.summaries.push_back(summarise(run, flags.gate_mm));
  }
  const fs::path folder =
      flags.out.empty() ? fs::path("out") / ("evaluate-" + sequence.name) : fs::path(flags.out);
  writeSequenceOutputs(folder, outputs);
  json.commit(
      summaryJson(outputs.summaries, outputs.sequence, outputs.gate_mm, outputs.interrupted));
  conclude(outputs, folder);
}

void addSequenceCommand(CLI::App& evaluate) {
  auto flags = std::make_shared<SequenceFlags>();
  CLI::App* command = evaluate.add_subcommand(
      "sequence", "Track a stored sequence: table, JSON, TUM trajectory, report page.");
  command->footer(kExample);
  command->add_option("DIR", flags->folder, "sequence folder (sequence.yaml, or EuRoC/ASL)");
  command->add_option("--left", flags->left, "left images (quoted glob) or video, instead of DIR");
  command->add_option("--right", flags->right, "right images or video")->needs("--left");
  command->add_option("--rate", flags->rate_hz,
                      "frames per second of --left [Hz] (video's, or 30)");
  command->add_option("--rig", flags->rig, "rig.yaml, or a ViSP camera file (.xml)");
  command->add_option("--target", flags->target, "tag plate (.yaml) or edge model (.cao)");
  command->add_option("--settings", flags->settings, "ViSP tracker settings (.xml)");
  command->add_option("--start", flags->start,
                      "target in the left camera, x,y,z,qx,qy,qz,qw [m], or a ViSP .pos file");
  command->add_option("--truth", flags->truth, "true poses: time_s,x,y,z,qx,qy,qz,qw");
  command
      ->add_option("--method", flags->methods,
                   "edges, edges-visp, marker-joint, marker-midpoint, marker-single; the first is "
                   "the main one")
      ->delimiter(',');
  command->add_option("--gate-mm", flags->gate_mm, "a pose wrong by more is a false pose [mm]")
      ->capture_default_str();
  command->add_option("--out", flags->out, "folder for the results (out/evaluate-NAME)");
  command->add_option("--json", flags->json, "also write summary.json to this file");
  command->callback([flags] { evaluateSequence(*flags); });
}

}  // namespace

void addEvaluateCommand(CLI::App& app) {
  CLI::App* evaluate = app.add_subcommand(
      "evaluate", "Evaluate tracking and prediction offline and compare methods.");
  evaluate->footer("Example: ringhook evaluate sequence datasets/visp-cube");
  evaluate->require_subcommand(1);
  addSequenceCommand(*evaluate);
  addTrajectoryCommand(*evaluate);
  addCompareCommand(*evaluate);
  addExperimentCommand(*evaluate);
}

}  // namespace ringhook

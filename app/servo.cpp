#include "app/servo.h"

#include <cstdio>
#include <memory>
#include <string>

#include "app/interrupt.h"
#include "app/options.h"
#include "app/progress.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "evaluation/servo_run.h"
#include "evaluation/servo_summary.h"

namespace ringhook {
namespace {

struct ServoArguments {
  std::string cell = RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml";
  std::string scenario;
  std::string tracker = "marker";
  std::string arm_link = "direct";
  std::string out = "out/servo";
  std::string json;
  int cycles = 3;
  std::uint64_t seed = 1;
};

ServoJob jobFrom(const ServoArguments& arguments) {
  ServoJob job;
  job.cell_file = arguments.cell;
  job.scenario = arguments.scenario;
  job.tracker = arguments.tracker == "edges" ? TrackerKind::kEdges : TrackerKind::kMarker;
  job.arm_link = arguments.arm_link == "rx60" ? ArmLink::kRx60 : ArmLink::kDirect;
  job.cycles = arguments.cycles;
  job.seed = arguments.seed;
  job.out = arguments.out;
  return job;
}

void printStatistic(const char* name, const Statistics& s, double factor, const char* unit) {
  if (s.count() > 0) {
    std::printf("%-34s mean %6.2f  max %6.2f %s\n", name, s.mean() * factor, s.max() * factor,
                unit);
  }
}

void printDevices(const LiveReport& live) {
  const AravisCounts& c = live.cameras;
  printStatistic("between frames, a hook tracked:", live.frame_interval_s, 1e3, "ms");
  std::printf("%-34s %lld, unpaired %lld, lost %lld, passed over %lld\n",
              "pairs of images:", static_cast<long long>(c.pairs),
              static_cast<long long>(c.unpaired_left + c.unpaired_right),
              static_cast<long long>(c.left.lost_images + c.right.lost_images),
              static_cast<long long>(live.frames_passed_over));
  std::printf("%-34s %lld, left out %lld; period %.3f ms, jitter %.3f ms, priority %s\n",
              "velocities sent to the arm:", static_cast<long long>(live.arm.commands),
              static_cast<long long>(live.arm.left_out), 1e3 * live.arm.arrivals.period_s,
              1e3 * live.arm.arrivals.jitter_s, nameOf(live.link_priority));
}

void printEnd(const ServoReport& report, const ServoArguments& arguments) {
  const LoopStatistics& loop = report.statistics;
  if (report.live) {
    std::printf("\n%d of %d rings let go over the tip; nobody judged whether they hang\n",
                ringsReleased(report), arguments.cycles);
  } else {
    std::printf("\n%d of %d rings hang, judged by the simulated physics 2 s after release\n",
                ringsHung(report), arguments.cycles);
  }
  printStatistic("prediction error, 100 ms ahead:", loop.prediction_error_m, 1e3, "mm");
  printStatistic("fixes against the true hook:", loop.fix_error_m, 1e3, "mm");
  printStatistic("age of frames when acted upon:", loop.frame_age_s, 1e3, "ms");
  std::printf("%-34s %d of %d\n",
              "frames with a fix while tracking:", loop.frames - loop.frames_without_fix,
              loop.frames);
  std::printf("%-34s %d\n", "limit violations:", loop.limit_violations);
  if (report.live) {
    printDevices(*report.live);
  }
  std::printf("wrote %s/summary.json%s%s\n", arguments.out.c_str(),
              report.sequence.empty() ? "" : ", sequence/",
              report.picture.empty() ? "" : ", hanging.png");
}

ServoReport runWithProgress(const ServoJob& job) {
  Progress progress("hanging rings");
  const auto tell = [&](int attempt, TaskPhase phase, double time_s) {
    // A hook takes the same steps every time, so phases tell how far it is.
    const double within = static_cast<double>(phase) / static_cast<double>(TaskPhase::kDone);
    progress.show((attempt + within) / job.cycles,
                  "hook " + std::to_string(attempt + 1) + ", " + phaseName(phase) +
                      ", t = " + std::to_string(static_cast<int>(time_s)) + " s");
  };
  const auto done = [&](int attempt, const ServoAttempt& result) {
    progress.clear();
    std::printf("%s%s", attempt == 0 ? servoTableHead().c_str() : "",
                servoTableRow(attempt, result).c_str());
    std::fflush(stdout);
  };
  ServoReport report = runServo(job, interruptRequested(), tell, done);
  progress.clear();
  return report;
}

/// Throws what makes the program end with an exit code other than 0.
void conclude(const ServoReport& report, const ServoJob& job) {
  if (!report.failure.empty()) {
    throw DeviceError(report.failure);
  }
  if (report.interrupted) {
    throw Interrupted("stopped by the operator: the arm stands still, finished hooks are in " +
                      (job.out / "summary.json").string());
  }
  if ((report.live ? ringsReleased(report) : ringsHung(report)) < job.cycles) {
    throw Error("not every ring hangs: the table above says why");
  }
}

void runCommand(const ServoArguments& arguments) {
  const ServoJob job = jobFrom(arguments);
  // Opened first: a place that cannot be written is found out before the work, not after it.
  AtomicFile summary(job.out / "summary.json");
  JsonFile copy(arguments.json);
  const ServoReport report = runWithProgress(job);
  const std::string json = servoSummaryJson(job, report);
  summary.stream() << json;
  summary.commit();
  copy.commit(json);
  printEnd(report, arguments);
  conclude(report, job);
}

}  // namespace

void addServoCommand(CLI::App& app) {
  auto arguments = std::make_shared<ServoArguments>();
  CLI::App* command = app.add_subcommand("servo", "Hangs rings on passing, swinging hooks");
  command->footer(
      "Example: ringhook servo --cycles 3 --seed 1 --tracker edges --out out/servo\n"
      "Ctrl-C stops the arm first and keeps what was finished.");
  command->add_option("--cell", arguments->cell, "Cell file; default: the simulated cell")
      ->type_name("FILE");
  command->add_option("--scenario", arguments->scenario, "Scenario of a simulated cell")
      ->type_name("NAME");
  command->add_option("--tracker", arguments->tracker, "How the hook is seen")
      ->check(CLI::IsMember({"marker", "edges"}));
  command
      ->add_option("--arm-link", arguments->arm_link,
                   "How the simulated arm is reached: in process, or over the RX60's protocol")
      ->check(CLI::IsMember({"direct", "rx60"}));
  command->add_option("--cycles", arguments->cycles, "Hooks to serve")->check(CLI::Range(1, 10000));
  command->add_option("--seed", arguments->seed, "Of everything random in a simulated cell")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", arguments->out, "Folder for results; default out/servo")
      ->type_name("DIR");
  command->add_option("--json", arguments->json, "Also write summary.json's content here")
      ->type_name("FILE");
  command->callback([arguments] { runCommand(*arguments); });
}

}  // namespace ringhook

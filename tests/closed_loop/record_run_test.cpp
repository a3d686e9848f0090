// What a recording of the simulated cell says, against what the cell itself logged.

#include "evaluation/record_run.h"

#include <gmock/gmock.h>

#include "../support/scratch_folder.h"
#include "camera/csv_table.h"
#include "camera/replay_camera.h"
#include "camera/sequence.h"
#include "core/error.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

const std::array<Window, 2> kWindows = {Window{300, 800, 200, 160}, Window{320, 810, 220, 120}};

RecordJob smallJob(const fs::path& out) {
  RecordJob job;
  job.cell_file = fs::path(RINGHOOK_SOURCE_DIR) / "app/config/cell-sim.yaml";
  job.out = out;
  job.frames = 6;
  job.windows = kWindows;
  return job;
}

RecordReport record(const RecordJob& job) {
  const std::atomic<bool> stop{false};
  return runRecord(job, stop, [](double, const std::string&) {});
}

TEST(RecordRun, TheSameSeedGivesTheSameBytes) {
  const ScratchFolder folder;
  for (const auto* name : {"a", "b"}) {
    EXPECT_EQ(record(smallJob(folder.path() / name)).frames, 6U);
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "a")) {
    if (entry.is_regular_file()) {
      const auto inside = entry.path().lexically_relative(folder.path() / "a");
      EXPECT_EQ(textOf(entry.path()), textOf(folder.path() / "b" / inside)) << inside;
      ++files;
    }
  }
  EXPECT_GE(files, 12 + 5);
  RecordJob other = smallJob(folder.path() / "c");
  other.choice.seed = 2;
  record(other);
  EXPECT_NE(textOf(folder.path() / "a/left/000003.png"),
            textOf(folder.path() / "c/left/000003.png"));
}

TEST(RecordRun, FixedWindowsAndRateAreKept) {
  const ScratchFolder folder;
  RecordJob job = smallJob(folder.path() / "s");
  job.rate_hz = 25.0;
  const RecordReport report = record(job);
  EXPECT_EQ(report.missed + report.left_out + report.before, 0U);
  ReplayStereoCamera camera(openSequence(job.out), 2048, 2048);
  std::optional<Time> before;
  while (!camera.finished()) {
    const auto frame = camera.grab(0.0);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->left_window, kWindows[0]);
    EXPECT_EQ(frame->right_window, kWindows[1]);
    if (before) {
      EXPECT_NEAR(frame->time - *before, 0.04, 1e-9);
    }
    before = frame->time;
  }
}

TEST(RecordRun, SecondsCountFromTheFirstFrame) {
  const ScratchFolder folder;
  RecordJob job = smallJob(folder.path() / "s");
  job.frames = 0;
  job.seconds = 0.2;
  EXPECT_EQ(record(job).frames, 10U);  // at 50 Hz
}

/// Poses of hook `hook` in f by time, from the cell's own log.
std::map<long long, Pose> loggedHook(const fs::path& file, int hook) {
  const CsvTable table(file);
  const auto value = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name));
  };
  std::map<long long, Pose> poses;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (value(row, "hook") == hook) {
      const Eigen::Vector3d p(value(row, "x_m"), value(row, "y_m"), value(row, "z_m"));
      const Eigen::Quaterniond q(value(row, "qw"), value(row, "qx"), value(row, "qy"),
                                 value(row, "qz"));
      poses[std::llround(1e9 * value(row, "time_s"))] = makePose(p, q);
    }
  }
  return poses;
}

TEST(RecordRun, FollowsTheHookAndTellsItsTruth) {
  const ScratchFolder folder;
  RecordJob job = smallJob(folder.path() / "s");
  job.windows.reset();
  job.follow = TrackerKind::kMarker;
  job.frames = 30;
  const RecordReport report = record(job);
  EXPECT_EQ(report.frames, 30U);
  EXPECT_EQ(report.without_truth, 0U);
  EXPECT_GT(report.before, 0U);
  const Sequence sequence = openSequence(job.out);
  ASSERT_EQ(sequence.c1Mo_truth.size(), 30U);
  ASSERT_TRUE(sequence.c1Mo_start);
  // The first fix is off by calibration errors and noise of a millimetre or so.
  EXPECT_LT((sequence.c1Mo_start->translation() - sequence.c1Mo_truth[0].pose.translation()).norm(),
            0.005);
  const Pose c1Mf = loadRig(job.out / "truth/cameras.yaml").fMc1->inverse();
  const auto hook = loggedHook(job.out / "truth/hooks.csv", 0);
  int compared = 0;
  for (const StampedPose& sample : sequence.c1Mo_truth) {
    const auto logged = hook.find(sample.time.nanoseconds());
    if (logged != hook.end()) {
      const Twist off = logSe3((c1Mf * logged->second).inverse() * sample.pose);
      EXPECT_LT(off.head<3>().norm(), 1e-6);
      EXPECT_LT(off.tail<3>().norm(), 1e-6);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

TEST(RecordRun, TheFlangeIsWhereTheArmTrulyIs) {
  const ScratchFolder folder;
  const RecordJob job = smallJob(folder.path() / "s");
  record(job);
  const Sequence sequence = openSequence(job.out);
  ASSERT_GT(sequence.robot.size(), 10U);
  EXPECT_NEAR(sequence.robot[1].time - sequence.robot[0].time, 0.004, 1e-9);
  const CsvTable arm(job.out / "truth/arm.csv");
  const Eigen::Vector3d truth(arm.number(0, arm.column("x_m")), arm.number(0, arm.column("y_m")),
                              arm.number(0, arm.column("z_m")));
  EXPECT_LT((sequence.robot[0].fMe.translation() - truth).norm(), 0.002);  // the arm's accuracy
}

TEST(RecordRun, NoHookWithinTheWaitIsSaidAndNothingIsMade) {
  const ScratchFolder folder;
  RecordJob job = smallJob(folder.path() / "s");
  job.windows.reset();
  job.follow = TrackerKind::kMarker;
  job.wait_s = 0.3;
  EXPECT_THAT(messageOf<Error>([&] { record(job); }), testing::HasSubstr("no hook came into view"));
  EXPECT_FALSE(fs::exists(job.out));
}

TEST(RecordRun, RefusesAWindowOutsideTheImageAndAFolderInUse) {
  const ScratchFolder folder;
  RecordJob job = smallJob(folder.path() / "s");
  job.windows = {Window{3000, 0, 100, 100}, kWindows[1]};
  EXPECT_THROW(record(job), InputError);
  EXPECT_FALSE(fs::exists(job.out));
  folder.write("s/letter.txt", "dear");
  job.windows = kWindows;
  EXPECT_THROW(record(job), InputError);
  job.choice.scenario = "nowhere";
  job.out = folder.path() / "t";
  EXPECT_THAT(messageOf<InputError>([&] { record(job); }), testing::HasSubstr("nowhere"));
}

}  // namespace
}  // namespace ringhook

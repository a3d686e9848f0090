// What a recording leaves on the disk, whatever ends it.

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "../../support/scratch_folder.h"
#include "camera/recording_folder.h"
#include "camera/replay_camera.h"
#include "camera/sequence_recorder.h"
#include "camera/table_file.h"
#include "core/error.h"
#include "small_recording.h"
#include "tests/support/tiny_disk.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A frame that does not compress: 19200 bytes for each image.
StereoFrame noisyFrame(int number) {
  StereoFrame frame;
  frame.index = static_cast<std::uint64_t>(number);
  frame.time = Time::fromNanoseconds(20'000'000LL * (number + 1));
  frame.left = GrayImage(kWidth, kHeight);
  frame.left_window = {0, 0, kWidth, kHeight};
  std::uint32_t state = 12345U + static_cast<std::uint32_t>(number);
  for (std::uint8_t& pixel : frame.left.pixels) {
    state = state * 1664525U + 1013904223U;
    pixel = static_cast<std::uint8_t>(state >> 24U);
  }
  frame.right = frame.left;
  frame.right_window = frame.left_window;
  return frame;
}

std::unique_ptr<SequenceWriter> writerIn(const fs::path& folder) {
  return std::make_unique<SequenceWriter>(folder, test::someInfo(),
                                          test::smallRig(kWidth, kHeight));
}

/// Plays all of it; the number of frames.
std::size_t playable(const fs::path& folder) {
  const Sequence sequence = openSequence(folder);
  ReplayStereoCamera camera(sequence, kWidth, kHeight);
  std::size_t frames = 0;
  while (!camera.finished()) {
    frames += camera.grab(0.0) ? 1 : 0;
  }
  EXPECT_EQ(frames, sequence.frames.size());
  return frames;
}

TEST(TableFile, EveryRowIsInTheFileAtOnce) {
  const ScratchFolder folder;
  TableFile table(folder.path() / "t.csv", "a,b\n");
  table.append("1,2\n");
  EXPECT_EQ(textOf(folder.path() / "t.csv"), "a,b\n1,2\n");
  table.close();
  table.close();
}

TEST(TableFile, AFullDiskIsSaid) {
  try {
    TableFile table("/dev/full", "a,b\n");
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("/dev/full"), HasSubstr("No space left on device")));
    EXPECT_EQ(e.exitCode(), 1);
  }
}

TEST(TableFile, ARowThatDoesNotFitIsTakenBack) {
  const ScratchFolder folder;
  const auto result = test::runOnTinyDisk(folder.path(), 64 * 1024, [&] {
    TableFile table(folder.path() / "t.csv", "0123456\n");
    const std::string row = std::string(4999, 'x') + "\n";
    EXPECT_THROW(
        {
          for (int i = 0; i < 100; ++i) {
            table.append(row);
          }
        },
        Error);
    EXPECT_EQ(fs::file_size(folder.path() / "t.csv") % 5000, 8U);
    fs::remove(folder.path() / "filler");
    EXPECT_NO_THROW(table.append("short\n"));  // what is free yet still fits
  });
  if (!result.possible) {
    GTEST_SKIP() << "no disk of its own to be had here";
  }
  EXPECT_TRUE(result.passed);
}

TEST(SequenceRecorder, AFullDiskKeepsTheWholeFrames) {
  const ScratchFolder folder;
  const auto result = test::runOnTinyDisk(folder.path(), 600 * 1024, [&] {
    SequenceRecorder recorder(writerIn(folder.path() / "s"), 4, SequenceRecorder::WhenFull::kWait);
    std::string said;
    try {
      for (int i = 0; i < 100; ++i) {
        recorder.addFrame(noisyFrame(i), Pose::Identity());
        recorder.addRobot(noisyFrame(i).time, JointVector::Zero(), Pose::Identity());
      }
      recorder.close();
    } catch (const Error& e) {
      said = e.what();
    }
    EXPECT_THAT(said, HasSubstr("writing"));
    EXPECT_NO_THROW(recorder.close());
    const std::size_t frames = playable(folder.path() / "s");
    EXPECT_EQ(frames, recorder.framesStored());
    EXPECT_GT(frames, 5U);
    EXPECT_LT(frames, 16U);  // 600 kB hold fifteen pairs
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "s/left"), {}),
              static_cast<std::ptrdiff_t>(frames));
  });
  if (!result.possible) {
    GTEST_SKIP() << "no disk of its own to be had here";
  }
  EXPECT_TRUE(result.passed);
}

TEST(SequenceRecorder, AKilledRecordingIsASequenceOfItsWholeFrames) {
  const ScratchFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    SequenceRecorder recorder(writerIn(folder.path() / "s"), 4, SequenceRecorder::WhenFull::kWait);
    for (int i = 0; true; ++i) {
      recorder.addFrame(noisyFrame(i), Pose::Identity());
      if (recorder.framesStored() > 20) {
        kill(getpid(), SIGKILL);  // while others are being written
      }
    }
  }
  ASSERT_GT(child, 0);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_GE(playable(folder.path() / "s"), 21U);
  EXPECT_NO_THROW(checkRecordingFolder(folder.path() / "s", true));
}

TEST(SequenceRecorder, WritesTheSameBytesEveryTime) {
  const ScratchFolder folder;
  for (const auto* name : {"a", "b"}) {
    SequenceRecorder recorder(writerIn(folder.path() / name), 2, SequenceRecorder::WhenFull::kWait);
    for (int i = 0; i < 12; ++i) {
      recorder.addRobot(noisyFrame(i).time, JointVector::Constant(i), Pose::Identity());
      EXPECT_TRUE(recorder.addFrame(noisyFrame(i), Pose::Identity()));
    }
    recorder.close();
    EXPECT_EQ(recorder.framesStored(), 12U);
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "a")) {
    if (entry.is_regular_file()) {
      const fs::path other =
          folder.path() / "b" / entry.path().lexically_relative(folder.path() / "a");
      EXPECT_EQ(textOf(entry.path()), textOf(other)) << entry.path();
      ++files;
    }
  }
  EXPECT_EQ(files, 24 + 5);
}

TEST(SequenceRecorder, LeavesOutTheNewestWhenTheDiskIsSlowAndSaysSo) {
  const ScratchFolder folder;
  SequenceRecorder recorder(writerIn(folder.path() / "s"), 2,
                            SequenceRecorder::WhenFull::kLeaveOut);
  std::size_t accepted = 0;
  std::size_t left_out = 0;
  for (int i = 0; i < 200; ++i) {  // much faster than images are compressed
    (recorder.addFrame(noisyFrame(i), std::nullopt) ? accepted : left_out) += 1;
  }
  recorder.close();
  EXPECT_GT(left_out, 0U);
  EXPECT_EQ(recorder.framesStored(), accepted);
  EXPECT_EQ(playable(folder.path() / "s"), accepted);
}

std::string refusalOf(const fs::path& folder, bool overwrite) {
  return messageOf<InputError>([&] { checkRecordingFolder(folder, overwrite); });
}

TEST(RecordingFolder, OnlyANewOrEmptyOneIsTakenUnasked) {
  const ScratchFolder folder;
  EXPECT_EQ(refusalOf(folder.path() / "new", false), "");
  EXPECT_EQ(refusalOf(folder.path(), false), "");
  folder.write("letter.txt", "dear");
  EXPECT_THAT(refusalOf(folder.path(), false), HasSubstr("--overwrite"));
  EXPECT_THAT(refusalOf(folder.path() / "letter.txt", false), HasSubstr("expected a folder"));
  EXPECT_THAT(refusalOf(folder.path(), true), HasSubstr("holds no recording"));
}

TEST(RecordingFolder, NothingButARecordingIsOverwritten) {
  const ScratchFolder folder;
  SequenceInfo with_target = test::someInfo();
  with_target.target = folder.write("plate-7.yaml", "family: tag36h11\n");
  const fs::path recording = folder.path() / "s";
  {
    SequenceWriter writer(recording, with_target, test::smallRig(kWidth, kHeight));
    writer.addFrame(noisyFrame(0));
    writer.addTruth(noisyFrame(0).time, Pose::Identity());
  }
  folder.write("s/truth/hooks.csv", "time_s\n");
  folder.write("s/left/.000001.partial.png", "");
  EXPECT_THAT(refusalOf(recording, false), HasSubstr("--overwrite"));
  EXPECT_EQ(refusalOf(recording, true), "");
  for (const auto* other :
       {"s/thesis.tex", "s/left/holiday.png", "s/other.yaml", "s/notes/a.csv"}) {
    folder.write(other, "mine");
    EXPECT_THAT(refusalOf(recording, true), HasSubstr("does not belong")) << other;
    fs::remove(folder.path() / other);
  }
  fs::remove(folder.path() / "s/notes");
  clearRecordingFolder(recording);
  EXPECT_TRUE(fs::is_empty(recording));
  EXPECT_TRUE(fs::exists(folder.path() / "plate-7.yaml"));
}

TEST(RecordingFolder, AFolderInItThatCannotBeReadIsSaid) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may read everything";
  }
  const ScratchFolder folder;
  folder.write("s/sequence.yaml", "name: s\n");
  fs::create_directories(folder.path() / "s/left");
  fs::permissions(folder.path() / "s/left", fs::perms::none);
  EXPECT_THAT(refusalOf(folder.path() / "s", true), HasSubstr("cannot look into"));
  fs::permissions(folder.path() / "s/left", fs::perms::owner_all);
}

TEST(RecordingFolder, TooLittleSpaceIsSaidAheadWithBothSizes) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(requireFreeSpace(folder.path() / "not/yet/made", 1000));
  EXPECT_THAT(messageOf<Error>([&] {
                requireFreeSpace(folder.path() / "not/yet/made", std::uint64_t{1} << 60U);
              }),
              AllOf(HasSubstr("1152921504607 MB"), HasSubstr("are free")));
}

}  // namespace
}  // namespace ringhook

#include "camera/sequence_writer.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "../../support/scratch_folder.h"
#include "camera/replay_camera.h"
#include "core/error.h"
#include "small_recording.h"

namespace ringhook {
namespace {

/// A frame whose pixels tell its number, read from a window.
StereoFrame numberedFrame(int number) {
  StereoFrame frame;
  frame.index = static_cast<std::uint64_t>(number);
  frame.time = Time::fromNanoseconds(1'700'000'000'000'000'001 + number * 20'000'000LL);
  frame.left = GrayImage(8, 6, static_cast<std::uint8_t>(10 + number));
  frame.right = GrayImage(9, 5, static_cast<std::uint8_t>(100 + number));
  frame.left_window = {3, 4, 8, 6};
  frame.right_window = {5, 2, 9, 5};
  return frame;
}

TEST(SequenceWriter, WhatWasWrittenIsReplayed) {
  const ScratchFolder folder;
  const Pose c1Mo = makePoseThetaU({0.1, -0.2, 1.3}, {0.3, 0.2, -0.1});
  SequenceWriter writer(folder.path(), test::someInfo(), test::smallRig(32, 24));
  for (int i = 0; i < 3; ++i) {
    const StereoFrame frame = numberedFrame(i);
    writer.addFrame(frame);
    writer.addTruth(frame.time, c1Mo);
    writer.addRobot(frame.time, JointVector::Constant(0.25), c1Mo.inverse());
  }
  writer.close();

  const Sequence sequence = openSequence(folder.path());
  ASSERT_EQ(sequence.c1Mo_truth.size(), 3U);
  EXPECT_TRUE(sequence.c1Mo_truth[2].pose.isApprox(c1Mo, 1e-8));
  ASSERT_EQ(sequence.robot.size(), 3U);
  EXPECT_EQ(sequence.robot[1].position(5), 0.25);
  EXPECT_TRUE(sequence.robot[1].fMe.isApprox(c1Mo.inverse(), 1e-8));
  ReplayStereoCamera camera(sequence, 32, 24);
  for (int i = 0; i < 3; ++i) {
    const auto frame = camera.grab(0.0);
    const StereoFrame expected = numberedFrame(i);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->left.pixels, expected.left.pixels);
    EXPECT_EQ(frame->right.pixels, expected.right.pixels);
    EXPECT_EQ(frame->left_window, expected.left_window);
    EXPECT_EQ(frame->right_window, expected.right_window);
    EXPECT_EQ(frame->index, expected.index);
    // Microseconds of the distant epoch survive the text.
    EXPECT_NEAR(frame->time - expected.time, 0.0, 1e-6);
  }
  EXPECT_TRUE(camera.finished());
}

TEST(SequenceWriter, AWindowInTheCornerOfTheImageIsReplayed) {
  const ScratchFolder folder;
  SequenceWriter writer(folder.path(), test::someInfo(), test::smallRig(32, 24));
  StereoFrame frame = numberedFrame(0);
  frame.left_window = {0, 0, 8, 6};
  frame.right_window = {0, 0, 9, 5};
  writer.addFrame(frame);
  ReplayStereoCamera camera(openSequence(folder.path()), 32, 24);
  EXPECT_EQ(camera.grab(0.0)->left_window, frame.left_window);
}

TEST(SequenceWriter, AnInterruptedRunLeavesAValidSequence) {
  const ScratchFolder folder;
  try {
    SequenceWriter writer(folder.path(), test::someInfo(), test::smallRig(32, 24));
    writer.addFrame(numberedFrame(0));
    writer.addFrame(numberedFrame(1));
    throw std::runtime_error("the arm stopped");
  } catch (const std::runtime_error&) {
    EXPECT_EQ(openSequence(folder.path()).frames.size(), 2U);
  }
}

TEST(SequenceWriter, AFrameIsThereAsSoonAsItIsAdded) {
  const ScratchFolder folder;
  SequenceWriter writer(folder.path(), test::someInfo(), test::smallRig(32, 24));
  for (std::size_t i = 0; i < 3; ++i) {
    writer.addFrame(numberedFrame(static_cast<int>(i)));
    EXPECT_EQ(openSequence(folder.path()).frames.size(), i + 1);
    EXPECT_EQ(writer.frames(), i + 1);
  }
}

TEST(SequenceWriter, ForgetsAnOlderRecordingInTheSameFolder) {
  const ScratchFolder folder;
  {
    SequenceWriter older(folder.path(), test::someInfo(), test::smallRig(32, 24));
    older.addFrame(numberedFrame(0));
    older.addTruth(Time(), Pose::Identity());
  }
  SequenceWriter newer(folder.path(), test::someInfo(), test::smallRig(32, 24));
  newer.addFrame(numberedFrame(5));
  newer.close();
  const Sequence sequence = openSequence(folder.path());
  EXPECT_EQ(sequence.frames.at(0).frame, 5U);
  EXPECT_TRUE(sequence.c1Mo_truth.empty());
}

TEST(SequenceWriter, RefusesAnUnknownImageFormat) {
  const ScratchFolder folder;
  SequenceInfo info = test::someInfo();
  info.image_format = "gif";
  EXPECT_THROW(SequenceWriter(folder.path(), info, test::smallRig(32, 24)), InputError);
}

}  // namespace
}  // namespace ringhook

#include "camera/replay_camera.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "../../support/scratch_folder.h"
#include "camera/image_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Replay, PlaysImagesInTheOrderOfTheirNumbers) {
  const ScratchFolder folder;
  for (const int number : {10, 9, 1}) {
    writeGrayImage(folder.path() / ("image" + std::to_string(number) + ".pgm"),
                   GrayImage(5, 4, static_cast<std::uint8_t>(number)));
  }
  ReplayStereoCamera camera((folder.path() / "*.pgm").string(), "", 20.0, 5, 4);
  EXPECT_EQ(camera.expectedFrames(), 3U);
  for (const int number : {1, 9, 10}) {
    const auto frame = camera.grab(0.0);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->left.pixels.front(), number);
    EXPECT_EQ(frame->left_window, (Window{0, 0, 5, 4}));
    EXPECT_TRUE(frame->right.empty());
  }
  EXPECT_TRUE(camera.finished());
  EXPECT_FALSE(camera.grab(0.0));
}

TEST(Replay, TurnsColourIntoLuma) {
  const ScratchFolder folder;
  const auto file = (folder.path() / "red.png").string();
  cv::imwrite(file, cv::Mat(4, 5, CV_8UC3, cv::Scalar(0, 0, 200)));
  // ITU-R BT.601: red weighs 0.299.
  EXPECT_NEAR(readGrayImage(file).pixels.front(), 0.299 * 200.0, 1.0);
}

TEST(Replay, NamesTheImageAndBothSizesWhenTheRigDoesNotFit) {
  const ScratchFolder folder;
  writeGrayImage(folder.path() / "a.png", GrayImage(5, 4));
  ReplayStereoCamera camera((folder.path() / "a.png").string(), "", 20.0, 640, 480);
  EXPECT_THAT(messageOf<InputError>([&] { (void)camera.grab(0.0); }),
              AllOf(HasSubstr("a.png"), HasSubstr("5x4"), HasSubstr("640x480")));
}

TEST(Replay, RefusesAWindowThatLeavesTheImage) {
  Sequence sequence;
  const ScratchFolder folder;
  writeGrayImage(folder.path() / "a.png", GrayImage(5, 4));
  SequenceFrame frame;
  frame.left = folder.path() / "a.png";
  frame.left_x_px = 6;
  frame.placed = true;
  sequence.frames = {frame};
  ReplayStereoCamera camera(sequence, 10, 10);
  EXPECT_THAT(messageOf<InputError>([&] { (void)camera.grab(0.0); }), HasSubstr("column 6"));
}

TEST(Replay, NamesAnUnreadableImage) {
  const ScratchFolder folder;
  folder.write("broken.png", "this is no image");
  ReplayStereoCamera camera((folder.path() / "broken.png").string(), "", 20.0, 5, 4);
  EXPECT_THAT(messageOf<InputError>([&] { (void)camera.grab(0.0); }), HasSubstr("broken.png"));
}

TEST(Replay, RefusesSidesOfDifferentLength) {
  const ScratchFolder folder;
  writeGrayImage(folder.path() / "l1.png", GrayImage(5, 4));
  writeGrayImage(folder.path() / "l2.png", GrayImage(5, 4));
  writeGrayImage(folder.path() / "r1.png", GrayImage(5, 4));
  const auto left = (folder.path() / "l*.png").string();
  const auto right = (folder.path() / "r*.png").string();
  EXPECT_THROW(ReplayStereoCamera(left, right, 20.0, 5, 4), InputError);
  EXPECT_THROW(ReplayStereoCamera((folder.path() / "x*.png").string(), "", 20.0, 5, 4), InputError);
}

TEST(Replay, PlaysAVideo) {
  const ScratchFolder folder;
  const auto file = (folder.path() / "clip.avi").string();
  {
    cv::VideoWriter writer(file, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0, {64, 48});
    ASSERT_TRUE(writer.isOpened());
    for (const int grey : {40, 90, 140}) {
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(grey)));
    }
  }
  EXPECT_NEAR(VideoReader(file).rateHz(), 25.0, 1e-6);
  ReplayStereoCamera camera(file, "", 25.0, 64, 48);
  int frames = 0;
  for (const int grey : {40, 90, 140}) {
    const auto frame = camera.grab(0.0);
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->left.pixels.at(1000), grey, 3);
    EXPECT_NEAR(frame->time.seconds(), 0.04 * frames++, 1e-9);
  }
  EXPECT_FALSE(camera.grab(0.0));
  EXPECT_TRUE(camera.finished());
}

}  // namespace
}  // namespace ringhook

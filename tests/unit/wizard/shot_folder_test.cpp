#include "calib/wizard/shot_folder.h"

#include <gmock/gmock.h>

#include <fstream>

#include "../../support/scratch_folder.h"
#include "calib/wizard/place.h"
#include "camera/image_file.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

GrayImage picture(std::uint8_t grey) {
  GrayImage image(40, 30);
  std::fill(image.pixels.begin(), image.pixels.end(), grey);
  return image;
}

ArmRow armAt(double x) {
  ArmRow arm;
  arm.joints = JointVector::Constant(x / 3.0);
  arm.fMe = makePoseThetaU({x, 0.2, 0.3}, {0.1, 0.2, 0.3});
  return arm;
}

TEST(ShotFolder, TakesUpWhatWasStored) {
  const ScratchFolder folder;
  ShotFolder shots(folder.path(), true);
  shots.add(picture(10), picture(20), armAt(0.1));
  shots.add(picture(30), picture(40), armAt(1.0 / 7.0));
  const ShotFolder again(folder.path(), true);
  ASSERT_EQ(again.count(), 2U);
  EXPECT_EQ(readGrayImage(again.right(1)).pixels[0], 40);
  EXPECT_EQ(again.arms()[1].joints, armAt(1.0 / 7.0).joints);
  EXPECT_TRUE(again.arms()[1].fMe.isApprox(armAt(1.0 / 7.0).fMe, 1e-12));
}

TEST(ShotFolder, APairThatWasCutOffDoesNotCountAndIsReplaced) {
  const ScratchFolder folder;
  ShotFolder shots(folder.path(), true);
  shots.add(picture(10), picture(20), armAt(0.1));
  writeGrayImage(folder.path() / "left/0002.png", picture(99));
  writeGrayImage(folder.path() / "right/0002.png", picture(99));  // its row is missing
  ShotFolder again(folder.path(), true);
  EXPECT_EQ(again.count(), 1U);
  again.add(picture(50), picture(60), armAt(0.2));
  EXPECT_EQ(readGrayImage(again.left(1)).pixels[0], 50);
  EXPECT_EQ(ShotFolder(folder.path(), true).count(), 2U);
}

TEST(ShotFolder, IsAStoredPlace) {
  const ScratchFolder folder;
  ShotFolder shots(folder.path(), true);
  shots.add(picture(10), picture(20), armAt(0.1));
  shots.add(picture(30), picture(40), armAt(0.2));
  const auto place = openStoredPlace(folder.path());
  (void)place->takePair();
  const auto pair = place->takePair();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left.pixels[0], 30);
  EXPECT_NEAR(place->flange()->translation().x(), 0.2, 1e-12);
}

TEST(ShotFolder, ClearsItsPairsAndNothingElse) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "notes.txt") << "mine";
  ShotFolder shots(folder.path(), true);
  shots.add(picture(10), picture(20), armAt(0.1));
  shots.clear();
  EXPECT_EQ(ShotFolder(folder.path(), true).count(), 0U);
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));
}

}  // namespace
}  // namespace ringhook

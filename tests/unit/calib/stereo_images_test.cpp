#include "calib/solve/stereo_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../../support/scratch_folder.h"
#include "board_scene.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const Board kBoard{BoardKind::kChessboard, 7, 4, 0.03};
const StepHook kSilent = [](double, const std::string&) {};

class StereoImages : public ::testing::Test {
 protected:
  fs::path save(const std::string& name, const GrayImage& image) const {
    std::ofstream file(folder_.path() / name, std::ios::binary);
    file << "P5\n" << image.width << " " << image.height << "\n255\n";
    for (const std::uint8_t value : image.pixels) {
      file.put(static_cast<char>(value));
    }
    return folder_.path() / name;
  }

  static GrayImage board(int width, int height) {
    Eigen::Matrix3d K;
    K << 400, 0, 160, 0, 400, 120, 0, 0, 1;
    return drawBoard(kBoard, K, makePoseThetaU({-0.09, -0.05, 0.5}, {0.1, 0.2, 0.0}), width,
                     height);
  }

  std::string failure(const std::vector<fs::path>& left, const std::vector<fs::path>& right) const {
    try {
      (void)findViews(left, right, kBoard, kSilent);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no failure";
  }

  ScratchFolder folder_;
};

TEST_F(StereoImages, PairsByNameAndRejectsAPairWithoutTheBoard) {
  save("l2.pgm", GrayImage(320, 240, 128));
  save("l1.pgm", board(320, 240));
  save("r1.pgm", board(320, 240));
  save("r2.pgm", board(320, 240));
  const auto left = expandGlob((folder_.path() / "l*.pgm").string(), "--left");
  const auto views =
      findViews(left, expandGlob((folder_.path() / "r*.pgm").string(), "--right"), kBoard, kSilent);
  ASSERT_EQ(views.usable.size(), 1U);
  EXPECT_EQ(views.usable[0].left_name, "l1.pgm");
  ASSERT_EQ(views.rejected.size(), 1U);
  EXPECT_EQ(views.rejected[0].reason,
            "l2.pgm: all pixels are 128: was the shutter closed or a cable off?");
}

TEST_F(StereoImages, RefusesAnEmptyPattern) {
  EXPECT_THROW((void)expandGlob((folder_.path() / "*.png").string(), "--left"), InputError);
}

TEST_F(StereoImages, RefusesListsOfDifferentLength) {
  EXPECT_THAT(failure({"a", "b"}, {"c"}), HasSubstr("--left matches 2 images and --right 1"));
}

TEST_F(StereoImages, RefusesAFileThatIsNoImageNamingIt) {
  std::ofstream(folder_.path() / "bad.png") << "not a picture";
  EXPECT_THAT(failure({folder_.path() / "bad.png"}, {save("r.pgm", board(320, 240))}),
              HasSubstr("bad.png: expected a whole PNG"));
}

TEST_F(StereoImages, RefusesImagesOfDifferentSize) {
  EXPECT_THAT(failure({save("l.pgm", board(320, 240))}, {save("r.pgm", board(330, 240))}),
              HasSubstr("330x240 px, expected 320x240"));
}

TEST_F(StereoImages, RefusesTheSameFileOnBothSides) {
  const fs::path file = save("l.pgm", board(320, 240));
  EXPECT_THAT(failure({file}, {file}), HasSubstr("the same file"));
}

}  // namespace
}  // namespace ringhook

#include "../support/scratch_folder.h"
#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "stereo_camera_contract.h"

namespace ringhook {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr double kRate = 20.0;  // [Hz]

/// Five pairs of loose files, each pair of its own grey value.
class ReplayUnderTest : public StereoCameraUnderTest {
 public:
  ReplayUnderTest() {
    for (int i = 0; i < 5; ++i) {
      const GrayImage image(kWidth, kHeight, static_cast<std::uint8_t>(10 * i));
      writeGrayImage(folder_.path() / ("left" + std::to_string(i) + ".pgm"), image);
      writeGrayImage(folder_.path() / ("right" + std::to_string(i) + ".pgm"), image);
    }
    camera_ = std::make_unique<ReplayStereoCamera>((folder_.path() / "left*.pgm").string(),
                                                   (folder_.path() / "right*.pgm").string(), kRate,
                                                   kWidth, kHeight);
  }
  StereoCamera& camera() override { return *camera_; }
  void pass(double /*seconds*/) override {}
  [[nodiscard]] bool chooses() const override { return false; }
  [[nodiscard]] double rateHz() const override { return kRate; }

 private:
  ScratchFolder folder_;
  std::unique_ptr<ReplayStereoCamera> camera_;
};

std::unique_ptr<StereoCameraUnderTest> makeReplay() { return std::make_unique<ReplayUnderTest>(); }

INSTANTIATE_TEST_SUITE_P(Replayed, StereoCameraContract, ::testing::Values(&makeReplay));

}  // namespace
}  // namespace ringhook

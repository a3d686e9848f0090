#include "sim/hook_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "image_reader.h"
#include "sim/arm_visuals.h"
#include "sim/nominal_rig.h"
#include "sim/tag_pattern.h"

namespace ringhook {
namespace {

std::string stored(const std::string& path) {
  std::ifstream file(std::filesystem::path(RINGHOOK_SOURCE_DIR) / path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(HookShape, StoredModelsAreWhatTheCodeEmits) {
  const HookShape shape;
  EXPECT_EQ(stored("datasets/models/hook/hook.cao"), hookCao(shape));
  EXPECT_EQ(stored("datasets/models/hook/hook.obj"), hookObj(shape));
  EXPECT_EQ(stored("datasets/models/hook/marker.yaml"), markerYaml(shape));
  EXPECT_EQ(stored("datasets/models/gripper/marker.yaml"), gripperMarkerYaml());
}

TEST(HookShape, RefusesWhatIsNoHook) {
  EXPECT_NO_THROW(checkHookShape({}));
  const auto refused = [](auto spoil) {
    HookShape shape;
    spoil(shape);
    try {
      checkHookShape(shape);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refused([](HookShape& s) { s.bar_width = -0.01; }), testing::HasSubstr("bar width"));
  EXPECT_THAT(refused([](HookShape& s) { s.tip_rise = std::nan(""); }),
              testing::HasSubstr("tip rise"));
  EXPECT_THAT(refused([](HookShape& s) { s.arc_radius = 0.006; }),
              testing::HasSubstr("the J closes"));
  EXPECT_THAT(refused([](HookShape& s) { s.tag_size = 0.055; }),
              testing::HasSubstr("tag distance"));
  EXPECT_THAT(refused([](HookShape& s) { s.plate_height = 0.09; }),
              testing::HasSubstr("plate height"));
  EXPECT_THAT(refused([](HookShape& s) { s.tracked_top = 0.5; }),
              testing::HasSubstr("tracked top"));
  EXPECT_THAT(refused([](HookShape& s) { s.arc_chords = 1; }), testing::HasSubstr("arc chords"));
}

TEST(HookShape, OutlineEnclosesTheBarsArea) {
  const HookShape shape;
  const auto outline = barOutline(shape, 0.45, 200);
  double twice_area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  const double length = 0.45 + std::numbers::pi * 0.035 + 0.025;
  EXPECT_NEAR(0.5 * twice_area, 0.012 * length, 1e-7);  // positive: counter-clockwise from +x
}

TEST(HookShape, ArcChordsLieOnTheArcOnAverage) {
  HookShape shape;
  for (const int chords : {8, 16}) {
    const auto outline = barOutline(shape, 0.45, chords);
    double sum = 0.0;
    int samples = 0;
    for (int i = 2; i < chords; ++i) {  // chords between inner vertices of the outer arc
      for (double s = 0.005; s < 1.0; s += 0.01, ++samples) {
        sum += ((1.0 - s) * outline[static_cast<std::size_t>(i)] +
                s * outline[static_cast<std::size_t>(i) + 1])
                   .norm();
      }
    }
    EXPECT_NEAR(sum / samples, 0.041, 2e-5) << chords;
  }
}

TEST(HookShape, PlateLooksTowardsTheCamerasAndReadsUpright) {
  const Pose oMk = HookShape{}.oMk();
  EXPECT_NEAR(oMk.linear().determinant(), 1.0, 1e-12);
  EXPECT_TRUE(oMk.linear().col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(oMk.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(oMk.translation().isApprox(Eigen::Vector3d(0.005, -0.035, 0.200)));
}

TEST(TagPattern, DrawnPlateReadsAsItsTagsAtTheirPlaces) {
  TagPlateFace face;
  face.ids = {0, 1};
  const auto tags = readTags(drawTagPlate(face, 0.00025));
  ASSERT_EQ(tags.size(), 2U);
  // The black squares span 7 to 47 mm across, and 7 to 47 and 61 to 101 mm down, in texels of 0.25.
  const GrayImage picture = drawTagPlate(face, 0.00025);
  for (const auto& [x, y] : {std::pair{28, 28}, {187, 187}, {28, 244}, {187, 403}}) {
    EXPECT_EQ(picture.row(y)[x], 0) << x << ", " << y;
    const int outwards = x == 28 ? -1 : 1;
    const int away = y == 28 || y == 244 ? -1 : 1;
    EXPECT_EQ(picture.row(y)[x + outwards], 255) << x << ", " << y;
    EXPECT_EQ(picture.row(y + away)[x], 255) << x << ", " << y;
  }
}

TEST(TagPattern, RefusesAnIdOutsideTheFamily) {
  EXPECT_THROW((void)tagModules(587), InputError);
  EXPECT_THROW((void)tagModules(-1), InputError);
}

TEST(NominalRig, StoredRigIsWhatTheCodeEmits) {
  const ScratchFolder folder;
  const auto path = folder.path() / "rig-sim.yaml";
  saveRig(path, nominalRig());
  std::ifstream emitted(path);
  std::ostringstream text;
  text << emitted.rdbuf();
  EXPECT_EQ(stored("app/config/rig-sim.yaml"), text.str());
}

TEST(NominalRig, BothCamerasLookAtTheWindowFromTheirPlaces) {
  const StereoRig rig = nominalRig();
  EXPECT_NEAR(baseline(rig), 0.40, 1e-12);
  const Eigen::Vector3d target(0.42, 0.0, 0.70);
  for (const Pose& fMc : {*rig.fMc1, *rig.fMc1 * rig.c2Mc1.inverse()}) {
    const Eigen::Vector3d seen = fMc.inverse() * target;
    EXPECT_NEAR(seen.head<2>().norm(), 0.0, 1e-12);
    EXPECT_NEAR(seen.z(), 1.345, 0.001);
    EXPECT_NEAR(fMc.linear()(2, 0), 0.0, 1e-12);  // no roll
    EXPECT_LT(fMc.linear()(2, 1), 0.0);           // y points down
  }
}

TEST(NominalRig, DisturbanceHasTheStatedSize) {
  const StereoRig nominal = nominalRig();
  double between = 0.0;
  double to_robot = 0.0;
  constexpr int kSeeds = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const StereoRig rig = disturbedRig(nominal, static_cast<std::uint64_t>(seed));
    between += logSe3(nominal.c2Mc1.inverse() * rig.c2Mc1).head<3>().squaredNorm();
    to_robot += logSe3(nominal.fMc1->inverse() * *rig.fMc1).tail<3>().squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(between / (3 * kSeeds)), 0.00002, 0.000002);
  EXPECT_NEAR(std::sqrt(to_robot / (3 * kSeeds)), 0.0001, 0.00001);
}

}  // namespace
}  // namespace ringhook

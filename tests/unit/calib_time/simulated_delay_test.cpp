// The whole of `calibrate time` in the simulated cell, whose cameras and arm report late by amounts
// that nothing but this test is told; and that the arm stands still whatever goes wrong meanwhile.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "calib/wizard/place_delays.h"
#include "core/error.h"
#include "robot/arm.h"
#include "sim/nominal_rig.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

CellConfig simulatedCell() {
  return loadCellConfig(RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml");
}

void ignore(double /*fraction*/, const std::string& /*note*/) {}

struct Truth {
  std::uint64_t seed;
  double camera_s;
  double arm_s;
};

std::unique_ptr<CalibrationPlace> placeWith(const CellConfig& cell, const Truth& truth) {
  SimulatedPlaceOptions options;
  options.seed = truth.seed;
  options.camera_delay_s = truth.camera_s;
  options.arm_delay_s = truth.arm_s;
  return openSimulatedPlace(cell, options);
}

TEST(SimulatedDelays, AreFoundWithinThreeTenthsOfAMillisecond) {
  const CellConfig cell = simulatedCell();
  const TagPlate plate = loadTagPlate(cell.arm.gripper_plate);
  const Truth truths[] = {{1, 0.008, 0.0}, {2, 0.0117, 0.0043}};
  std::printf("%4s %12s %12s %12s %12s %12s\n", "seed", "camera_ms", "found_ms", "arm_ms",
              "found_ms", "sigma_ms");
  for (const Truth& truth : truths) {
    const auto place = placeWith(cell, truth);
    WiggleOptions options;
    options.seconds = 5.0;
    const auto record = recordWiggle(*place, cell, nominalRig(), plate, options, ignore);
    ASSERT_TRUE(record) << record.reason();
    const Outcome<DelayReport> found = delaysOf(*record, nominalRig());
    ASSERT_TRUE(found) << found.reason();
    std::printf("%4d %12.3f %12.3f %12.3f %12.3f %12.4f   %.3f px, %.0f px/s, response %.2f ms\n",
                static_cast<int>(truth.seed), 1e3 * truth.camera_s, 1e3 * found->camera->value_s,
                1e3 * truth.arm_s, 1e3 * found->robot->value_s, 1e3 * found->robot->sigma_s,
                found->offset.rms_px, found->offset.image_speed_px_s,
                1e3 * found->response->delay_s);
    EXPECT_EQ(found->grade, DelayGrade::ok) << found->sentence;
    EXPECT_NEAR(found->camera->value_s, truth.camera_s, 0.0003);
    EXPECT_NEAR(found->robot->value_s, truth.arm_s, 0.0003);
    EXPECT_NEAR(found->response->delay_s, truth.arm_s, 0.0003);
    EXPECT_GT(record->motion.plate.size(), 0.95 * record->frames);
  }
}

TEST(SimulatedDelays, StopTheArmWhenTheyAreInterrupted) {
  const CellConfig cell = simulatedCell();
  const auto place = placeWith(cell, {1, 0.008, 0.003});
  const auto interrupt = [](double fraction, const std::string& /*note*/) {
    if (fraction > 0.05) {
      throw Interrupted("stopped by the operator");
    }
  };
  EXPECT_THROW((void)recordWiggle(*place, cell, nominalRig(), loadTagPlate(cell.arm.gripper_plate),
                                  {}, interrupt),
               Interrupted);
  Arm& arm = place->devices()->arm;
  EXPECT_FALSE(arm.waitState().motion_possible);
  (void)arm.waitState();
  (void)arm.waitState();
  EXPECT_LT(arm.waitState().velocity.norm(), 1e-9);
}

TEST(SimulatedDelays, StopTheArmWhenThePlateIsLost) {
  const CellConfig cell = simulatedCell();
  const auto place = placeWith(cell, {1, 0.008, 0.0});
  Pose fMt = Pose::Identity();  // a board that is pushed between cameras and plate
  fMt.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  fMt.translation() = Eigen::Vector3d(0.60, -0.40, 0.90);
  const auto hide = [&](double fraction, const std::string& /*note*/) {
    if (fraction > 0.05) {
      place->holdBoard(fMt);
    }
  };
  try {
    (void)recordWiggle(*place, cell, nominalRig(), loadTagPlate(cell.arm.gripper_plate), {}, hide);
    FAIL() << "the plate was hidden";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("lost sight"));
  }
  EXPECT_FALSE(place->devices()->arm.waitState().motion_possible);
}

TEST(SimulatedDelays, AreRefusedWithoutASightOfThePlate) {
  const CellConfig cell = simulatedCell();
  TagPlate other = loadTagPlate(cell.hook.plate);  // hangs on the hooks, out of view
  const auto place = placeWith(cell, {1, 0.008, 0.0});
  const auto record = recordWiggle(*place, cell, nominalRig(), other, {}, ignore);
  ASSERT_FALSE(record);
  EXPECT_THAT(record.reason(), HasSubstr("not seen at the standby pose"));
}

}  // namespace
}  // namespace ringhook

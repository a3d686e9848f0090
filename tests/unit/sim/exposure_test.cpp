#include "sim/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ringhook {
namespace {

const Window kPlane{-1000, -1000, 2001, 2001};

Pinhole eye() { return {Pose::Identity(), 2500.0}; }

/// A small box in front of the camera, 1 m away.
Solid boxAt(double x, double y) {
  Solid solid;
  solid.fMs.translation() << x, y, 1.0;
  solid.half = {0.01, 0.01, 0.001};
  return solid;
}

TEST(Exposure, InstantsIntegratePolynomialsExactly) {
  const double exposure_s = 0.004;
  for (int count = 1; count <= 24; ++count) {
    const auto instants = subInstants(count, exposure_s);
    ASSERT_EQ(instants.size(), static_cast<std::size_t>(count));
    for (int power = 0; power < 2 * count && power < 12; ++power) {
      double sum = 0.0;
      for (const SubInstant& instant : instants) {
        sum += instant.weight * std::pow(instant.at / (0.5 * exposure_s), power);
      }
      EXPECT_NEAR(sum, power % 2 == 0 ? 1.0 / (power + 1) : 0.0, 1e-12) << count << " " << power;
    }
  }
}

TEST(Exposure, MoreMotionTakesMoreInstants) {
  EXPECT_EQ(subInstantCount(0.0), 1);
  EXPECT_EQ(subInstantCount(0.04), 1);
  EXPECT_EQ(subInstantCount(0.3), 2);
  EXPECT_EQ(subInstantCount(1.0), 2);
  EXPECT_EQ(subInstantCount(7.5), 9);
  EXPECT_EQ(subInstantCount(1e6), 24);
}

TEST(Exposure, MotionIsThatOfWhatTheCameraSees) {
  ExposureEnds ends;
  ends.start = {boxAt(0.0, 0.0), boxAt(3.0, 0.0)};
  ends.end = {boxAt(0.002, 0.0), boxAt(3.5, 0.0)};  // the second one is far outside the plane
  EXPECT_NEAR(largestMotion(ends, eye(), kPlane), 0.002 * 2500.0 / 0.999, 1e-6);
}

TEST(Exposure, MovingPartsHoldBothEndsAndNothingThatRests) {
  ExposureEnds ends;
  ends.start = {boxAt(0.0, 0.0), boxAt(0.2, 0.2), boxAt(0.02, 0.0)};
  ends.end = {boxAt(0.004, 0.0), boxAt(0.2, 0.2), boxAt(0.024, 0.0)};
  const auto parts = movingParts(ends, eye(), kPlane);
  ASSERT_EQ(parts.size(), 1U);  // the first and the third one overlap
  EXPECT_TRUE(parts[0].contains(-25.0, -25.0));
  EXPECT_TRUE(parts[0].contains(85.0, 25.0));
  EXPECT_LT(parts[0].width, 130);
  EXPECT_LT(parts[0].height, 70);
}

}  // namespace
}  // namespace ringhook

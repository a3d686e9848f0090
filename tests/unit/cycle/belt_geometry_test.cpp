#include "cycle/belt_geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "default_cell.h"

namespace ringhook {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kTolerance = 0.02;  // [m]

CellConfig slantedCell() {
  CellConfig cell = test::defaultCell();
  cell.belt.direction_f = Vector3d(0.0, 0.8, 0.6);
  return cell;
}

/// A hook with its pivot at `pivot_f`, turned by `fRo`: written out without the code under test.
Pose hookAt(const CellConfig& cell, const Vector3d& pivot_f, const Eigen::Matrix3d& fRo) {
  Pose fMo = Pose::Identity();
  fMo.linear() = fRo;
  fMo.translation() = pivot_f - fRo * cell.hook.pivot_o;
  return fMo;
}

TEST(BeltGeometry, HangingHookIsUprightBelowItsPivot) {
  const CellConfig cell = test::defaultCell();
  const Pose fMo = hookOnBelt(cell, -0.2, 0.0, 0.0);
  EXPECT_TRUE(fMo.linear().isIdentity(1e-12));
  EXPECT_TRUE(fMo.translation().isApprox(Vector3d(0.42, -0.2 + 0.0263, 0.60), 1e-12));
}

TEST(BeltGeometry, SwungHookIsTurnedAboutItsPivot) {
  const CellConfig cell = test::defaultCell();
  const Eigen::Matrix3d fRo =
      (AngleAxisd(0.07, Vector3d::UnitX()) * AngleAxisd(-0.05, Vector3d::UnitY()))
          .toRotationMatrix();
  const Pose expected = hookAt(cell, Vector3d(0.42, 0.1, 1.05), fRo);
  EXPECT_TRUE(hookOnBelt(cell, 0.1, 0.07, -0.05).isApprox(expected, 1e-12));
}

TEST(BeltGeometry, OnlyHooksNearTheSearchTravelsComeIn) {
  CellConfig cell = slantedCell();
  cell.belt.search_from_m = -0.4;
  cell.belt.search_to_m = -0.3;
  const auto at = [&](double travel_m) {
    const Vector3d pivot_f = cell.belt.pivot_start_f + travel_m * cell.belt.direction_f;
    return hookAt(cell, pivot_f, AngleAxisd(0.08, Vector3d::UnitX()).toRotationMatrix());
  };
  EXPECT_TRUE(comesIn(cell, at(-0.41), kTolerance));
  EXPECT_TRUE(comesIn(cell, at(-0.29), kTolerance));
  EXPECT_FALSE(comesIn(cell, at(-0.43), kTolerance));
  EXPECT_FALSE(comesIn(cell, at(-0.27), kTolerance));
}

TEST(BeltGeometry, TravelIsMeasuredAlongTheBeltWhateverTheSwing) {
  const CellConfig cell = slantedCell();
  for (const double travel : {-0.44, 0.0, 0.3}) {
    EXPECT_NEAR(hookTravel(cell, hookOnBelt(cell, travel, 0.08, -0.03)), travel, 1e-12);
  }
}

TEST(BeltGeometry, SwingHasNoPartInTheTravelSpeed) {
  // Velocity at o by differencing positions of a hook that travels and swings at once.
  const CellConfig cell = slantedCell();
  const auto at = [&](double t) { return hookOnBelt(cell, 0.12 * t, 0.3 * t, 0.04 - 0.2 * t); };
  constexpr double kStep = 1e-5;
  HookEstimate hook;
  hook.fMo = at(0.1);
  hook.twist_f.head<3>() =
      (at(0.1 + kStep).translation() - at(0.1 - kStep).translation()) / (2 * kStep);
  hook.twist_f.tail<3>() =
      thetaU(at(0.1 + kStep).linear() * at(0.1 - kStep).linear().transpose()) / (2 * kStep);
  EXPECT_GT(std::abs(hook.twist_f.head<3>().dot(cell.belt.direction_f) - 0.12), 0.05);
  EXPECT_NEAR(hookTravelSpeed(cell, hook), 0.12, 1e-8);
}

TEST(BeltGeometry, HooksOnTheBeltRaiseNoObjection) {
  const CellConfig cell = test::defaultCell();
  const double swing = cell.hook.swing_max_rad;
  for (const double travel : {-2.0, 0.0, 2.0}) {
    EXPECT_THAT(whyNotOnBelt(cell, hookOnBelt(cell, travel, swing, -swing), kTolerance), IsEmpty());
  }
}

TEST(BeltGeometry, PivotBesideTheBeltIsRefused) {
  const CellConfig cell = test::defaultCell();
  const auto objection = [&](double x, double z) {
    return whyNotOnBelt(
        cell, hookAt(cell, Vector3d(0.42 + x, 0.1, 1.05 + z), Eigen::Matrix3d::Identity()),
        kTolerance);
  };
  EXPECT_THAT(objection(0.019, 0.0), IsEmpty());
  EXPECT_THAT(objection(0.021, 0.0), HasSubstr("belt's line"));
  EXPECT_THAT(objection(0.0, -0.021), HasSubstr("belt's line"));
  EXPECT_THAT(objection(0.015, 0.015), HasSubstr("belt's line"));
}

TEST(BeltGeometry, TooLargeASwingIsRefusedInEitherPlane) {
  const CellConfig cell = test::defaultCell();
  const double limit = 1.5 * cell.hook.swing_max_rad + 0.02;
  const auto objection = [&](double x, double y) {
    return whyNotOnBelt(cell, hookOnBelt(cell, 0.0, x, y), kTolerance);
  };
  EXPECT_THAT(objection(limit - 0.001, -limit + 0.001), IsEmpty());
  EXPECT_THAT(objection(-limit - 0.001, 0.0), HasSubstr("swing"));
  EXPECT_THAT(objection(0.0, limit + 0.001), HasSubstr("swing"));
}

TEST(BeltGeometry, HookTurnedAboutItsShankIsRefused) {
  const CellConfig cell = test::defaultCell();
  const auto turned = [&](double yaw) {
    return hookAt(cell, Vector3d(0.42, 0.0, 1.05),
                  AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix());
  };
  EXPECT_THAT(whyNotOnBelt(cell, turned(0.19), kTolerance), IsEmpty());
  EXPECT_THAT(whyNotOnBelt(cell, turned(-0.21), kTolerance), HasSubstr("turned"));
  EXPECT_THAT(whyNotOnBelt(cell, turned(3.1), kTolerance), HasSubstr("turned"));
}

TEST(BeltGeometry, SearchPosesSpanBothEndsAndAllFullSwings) {
  const CellConfig cell = test::defaultCell();
  const std::vector<Pose> poses = searchPoses(cell);
  Eigen::AlignedBox3d tips;
  for (const Pose& fMo : poses) {
    EXPECT_THAT(whyNotOnBelt(cell, fMo, kTolerance), IsEmpty());
    tips.extend(fMo.translation());
  }
  // Any hook that may come is within the box of the extreme ones.
  for (const double travel : {-0.44, -0.39, -0.34}) {
    for (const double x : {-0.05, 0.0, 0.08}) {
      const Vector3d o = hookOnBelt(cell, travel, x, 0.5 * x).translation();
      EXPECT_LE(tips.exteriorDistance(o), 0.003) << travel << " " << x;
    }
  }
}

}  // namespace
}  // namespace ringhook

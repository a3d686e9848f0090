#include "servo/insertion_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/error.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kWire = 0.003;         // radius of the ring's wire [m]
constexpr double kEasyRadius = 0.0227;  // centreline of the largest ring: 13 mm clearance [m]

/// Distance from a point in o to the steel of the default hook (doc/frames.md): bar of 12 x 6 mm
/// along shank, arc and tip. Taken as its half diagonal round the centreline: on the safe side.
double distanceToHook(const Vector3d& point_o) {
  constexpr double kHalfDiagonal = 0.0067;
  double least = std::numeric_limits<double>::infinity();
  const auto to = [&](double y, double z) {
    least = std::min(least, (point_o - Vector3d(0.0, y, z)).norm() - kHalfDiagonal);
  };
  for (double z = 0.0; z <= 0.450; z += 0.002) {
    to(-0.035, z);
  }
  for (double angle = 0.0; angle <= std::numbers::pi; angle += 0.05) {
    to(-0.035 * std::cos(angle), -0.035 * std::sin(angle));
  }
  for (double z = 0.0; z <= 0.025; z += 0.002) {
    to(0.035, z);
  }
  return least;
}

/// Smallest gap between the ring and the hook along a path [m].
double smallestGap(const RingPath& path, double ring_radius) {
  double gap = std::numeric_limits<double>::infinity();
  const double duration = pathDuration(path);
  for (int k = 0; k <= 60; ++k) {
    const Pose oMr = samplePath(path, duration * k / 60.0).oMr;
    for (int i = 0; i < 24; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 24.0;
      const Vector3d on_ring(ring_radius * std::cos(angle), ring_radius * std::sin(angle), 0.0);
      gap = std::min(gap, distanceToHook(oMr * on_ring) - kWire);
    }
  }
  return gap;
}

Pose at(double x, double y, double z) {
  return makePose({x, y, z}, Eigen::Quaterniond::Identity());
}

Pose endOf(const RingPath& path) { return samplePath(path, pathDuration(path)).oMr; }

const InsertionPhase kAll[] = {InsertionPhase::kApproach, InsertionPhase::kAlign,
                               InsertionPhase::kLower, InsertionPhase::kHold,
                               InsertionPhase::kRetreat};

TEST(InsertionPath, LeadsFromAnywhereOnTheArmsSideToTheRelease) {
  const InsertionParameters p;
  Pose oMr = makePoseThetaU({-0.3, -0.2, 0.1}, {0.5, 0.3, -1.0});
  oMr = endOf(planPhase(InsertionPhase::kApproach, oMr, p));
  EXPECT_TRUE(oMr.isApprox(at(-0.10, 0.035, 0.075), 1e-12));
  oMr = endOf(planPhase(InsertionPhase::kAlign, oMr, p));
  EXPECT_TRUE(oMr.isApprox(at(0.0, 0.035, 0.075), 1e-12));
  oMr = endOf(planPhase(InsertionPhase::kLower, oMr, p));
  EXPECT_TRUE(oMr.isApprox(at(0.0, 0.035, 0.007), 1e-12));
  oMr = endOf(planPhase(InsertionPhase::kHold, oMr, p));
  EXPECT_TRUE(oMr.isApprox(at(0.0, 0.035, 0.007), 1e-12));
  oMr = endOf(planPhase(InsertionPhase::kRetreat, oMr, p));
  EXPECT_TRUE(oMr.isApprox(at(-0.10, 0.035, 0.007), 1e-12));
}

TEST(InsertionPath, ApproachNeverSweepsTheRingThroughTheHook) {
  const InsertionParameters p;
  std::mt19937 engine(31);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int tried = 0;
  while (tried < 300) {
    const Vector3d position(0.3 * unit(engine), 0.3 * unit(engine), 0.2 + 0.3 * unit(engine));
    const bool in_front_or_behind = std::abs(position.x()) > p.clearance;
    const bool above_tip = position.y() > 0.02 && position.z() > 0.07;
    if (!in_front_or_behind && !above_tip) {
      continue;
    }
    ++tried;
    const Vector3d turn(unit(engine), unit(engine), unit(engine));
    const RingPath path = planPhase(InsertionPhase::kApproach, makePoseThetaU(position, turn), p);
    EXPECT_GT(smallestGap(path, kEasyRadius), 0.01) << position.transpose();
  }
}

TEST(InsertionPath, AlignAndLowerKeepTheRingClearOfTheHook) {
  const InsertionParameters p;
  const Pose hover = at(0.0, 0.035, 0.075);
  EXPECT_GT(smallestGap(planPhase(InsertionPhase::kAlign, at(-0.10, 0.035, 0.075), p), kEasyRadius),
            0.03);
  for (const double clearance : {0.013, 0.004, 0.0015}) {
    const double ring_radius = 0.0067 + clearance + kWire;
    const double gap = smallestGap(planPhase(InsertionPhase::kLower, hover, p), ring_radius);
    EXPECT_NEAR(gap, clearance, 2e-4);
  }
}

TEST(InsertionPath, RetreatMovesTheGripperAwayFromTheReleasedRing) {
  InsertionParameters p;
  p.retreat_o = {-0.02, 0.0, 0.10};
  const Pose start = makePoseThetaU({0.001, 0.034, 0.008}, {0.0, 0.1, 0.0});
  const Pose end = endOf(planPhase(InsertionPhase::kRetreat, start, p));
  EXPECT_TRUE((end.translation() - start.translation()).isApprox(p.retreat_o, 1e-12));
  EXPECT_TRUE(end.linear().isApprox(start.linear(), 1e-12));
}

TEST(InsertionPath, VelocityIsTheDerivativeOfThePose) {
  constexpr double kStep = 1e-6;  // [s]
  const Pose start = makePoseThetaU({0.2, -0.1, 0.2}, {0.4, -0.8, 0.3});
  for (const InsertionPhase phase : kAll) {
    const RingPath path = planPhase(phase, start, {});
    for (double t = 0.005; t < pathDuration(path); t += 0.03) {
      const Pose before = samplePath(path, t - kStep).oMr;
      const Pose after = samplePath(path, t + kStep).oMr;
      Twist difference;
      difference << after.translation() - before.translation(),
          thetaU(after.linear() * before.linear().transpose());
      EXPECT_LT((difference / (2.0 * kStep) - samplePath(path, t).twist_o).norm(), 1e-4)
          << phaseName(phase) << " at " << t;
    }
  }
}

TEST(InsertionPath, KeepsItsSpeedsAndReachesThem) {
  const InsertionParameters p;
  const RingPath path = planPhase(InsertionPhase::kLower, at(0.0, 0.035, 0.4), p);
  double fastest = 0.0;
  const double duration = pathDuration(path);
  for (int k = 0; k <= 1000; ++k) {
    const Twist twist_o = samplePath(path, duration * k / 1000.0).twist_o;
    fastest = std::max(fastest, twist_o.head<3>().norm());
  }
  EXPECT_NEAR(fastest, p.lower.linear, 1e-6);
  EXPECT_NEAR(duration, 1.875 * 0.393 / p.lower.linear, 1e-9);
}

TEST(InsertionPath, KeepsItsAccelerationOnShortWays) {
  const InsertionParameters p;
  const RingPath path = planPhase(InsertionPhase::kLower, at(0.0, 0.035, 0.008), p);  // 1 mm
  const double duration = pathDuration(path);
  double greatest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double t = duration * k / 1000.0;
    const Twist change =
        samplePath(path, t + duration / 1000.0).twist_o - samplePath(path, t).twist_o;
    greatest = std::max(greatest, change.head<3>().norm() / (duration / 1000.0));
  }
  EXPECT_NEAR(greatest, p.lower.acceleration, 1e-3);
}

TEST(InsertionPath, RestsBeforeAndAfter) {
  const Pose start = at(-0.3, 0.0, 0.2);
  for (const InsertionPhase phase : kAll) {
    const RingPath path = planPhase(phase, start, {});
    EXPECT_TRUE(samplePath(path, -1.0).oMr.isApprox(start, 1e-15));
    EXPECT_TRUE(samplePath(path, -1.0).twist_o.isZero());
    EXPECT_TRUE(samplePath(path, 1e3).twist_o.isZero());
  }
}

TEST(InsertionPath, NamesTheParameterThatIsWrong) {
  InsertionParameters p;
  p.lower.linear = 0.0;
  try {
    (void)planPhase(InsertionPhase::kLower, Pose::Identity(), p);
    FAIL() << "accepted a speed of zero";
  } catch (const InputError& refused) {
    EXPECT_THAT(refused.what(), ::testing::HasSubstr("lower linear speed"));
  }
  p = {};
  p.standoff_offset_o.x() = -0.01;
  EXPECT_THROW((void)planPhase(InsertionPhase::kApproach, Pose::Identity(), p), InputError);
  p = {};
  p.tip_o.z() = std::nan("");
  EXPECT_THROW((void)planPhase(InsertionPhase::kAlign, Pose::Identity(), p), InputError);
}

}  // namespace
}  // namespace ringhook

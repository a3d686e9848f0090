// Truth: the closed forms for two crossing cameras, derivatives by differences, repeated
// measurement through the project's triangulation and joint pose.

#include "calib/solve/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calib/solve/plan_check.h"
#include "calib/solve/plan_map.h"
#include "calib/solve/plan_search.h"
#include "core/angle.h"
#include "core/error.h"
#include "rig/camera_model.h"
#include "stereo/joint_pose.h"

namespace ringhook {
namespace {

PlanView crossingRig(double baseline_m, double distance_m) {
  return PlanView(
      plannedRig({{2048, 2048, 2500.0}, baseline_m, crossingVergence(baseline_m, distance_m)}));
}

StereoRig distortedRig() {
  StereoRig rig = plannedRig({{1280, 1024, 1400.0}, 0.25, 12.0 * kDegree});
  rig.left.distortion = Eigen::Matrix<double, 5, 1>(-0.22, 0.11, 0.001, -0.0007, 0.01);
  rig.right->distortion = Eigen::Matrix<double, 5, 1>(-0.2, 0.09, -0.0005, 0.001, 0.0);
  return rig;
}

TEST(Plan, GivesTheClosedFormWhereTheAxesCross) {
  const double B = 0.3, Z = 1.5, f = 2500.0, sigma = 0.1;
  const double R2 = Z * Z + 0.25 * B * B;
  const Eigen::Matrix3d C = pointCovariance(crossingRig(B, Z), {0, 0, Z}, sigma);
  EXPECT_NEAR(std::sqrt(C(2, 2)), std::sqrt(2.0) * R2 * sigma / (f * B), 1e-9);
  EXPECT_NEAR(std::sqrt(C(0, 0)), R2 * sigma / (std::sqrt(2.0) * f * Z), 1e-10);
  EXPECT_NEAR(std::sqrt(C(1, 1)), std::sqrt(R2) * sigma / (std::sqrt(2.0) * f), 1e-10);
}

TEST(Plan, GivesThePublishedBoundsOfTwoRigs) {
  const auto total = [](double B, double Z, double sigma) {
    return 1e3 * std::sqrt(pointCovariance(crossingRig(B, Z), {0, 0, Z}, sigma).trace());
  };
  EXPECT_NEAR(total(0.3, 1.5, 0.1), 0.433, 5e-4);
  EXPECT_NEAR(total(0.5, 1.2, 0.05), 0.0885, 5e-4);
}

TEST(Plan, PutsItsFrameInTheMiddleAndFindsTheCrossing) {
  const PlanView view = crossingRig(0.4, 1.3);
  EXPECT_NEAR(view.baseline_m, 0.4, 1e-12);
  EXPECT_NEAR(*view.crossingDistance(), 1.3, 1e-9);
  EXPECT_NEAR((view.c1Mm.inverse().translation() - Eigen::Vector3d(-0.2, 0, 0)).norm(), 0.0, 1e-12);
  // The crossing is in the middle of both images.
  EXPECT_NEAR(view.room({0, 0, 1.3}), 1023.5, 1e-6);
}

TEST(Plan, FindsNoCrossingOfParallelAxes) {
  EXPECT_FALSE(PlanView(plannedRig({{2048, 2048, 2500.0}, 0.4, 0.0})).crossingDistance());
}

TEST(Plan, RefusesARigOfOneCamera) {
  StereoRig rig = plannedRig({});
  rig.right.reset();
  EXPECT_THROW(PlanView{rig}, InputError);
}

TEST(Plan, SeesNothingBehindTheCamerasOrBeyondTheLensModel) {
  EXPECT_LT(crossingRig(0.4, 1.3).room({0, 0, -1.0}), -1e9);
  StereoRig rig = plannedRig({{1280, 1024, 500.0}, 0.25, 0.0});
  rig.left.distortion = Eigen::Vector4d(-0.3, 0.0, 0.0, 0.0);  // folds at a radius of 1.05
  EXPECT_LT(PlanView(rig).room({1.4, 0.0, 1.0}), -1e9);
}

TEST(Plan, AgreesWithRepeatedMeasurementAcrossIdealAndDistortedRigs) {
  for (const PlanView& view :
       {crossingRig(0.4, 1.3), crossingRig(0.12, 0.9), PlanView(distortedRig()),
        PlanView(plannedRig({{2048, 2048, 2500.0}, 0.2, 0.0}))}) {
    std::vector<Eigen::Vector3d> points;
    for (const double z : {0.8, 1.1, 1.5, 2.2}) {
      for (const double x : {-0.15, 0.0, 0.2}) {
        points.emplace_back(x, 0.5 * x + 0.03, z);
      }
    }
    std::erase_if(points, [&](const auto& p) { return view.room(p) < 0.0; });
    ASSERT_GT(points.size(), 6U);
    EXPECT_LT(largestDisagreement(checkPlan(view, points, 0.1, 4000, 7)), 0.05);
  }
}

TEST(Plan, CountsNoiseInRawPixelsOfADistortedLens) {
  // Barrel distortion compresses the border, so that a raw pixel is worth more there.
  StereoRig rig = plannedRig({{1280, 1024, 1000.0}, 0.25, 0.0});
  const Eigen::Vector3d border(0.3, 0.2, 0.8);
  const double ideal = pointCovariance(PlanView(rig), border, 0.1).trace();
  rig.left.distortion = rig.right->distortion = Eigen::Vector4d(-0.25, 0.0, 0.0, 0.0);
  EXPECT_GT(pointCovariance(PlanView(rig), border, 0.1).trace(), 1.3 * ideal);
}

TEST(Plan, AgreesWithRepeatedPosesOfATag) {
  const PlanView view = crossingRig(0.4, 1.3);
  const std::vector<Eigen::Vector3d> corners = tagCornersOf(0.08);
  const Pose mMo = makePoseThetaU({0.05, -0.04, 1.3}, {0.1, 0.25, 0.05});
  const Covariance6 C = targetCovariance(view, corners, mMo, 0.1);
  const auto ideal = [&](const CameraModel& c, const Pose& cMc1) {
    return PinholeView{c.K(0, 0), c.K(1, 1), c.K(0, 2), c.K(1, 2), c.width, c.height, cMc1};
  };
  HookView seen;
  seen.cameras = {{ideal(view.rig.left, Pose::Identity()), {}, {}},
                  {ideal(*view.rig.right, view.rig.c2Mc1), {}, {}}};
  const Pose c1Mo = view.c1Mm * mMo;
  seen.c1Mo_start = c1Mo;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  Covariance6 sum = Covariance6::Zero();
  const int draws = 3000;
  for (int i = 0; i < draws; ++i) {
    for (CameraFeatures& camera : seen.cameras) {
      camera.corners.clear();
      for (const Eigen::Vector3d& p : corners) {
        const Eigen::Vector2d pixel = *camera.camera.project(c1Mo * p);
        const double du = noise(engine);
        camera.corners.push_back({p, pixel + Eigen::Vector2d(du, noise(engine)), 0.1});
      }
    }
    const auto fix = fixFromView(seen);
    ASSERT_TRUE(fix);
    const Twist error = logSe3(c1Mo.inverse() * fix->c1Mo);
    sum += error * error.transpose() / draws;
  }
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(std::sqrt(sum(i, i) / C(i, i)), 1.0, 0.05) << i;
  }
  // The bound stated for such a tag: 0.12 mm.
  EXPECT_NEAR(1e3 * std::sqrt(C.topLeftCorner<3, 3>().trace()), 0.12, 0.03);
}

TEST(StereoField, OfParallelCamerasIsTheOverlapOfTwoRectangles) {
  const double B = 0.4, Z = 1.5, f = 2500.0;
  const StereoField field = stereoField(PlanView(plannedRig({{2048, 1024, f}, B, 0.0})), Z);
  const double width = 2047.0 * Z / f - B;
  const double height = 1023.0 * Z / f;
  EXPECT_NEAR(field.high_m.x() - field.low_m.x(), width, 1e-6);
  EXPECT_NEAR(field.high_m.y() - field.low_m.y(), height, 1e-6);
  EXPECT_NEAR(field.area_m2, width * height, 0.03 * width * height);
}

TEST(StereoField, IsEmptyBeforeTheViewsMeet) {
  EXPECT_TRUE(stereoField(PlanView(plannedRig({{2048, 2048, 2500.0}, 0.4, 0.0})), 0.4).empty());
}

PlanWish wish() {
  PlanWish wish;
  wish.box = {{0, 0, 1.3}, {0.5, 0.4, 0.3}};
  wish.sigma_px = 0.1;
  wish.max_baseline_m = 0.9;
  wish.wanted_m = 0.35e-3;
  return wish;
}

TEST(PlanSearch, FindsTheShortestBaselineThatKeepsTheWish) {
  const auto advice = adviseSetup(wish());
  ASSERT_TRUE(advice);
  ASSERT_TRUE(advice->shortest);
  const PlanChoice& found = *advice->shortest;
  EXPECT_LE(found.error.worst_m, 0.35e-3);
  EXPECT_GE(found.error.room_px, 0.0);
  // No vergence helps a baseline that is three percent shorter: what it changes is below two.
  PlannedSetup shorter = found.setup;
  shorter.baseline_m *= 0.97;
  for (double vergence = 0.0; vergence < 0.6; vergence += 0.01) {
    shorter.vergence_rad = vergence;
    const BoxError error = boxError(PlanView(plannedRig(shorter)), wish().box, 0.1);
    EXPECT_GT(error.worst_m, 0.35e-3) << vergence;
  }
}

TEST(PlanSearch, LeavesMostRoomAroundTheWorkspace) {
  const PlanChoice found = *adviseSetup(wish())->shortest;
  PlannedSetup other = found.setup;
  for (const double step : {-0.02, -0.002, 0.002, 0.02}) {
    other.vergence_rad = found.setup.vergence_rad + step;
    EXPECT_LT(boxError(PlanView(plannedRig(other)), wish().box, 0.1).room_px, found.error.room_px);
  }
}

TEST(PlanSearch, SaysWhatIsTheFinestWhenTheWishIsOutOfReach) {
  PlanWish much = wish();
  much.wanted_m = 1e-6;
  const auto advice = adviseSetup(much);
  ASSERT_TRUE(advice);
  EXPECT_FALSE(advice->shortest);
  EXPECT_GT(advice->finest.error.worst_m, 1e-6);
  EXPECT_LE(advice->finest.setup.baseline_m, 0.9);
}

TEST(PlanSearch, RefusesAWorkspaceThatNoViewHolds) {
  PlanWish much = wish();
  much.box.size_m = {3.0, 3.0, 0.3};
  EXPECT_FALSE(adviseSetup(much));
}

TEST(PlanMap, IsFinerNearAndCoarserFarAsTheReportDraws) {
  const PlanView view = crossingRig(0.4, 1.3);
  const PlanMap map = mapPlan(view, 0.1, 1.3, 0.08, std::nullopt);
  ASSERT_GT(map.along.size(), 20U);
  for (std::size_t i = 1; i < map.along.size(); ++i) {
    EXPECT_GT(map.along[i].total_m, map.along[i - 1].total_m);
  }
  ASSERT_TRUE(map.tag);
  EXPECT_LT(map.tag->position_m, map.middle->total_m);
}

TEST(PlanMap, WritesOneRowAPointAndWellFormedPanels) {
  const PlanView view = crossingRig(0.4, 1.3);
  const PlanMap map = mapPlan(view, 0.1, 1.3, 0.0, WorkBox{{0, 0, 1.3}, {0.4, 0.3, 0.2}});
  const std::string table = planTable(map);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')),
            1 + map.across.size() + map.along.size());
  const std::string svg = planPicture(view, map);
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
  EXPECT_THAT(svg, testing::Not(testing::HasSubstr("inf")));
}

}  // namespace
}  // namespace ringhook

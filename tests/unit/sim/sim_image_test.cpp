#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "image_reader.h"
#include "scene_view.h"
#include "sim/cell_world.h"
#include "sim/hook_shape.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using CornerErrors = std::vector<Vector2d> (*)(const GrayImage&, const Window&, const CameraModel&,
                                               const Pose& cMo);

/// Detector's corners minus the lens model's in one image, all tags.
std::vector<Vector2d> detectedCornerErrors(const GrayImage& image, const Window& window,
                                           const CameraModel& camera, const Pose& cMo) {
  std::vector<Vector2d> errors;
  for (const auto& [id, corners] : readTags(image)) {
    if (id > 1) {
      continue;  // the gripper's
    }
    const auto model = tagCorners(id);
    for (std::size_t i = 0; i < 4; ++i) {
      errors.push_back(corners[i] + Vector2d(window.x, window.y) -
                       projected(camera, cMo, model[i]));
    }
  }
  return errors;
}

/// A side of a tag in the image: offset from the projected side at its start and its end, by a
/// line fitted to crossings along it.
struct SideFit {
  Vector2d normal;  ///< outwards
  double at_start = 0.0;
  double at_end = 0.0;
};

SideFit fitSide(const GrayImage& image, const Window& window, const CameraModel& camera,
                const Pose& cMo, const Vector3d& from, const Vector3d& to) {
  SideFit fit;
  const Vector2d along = (projected(camera, cMo, to) - projected(camera, cMo, from)).normalized();
  fit.normal = Vector2d(along.y(), -along.x());  // corners go clockwise in the image
  Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  for (double s = 0.12; s < 0.885; s += 0.01) {
    const Vector2d at = projected(camera, cMo, from + s * (to - from));
    const double t = edgeOffset(image, at - Vector2d(window.x, window.y), fit.normal);
    const Vector2d row(1.0 - s, s);
    normal_matrix += row * row.transpose();
    right += t * row;
  }
  const Vector2d ends = normal_matrix.inverse() * right;
  fit.at_start = ends[0];
  fit.at_end = ends[1];
  return fit;
}

/// Where lines fitted to a tag's sides meet, minus the lens model's corners; both tags.
std::vector<Vector2d> fittedCornerErrors(const GrayImage& image, const Window& window,
                                         const CameraModel& camera, const Pose& cMo) {
  std::vector<Vector2d> errors;
  for (const int id : {0, 1}) {
    const auto model = tagCorners(id);
    std::vector<SideFit> sides;
    for (std::size_t i = 0; i < 4; ++i) {
      sides.push_back(fitSide(image, window, camera, cMo, model[i], model[(i + 1) % 4]));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const SideFit& before = sides[(i + 3) % 4];
      Eigen::Matrix2d normals;
      normals << before.normal.transpose(), sides[i].normal.transpose();
      errors.emplace_back(normals.inverse() * Vector2d(before.at_end, sides[i].at_start));
    }
  }
  return errors;
}

struct Spread {
  Vector2d mean;
  double rms = 0.0;    ///< per axis
  double worst = 0.0;  ///< longest error
};

Spread spreadOf(const std::vector<Vector2d>& errors) {
  Spread spread{Vector2d::Zero(), 0.0, 0.0};
  for (const Vector2d& e : errors) {
    spread.mean += e / static_cast<double>(errors.size());
    spread.rms += e.squaredNorm() / (2.0 * static_cast<double>(errors.size()));
    spread.worst = std::max(spread.worst, e.norm());
  }
  spread.rms = std::sqrt(spread.rms);
  return spread;
}

/// Errors of both sides over places across the pick window.
std::vector<Vector2d> errorsAcrossTheCell(bool noise, CornerErrors corner_errors) {
  std::vector<Vector2d> errors;
  const StereoRig rig = disturbedRig(nominalRig(), 3);
  for (const double y : {-0.30, -0.11, 0.08, 0.27}) {
    CellWorld world(hookInView(y));
    SimCameraOptions options;
    options.sensor.noise = noise;
    options.rate_hz = 2.5;
    SimStereoCamera camera(world, rig, options);
    const Pose c1Mo = rig.fMc1->inverse() * truth(world).hooks.front().fMo;
    const Vector2d left = projected(rig.left, c1Mo, {0, -0.035, 0.2});
    const Vector2d right = projected(*rig.right, rig.c2Mc1 * c1Mo, {0, -0.035, 0.2});
    camera.setWindows(around(left, 400), around(right, 400));
    world.advanceTo(Time::fromSeconds(0.4));
    const Pose c1Mo_seen = rig.fMc1->inverse() * truth(world).hooks.front().fMo;
    const StereoFrame frame = frameAt(world, camera, 0.409);
    EXPECT_EQ(frame.time, Time::fromSeconds(0.4));
    for (const Vector2d& e : corner_errors(frame.left, frame.left_window, rig.left, c1Mo_seen)) {
      errors.push_back(e);
    }
    const Pose c2Mo_seen = rig.c2Mc1 * c1Mo_seen;
    for (const Vector2d& e :
         corner_errors(frame.right, frame.right_window, *rig.right, c2Mo_seen)) {
      errors.push_back(e);
    }
  }
  return errors;
}

TEST(SimImage, TagCornersLieWhereTheLensModelPutsThem) {
  const auto errors = errorsAcrossTheCell(false, &fittedCornerErrors);
  ASSERT_EQ(errors.size(), 4U * 2 * 2 * 4);
  const Spread spread = spreadOf(errors);
  std::cout << "corners from fitted edges, no noise: rms " << spread.rms << " px per axis, worst "
            << spread.worst << ", mean " << spread.mean.transpose() << "\n";
  EXPECT_LT(spread.rms, 0.02);
  EXPECT_LT(spread.worst, 0.05);
}

TEST(SimImage, DetectorFindsTagCornersAsWellAsInRealImages) {
  const auto clean = errorsAcrossTheCell(false, &detectedCornerErrors);
  const auto noisy = errorsAcrossTheCell(true, &detectedCornerErrors);
  ASSERT_EQ(clean.size(), 4U * 2 * 2 * 4);
  ASSERT_EQ(noisy.size(), clean.size());
  std::cout << "corners by the detector: rms " << spreadOf(clean).rms << " px per axis, with noise "
            << spreadOf(noisy).rms << "\n";
  EXPECT_LT(spreadOf(clean).mean.norm(), 0.03);  // a shift of half a pixel would show here
  EXPECT_LT(spreadOf(noisy).rms, 0.07);
}

TEST(SimImage, ShankEdgeLiesWhereTheLensModelPutsIt) {
  const StereoRig rig = disturbedRig(nominalRig(), 3);
  CellWorld world(hookInView(-0.15));
  SimCameraOptions options;
  options.sensor.noise = false;
  options.rate_hz = 5.0;
  SimStereoCamera camera(world, rig, options);
  world.advanceTo(Time::fromSeconds(0.2));
  const Pose c1Mo = rig.fMc1->inverse() * truth(world).hooks.front().fMo;
  const StereoFrame frame = frameAt(world, camera, 0.209);
  double sum = 0.0;
  double squares = 0.0;
  int rows = 0;
  for (double z = 0.28; z < 0.40; z += 0.001, ++rows) {
    // The left camera sees the bar's front face end at the side y = -0.041.
    const Vector2d edge = projected(rig.left, c1Mo, {0.003, -0.041, z});
    const Vector2d along =
        (projected(rig.left, c1Mo, {0.003, -0.041, z + 0.001}) - edge).normalized();
    const double error = edgeOffset(frame.left, edge, {along.y(), -along.x()});
    sum += error;
    squares += error * error;
  }
  std::cout << "shank edge: mean " << sum / rows << " px, rms " << std::sqrt(squares / rows)
            << " px over " << rows << " rows\n";
  EXPECT_LT(std::abs(sum / rows), 0.05);
  EXPECT_LT(std::sqrt(squares / rows), 0.15);
}

TEST(SimImage, TagsReadUprightFromBothCameras) {
  CellWorld world(hookInView(-0.2));
  SimStereoCamera camera(world, nominalRig());
  const StereoFrame frame = frameAt(world, camera, 0.01);
  for (const GrayImage& image : {frame.left, frame.right}) {
    const auto tags = readTags(image);
    for (const int id : {0, 1}) {
      ASSERT_EQ(tags.count(id), 1U);
      EXPECT_LT(tags.at(id)[0].x(), tags.at(id)[1].x() - 40.0);
      EXPECT_LT(tags.at(id)[0].y(), tags.at(id)[3].y() - 40.0);
    }
    EXPECT_LT(tags.at(0)[0].y(), tags.at(1)[0].y());  // tag 0 is the upper one
  }
}

TEST(SimImage, PictureIsWrittenInColour) {
  CellWorld world(hookInView(-0.2));
  SimStereoCamera camera(world, nominalRig());
  const ScratchFolder folder;
  const auto path = folder.path() / "picture.png";
  camera.savePicture(path, *nominalRig().fMc1, 0.8, 320, 240);
  const cv::Mat picture = cv::imread(path.string());
  ASSERT_EQ(picture.cols, 320);
  ASSERT_EQ(picture.rows, 240);
  int orange = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const auto& bgr = picture.at<cv::Vec3b>(y, x);
      orange += bgr[2] > 2 * bgr[0] && bgr[2] > 80 ? 1 : 0;
    }
  }
  EXPECT_GT(orange, 1000);  // the arm
}

}  // namespace
}  // namespace ringhook

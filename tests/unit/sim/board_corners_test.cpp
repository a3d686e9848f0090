// A checkerboard that fills both images to their borders: every inner corner lies where the lens
// model puts it. Corners are measured as saddle points of a quadratic fitted to the grey values,
// which knows nothing of projection.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <iostream>
#include <optional>

#include "image_reader.h"
#include "scene_view.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSquare = 0.025;

/// The saddle point of a x^2 + b x y + c y^2 + d x + e y + f around `at`, from there.
Vector2d saddleNear(const GrayImage& image, const Vector2d& at) {
  using Row = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Row right = Row::Zero();
  for (double y = -5.0; y <= 5.0; y += 0.5) {
    for (double x = -5.0; x <= 5.0; x += 0.5) {
      Row row;
      row << x * x, x * y, y * y, x, y, 1.0;
      const double weight = std::exp(-0.5 * (x * x + y * y) / 4.0);
      normal += weight * row * row.transpose();
      right += weight * greyAt(image, at + Vector2d(x, y)) * row;
    }
  }
  const Row q = normal.ldlt().solve(right);
  Eigen::Matrix2d curvature;
  curvature << 2.0 * q[0], q[1], q[1], 2.0 * q[2];
  return -curvature.inverse() * q.segment<2>(3);
}

/// Where the corner near `start` is, by iterating until the saddle lies in the middle.
Vector2d measuredCorner(const GrayImage& image, Vector2d at) {
  for (int i = 0; i < 6; ++i) {
    at += saddleNear(image, at);
  }
  return at;
}

BoardOptions wideBoard() {
  BoardOptions board;
  board.columns = 60;
  board.rows = 48;
  board.square = kSquare;
  const Eigen::AngleAxisd turn(0.11, Vector3d(0.3, 0.2, 1.0).normalized());
  board.fMt.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  board.fMt.linear() = turn * board.fMt.linear();
  board.fMt.translation() =
      Vector3d(0.52, 0.0, 0.70) - board.fMt.linear() * Vector3d(29.5 * kSquare, 23.5 * kSquare, 0);
  return board;
}

struct Errors {
  int count = 0;
  int near_border = 0;  ///< within 100 px of it
  double squares = 0.0;
  double worst = 0.0;
  Vector2d sum = Vector2d::Zero();
};

void addErrors(const GrayImage& image, const CameraModel& camera, const Pose& cMt,
               const BoardOptions& board, Errors& errors) {
  for (int j = 0; j < board.rows; ++j) {
    for (int i = 0; i < board.columns; ++i) {
      const Vector2d truth = projected(camera, cMt, {i * kSquare, j * kSquare, 0.0});
      const double inside = std::min({truth.x(), truth.y(), 2047 - truth.x(), 2047 - truth.y()});
      if (inside < 8.0) {
        continue;
      }
      const Vector2d error = measuredCorner(image, truth + Vector2d(0.3, -0.2)) - truth;
      ++errors.count;
      errors.near_border += inside < 100.0 ? 1 : 0;
      errors.squares += error.squaredNorm();
      errors.worst = std::max(errors.worst, error.norm());
      errors.sum += error;
    }
  }
}

TEST(SimImage, BoardCornersLieWhereTheLensModelPutsThem) {
  CellOptions options = hookInView(-0.1);
  options.scene.board = wideBoard();
  CellWorld world(options);
  const StereoRig rig = nominalRig();
  SimCameraOptions camera_options;
  camera_options.sensor.noise = false;
  SimStereoCamera camera(world, rig, camera_options);
  const StereoFrame frame = frameAt(world, camera, 0.01);
  const Pose c1Mt = rig.fMc1->inverse() * options.scene.board.fMt;
  Errors errors;
  addErrors(frame.left, rig.left, c1Mt, options.scene.board, errors);
  addErrors(frame.right, *rig.right, rig.c2Mc1 * c1Mt, options.scene.board, errors);
  const double rms = std::sqrt(errors.squares / (2.0 * errors.count));
  std::cout << errors.count << " board corners, " << errors.near_border << " near the border: rms "
            << rms << " px per axis, worst " << errors.worst << " px, mean "
            << (errors.sum / errors.count).transpose() << "\n";
  EXPECT_GT(errors.count, 1500);
  EXPECT_GT(errors.near_border, 200);
  EXPECT_LT(rms, 0.02);
  EXPECT_LT(errors.worst, 0.1);
}

}  // namespace
}  // namespace ringhook

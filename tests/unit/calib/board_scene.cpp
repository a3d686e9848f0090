#include "board_scene.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

namespace ringhook {
namespace {

cv::Mat asMat(const Eigen::MatrixXd& m) {
  cv::Mat mat(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
  for (int r = 0; r < mat.rows; ++r) {
    for (int c = 0; c < mat.cols; ++c) {
      mat.at<double>(r, c) = m(r, c);
    }
  }
  return mat;
}

// OpenCV's own projection: independent of the law that the solver differentiates.
BoardSighting projectBoard(const CameraModel& camera, const Pose& cMt, const Board& board) {
  std::vector<cv::Point3d> points;
  for (const Eigen::Vector3d& p : board.points()) {
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, asMat(thetaU(cMt.linear())), asMat(cMt.translation()), asMat(camera.K),
                    asMat(camera.distortion), pixels);
  BoardSighting sighting;
  for (const cv::Point2d& p : pixels) {
    sighting.ids.push_back(static_cast<int>(sighting.ids.size()));
    sighting.pixels.emplace_back(p.x, p.y);
  }
  return sighting;
}

// Grey value of the print at a point of its plane, in squares from the first inner corner.
double printAt(const Board& board, double x, double y) {
  const double column = std::floor(x);
  const double row = std::floor(y);
  if (column < -1 || row < -1 || column >= board.columns || row >= board.rows) {
    const bool on_margin = x > -1.5 && y > -1.5 && x < board.columns + 0.5 && y < board.rows + 0.5;
    return on_margin ? 220.0 : 120.0;
  }
  return std::fmod(std::abs(column + row), 2.0) < 0.5 ? 30.0 : 220.0;
}

}  // namespace

StereoRig knownRig() {
  StereoRig rig;
  rig.left.width = 1280;
  rig.left.height = 1024;
  rig.left.K << 1000, 0, 630, 0, 1002, 520, 0, 0, 1;
  rig.left.distortion = Eigen::VectorXd(5);
  rig.left.distortion << -0.12, 0.05, 0.001, -0.0005, 0.01;
  rig.right = rig.left;
  rig.right->K << 1010, 0, 650, 0, 1008, 505, 0, 0, 1;
  rig.right->distortion << -0.11, 0.04, -0.0007, 0.0008, 0.0;
  rig.c2Mc1 = makePoseThetaU({-0.12, 0.002, 0.004}, {0.01, -0.05, 0.006});
  return rig;
}

StereoViews simulatedViews(int count, const Board& board, double sigma_px, std::uint32_t seed,
                           double tilt_rad) {
  const StereoRig rig = knownRig();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  StereoViews views;
  for (int i = 0; i < count; ++i) {
    const double direction = 2.4 * i;  // golden angle: all directions, none twice
    const Eigen::Vector3d tilt(tilt_rad * std::cos(direction), tilt_rad * std::sin(direction), 0.1);
    const Eigen::Vector3d middle(0.5 * board.pitch_m * (board.columns - 1),
                                 0.5 * board.pitch_m * (board.rows - 1), 0.0);
    const Pose turned = makePoseThetaU(Eigen::Vector3d::Zero(), tilt);
    const Eigen::Vector3d centre(0.06 + 0.06 * std::cos(3.1 * i), 0.06 * std::sin(3.1 * i),
                                 0.50 + 0.02 * (i % 6));
    const Pose c1Mt = makePoseThetaU(centre - turned * middle, tilt);
    const std::string name = std::to_string(i) + ".png";
    StereoView view{"left" + name, "right" + name, rig.left.width, rig.left.height, {}, {}};
    view.left = projectBoard(rig.left, c1Mt, board);
    view.right = projectBoard(*rig.right, rig.c2Mc1 * c1Mt, board);
    for (BoardSighting* sighting : {&view.left, &view.right}) {
      for (Eigen::Vector2d& p : sighting->pixels) {
        p += sigma_px * Eigen::Vector2d(noise(random), noise(random));
      }
    }
    views.usable.push_back(view);
  }
  return views;
}

GrayImage drawBoard(const Board& board, const Eigen::Matrix3d& K, const Pose& cMt, int width,
                    int height) {
  Eigen::Matrix3d planeToPixel;
  planeToPixel << cMt.linear().col(0) * board.pitch_m, cMt.linear().col(1) * board.pitch_m,
      cMt.translation();
  const Eigen::Matrix3d pixelToPlane = (K * planeToPixel).inverse();
  GrayImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double sum = 0.0;
      // 8x8 samples on a sheared grid: 64 different offsets along u and along v.
      for (int s = 0; s < 64; ++s) {
        const double i = s % 8;
        const double j = std::floor(s / 8.0);
        const Eigen::Vector3d p =
            pixelToPlane * Eigen::Vector3d(u - 0.984375 + 0.25 * i + 0.03125 * j,
                                           v - 0.984375 + 0.25 * j + 0.03125 * i, 1.0);
        sum += printAt(board, p.x() / p.z(), p.y() / p.z());
      }
      image.row(v)[u] = static_cast<std::uint8_t>(std::lround(sum / 64.0));
    }
  }
  return image;
}

}  // namespace ringhook

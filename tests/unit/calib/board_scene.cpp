#include "board_scene.h"

#include <cmath>
#include <limits>
#include <opencv2/aruco.hpp>
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

// z = depth (r / R)^2 about the board's middle.
std::vector<Eigen::Vector3d> bentPoints(const Board& board, double bowl_m) {
  std::vector<Eigen::Vector3d> points = board.points();
  const Eigen::Vector3d middle = 0.5 * (points.front() + points.back());
  const double R = (points.front() - middle).norm();
  for (Eigen::Vector3d& p : points) {
    p.z() = bowl_m * std::pow((p - middle).norm() / R, 2);
  }
  return points;
}

// OpenCV's own projection: independent of the law that the solver differentiates.
BoardSighting projectBoard(const CameraModel& camera, const Pose& cMt, const Board& board,
                           double bowl_m) {
  std::vector<cv::Point3d> points;
  for (const Eigen::Vector3d& p : bentPoints(board, bowl_m)) {
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

constexpr double kInk = 30.0;
constexpr double kPaper = 220.0;
constexpr double kGround = 120.0;

// The print as a function of its plane, in pitches from the first point.
class Print {
 public:
  Print(const Board& board, bool older_charuco) : board_(board), older_(older_charuco) {
    for (const Eigen::Vector3d& p : board.points()) {
      low_ = low_.cwiseMin(p.head<2>() / board.pitch_m);
      high_ = high_.cwiseMax(p.head<2>() / board.pitch_m);
    }
    if (board.kind == BoardKind::kCharuco || board.kind == BoardKind::kAprilTags) {
      const auto dictionary = cv::aruco::getPredefinedDictionary(
          board.kind == BoardKind::kCharuco ? cv::aruco::DICT_4X4_100
                                            : cv::aruco::DICT_APRILTAG_36h11);
      for (int id = 0; id < board.columns * board.rows; ++id) {
        markers_.emplace_back();
        cv::aruco::drawMarker(dictionary, id, dictionary->markerSize + 2, markers_.back(), 1);
      }
    }
  }

  [[nodiscard]] double at(double x, double y) const {
    if (x < low_.x() - 1.5 || y < low_.y() - 1.5 || x > high_.x() + 1.5 || y > high_.y() + 1.5) {
      return kGround;
    }
    switch (board_.kind) {
      case BoardKind::kChessboard:
        return inside(x, y, 0) && odd(x, y) == 0 ? kInk : kPaper;
      case BoardKind::kCharuco:
        return charuco(x, y);
      case BoardKind::kAprilTags:
        return tags(x, y);
      case BoardKind::kCircles:
      case BoardKind::kAsymmetricCircles:
        break;
    }
    return circles(x, y);
  }

 private:
  [[nodiscard]] bool inside(double x, double y, int less) const {
    return x >= -1 && y >= -1 && x < board_.columns - less && y < board_.rows - less;
  }
  static int odd(double x, double y) {
    return static_cast<int>(std::abs(std::floor(x) + std::floor(y))) % 2;
  }
  // Grey value of a marker at (u, v), both 0 to 1 over the black square.
  [[nodiscard]] double marker(int id, double u, double v) const {
    const cv::Mat& m = markers_[static_cast<std::size_t>(id)];
    const bool white =
        m.at<std::uint8_t>(static_cast<int>(v * m.rows), static_cast<int>(u * m.cols)) > 0;
    return white ? kPaper : kInk;
  }
  [[nodiscard]] double charuco(double x, double y) const {
    if (!inside(x, y, 1)) {
      return kPaper;
    }
    const int column = static_cast<int>(std::floor(x)) + 1;
    const int row = static_cast<int>(std::floor(y)) + 1;
    const int shift = older_ ? (board_.rows + 1) % 2 : 0;
    if ((column + row + shift) % 2 == 0) {
      return kInk;
    }
    int id = 0;  // white squares before this one
    for (int r = 0; r <= row; ++r) {
      for (int c = 0; c < (r == row ? column : board_.columns); ++c) {
        id += (r + c + shift) % 2;
      }
    }
    const double side = board_.marker_m / board_.pitch_m;
    const double u = (x - std::floor(x) - 0.5) / side + 0.5;
    const double v = (y - std::floor(y) - 0.5) / side + 0.5;
    return u < 0 || v < 0 || u >= 1 || v >= 1 ? kPaper : marker(id, u, v);
  }
  [[nodiscard]] double tags(double x, double y) const {
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const double side = board_.marker_m / board_.pitch_m;
    const double u = (x - column) / side;
    const double v = (y - row) / side;
    if (column < 0 || row < 0 || column >= board_.columns || row >= board_.rows || u >= 1 ||
        v >= 1) {
      return kPaper;
    }
    return marker(row * board_.columns + column, u, v);
  }
  [[nodiscard]] double circles(double x, double y) const {
    const double radius = 0.5 * board_.marker_m / board_.pitch_m;
    const double row = std::round(y);
    double column = std::round(x);
    if (board_.kind == BoardKind::kAsymmetricCircles) {
      const double start = std::fmod(std::abs(row), 2.0);
      column = start + 2.0 * std::round((x - start) / 2.0);
    }
    const bool there = row >= 0 && row < high_.y() + 0.5 && column >= 0 && column < high_.x() + 0.5;
    return there && std::hypot(x - column, y - row) < radius ? kInk : kPaper;
  }

  const Board& board_;
  bool older_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_ = Eigen::Vector2d::Zero();
  std::vector<cv::Mat> markers_;
};

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
                           double tilt_rad, double bowl_m) {
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
    view.left = projectBoard(rig.left, c1Mt, board, bowl_m);
    view.right = projectBoard(*rig.right, rig.c2Mc1 * c1Mt, board, bowl_m);
    for (BoardSighting* sighting : {&view.left, &view.right}) {
      for (Eigen::Vector2d& p : sighting->pixels) {
        p += sigma_px * Eigen::Vector2d(noise(random), noise(random));
      }
    }
    views.usable.push_back(view);
  }
  return views;
}

Eigen::Vector3d middleOf(const Board& board) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3d& p : board.points()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 0.5 * (low + high);
}

double boardSag(const Board& board, double bowl_m) {
  const std::vector<Eigen::Vector3d> points = bentPoints(board, bowl_m);
  return points.front().z() - 0.5 * (points[2 * 9 + 4].z() + points[3 * 9 + 4].z());
}

GrayImage drawBoard(const Board& board, const Eigen::Matrix3d& K, const Pose& cMt, int width,
                    int height, bool older_charuco) {
  const Print print(board, older_charuco);
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
        sum += print.at(p.x() / p.z(), p.y() / p.z());
      }
      image.row(v)[u] = static_cast<std::uint8_t>(std::lround(sum / 64.0));
    }
  }
  return image;
}

}  // namespace ringhook

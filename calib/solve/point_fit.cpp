#include "calib/solve/point_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "calib/solve/hand_eye_verdict.h"
#include "calib/solve/pose_table.h"
#include "calib/solve/sentence.h"
#include "calib/solve/small_statistics.h"
#include "core/error.h"
#include "stereo/rigid_fit.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGate = 16.27;          // chi-square, 3 degrees, 99.9 %
constexpr double kMedianRadius = 1.538;  // median length of a standard normal vector in space
constexpr double kLeastSigma = 5e-6;     // [m]
constexpr int kTriples = 500;
constexpr double kScaleSigmas = 5.0;  // a scale this far from one is not noise
constexpr double kScaleNoticed = 0.005;

std::optional<RigidFit> fitOver(const std::vector<PointPair>& points,
                                const std::vector<bool>& used) {
  std::vector<Vector3d> f;
  std::vector<Vector3d> c;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) {
      f.push_back(points[i].point_f);
      c.push_back(points[i].point_c);
    }
  }
  const auto fit = fitRigid(f, c);
  return fit ? std::optional<RigidFit>(*fit) : std::nullopt;
}

std::vector<double> distances(const Pose& fMc1, const std::vector<PointPair>& points) {
  std::vector<double> all;
  for (const PointPair& p : points) {
    all.push_back((fMc1 * p.point_c - p.point_f).norm());
  }
  return all;
}

std::vector<bool> drawTriple(std::size_t size, std::mt19937_64& dice) {
  std::vector<bool> used(size, false);
  for (int left = 3; left > 0;) {
    const std::size_t i = dice() % size;
    left -= used[i] ? 0 : 1;
    used[i] = true;
  }
  return used;
}

// The motion that half of the points agree on best.
Pose leastMedian(const std::vector<PointPair>& points) {
  std::mt19937_64 dice(1);
  double least = std::numeric_limits<double>::infinity();
  Pose best = Pose::Identity();
  const auto consider = [&](const std::vector<bool>& used) {
    const auto fit = fitOver(points, used);
    const double size = fit ? median(distances(fit->aMb, points)) : least;
    if (size < least) {
      least = size;
      best = fit->aMb;
    }
  };
  consider(std::vector<bool>(points.size(), true));
  for (int i = 0; i < kTriples; ++i) {
    consider(drawTriple(points.size(), dice));
  }
  if (!std::isfinite(least)) {
    throw InputError("the points lie on one line: take the corners of a cube");
  }
  return best;
}

double rms(const std::vector<double>& all, const std::vector<bool>& used) {
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sum += used[i] ? all[i] * all[i] : 0.0;
    n += used[i] ? 1.0 : 0.0;
  }
  return std::sqrt(sum / n);
}

// Points taken out and the motion fitted again, until the same points stay.
void settle(const std::vector<PointPair>& points, PointFit& fit) {
  const auto all = static_cast<double>(points.size());
  double sigma = median(distances(fit.fMc1, points)) / kMedianRadius * std::sqrt(all / (all - 2.0));
  fit.used.assign(points.size(), true);
  for (int round = 0; round < 20; ++round) {
    const std::vector<double> d = distances(fit.fMc1, points);
    std::vector<bool> used(points.size());
    sigma = std::max(sigma, kLeastSigma);
    const auto before = static_cast<double>(std::count(fit.used.begin(), fit.used.end(), true));
    const double gate = kGate / leastNoiseShare(3.0 * before - 6.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      used[i] = d[i] * d[i] < gate * sigma * sigma;
    }
    const auto n = static_cast<double>(std::count(used.begin(), used.end(), true));
    const auto next = n < 4.0 ? std::nullopt : fitOver(points, used);
    if (!next || (used == fit.used && round > 0)) {
      break;
    }
    fit.used = used;
    fit.fMc1 = next->aMb;
    sigma = next->rms / std::sqrt(3.0) * std::sqrt(n / (n - 2.0));
  }
}

void leaveOut(const std::vector<PointPair>& points, PointFit& fit) {
  std::vector<double> missed(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<bool> used = fit.used;
    used[i] = false;
    const auto without = fit.used[i] ? fitOver(points, used) : std::nullopt;
    if (without) {
      missed[i] = (without->aMb * points[i].point_c - points[i].point_f).norm();
    }
  }
  fit.heldout_m = rms(missed, fit.used);
}

// Of a point, expressed in c1, by the small twist of fMc1.
Eigen::Matrix<double, 3, 6> jacobian(const Vector3d& point_c) {
  Eigen::Matrix<double, 3, 6> J;
  J << Matrix3d::Identity(), -skew(point_c);
  return J;
}

void uncertaintyOf(const std::vector<PointPair>& points, PointFit& fit) {
  Covariance6 H = Covariance6::Zero();
  Vector3d squares = Vector3d::Zero();
  Vector3d middle = Vector3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (fit.used[i]) {
      const Vector3d& p = points[i].point_c;
      H += jacobian(p).transpose() * jacobian(p);
      squares += (fit.fMc1.inverse() * points[i].point_f - p).cwiseAbs2();
      middle += p;
      n += 1.0;
    }
  }
  fit.axis_rms_m = (squares / n).cwiseSqrt();
  const Vector3d variance = (squares / (n - 2.0)).cwiseMax(kLeastSigma * kLeastSigma);
  Covariance6 spread = Covariance6::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (fit.used[i]) {
      const auto J = jacobian(points[i].point_c);
      spread += J.transpose() * variance.asDiagonal() * J;
    }
  }
  const Covariance6 inverse = H.inverse();
  fit.covariance = inverse * spread * inverse;
  fit.camera_sigma_m = largestSigma(fit.covariance.topLeftCorner<3, 3>());
  fit.camera_sigma_rad = largestSigma(fit.covariance.bottomRightCorner<3, 3>());
  const auto sigmaAt = [&](const Vector3d& point_c) {
    const auto J = jacobian(point_c);
    return largestSigma(J * fit.covariance * J.transpose());
  };
  fit.workspace_sigma_m = sigmaAt(middle / n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    fit.farthest_sigma_m =
        std::max(fit.farthest_sigma_m, fit.used[i] ? sigmaAt(points[i].point_c) : 0.0);
  }
}

// Scale of the camera's points about their middle, and its standard deviation.
double scaleOf(const std::vector<PointPair>& points, PointFit& fit) {
  Vector3d f = Vector3d::Zero();
  Vector3d c = Vector3d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (fit.used[i]) {
      f += points[i].point_f;
      c += points[i].point_c;
      n += 1.0;
    }
  }
  double across = 0.0;
  double own = 0.0;
  double others = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (fit.used[i]) {
      const Vector3d turned = fit.fMc1.linear() * (points[i].point_c - c / n);
      across += turned.dot(points[i].point_f - f / n);
      own += turned.squaredNorm();
      others += (points[i].point_f - f / n).squaredNorm();
    }
  }
  fit.scale = across / own;
  const double left = std::max(0.0, others - fit.scale * across);  // sum of squares after scaling
  return std::sqrt(left / (3.0 * n - 7.0) / own);
}

// A left-handed frame fits its mirror image.
bool mirrored(const std::vector<PointPair>& points, double residual_m) {
  std::vector<PointPair> other = points;
  for (PointPair& p : other) {
    p.point_c.x() = -p.point_c.x();
  }
  const Pose pose = leastMedian(other);
  return 3.0 * median(distances(pose, other)) < residual_m;
}

Verdict judgePoints(const std::vector<PointPair>& points, const PointFit& fit, double scale_sigma) {
  const VerdictLimits limits;
  const double typical_m = median(fit.errors_m);
  if (mirrored(points, std::max(typical_m, 1e-6))) {
    return {Grade::kPoor,
            "the points fit their mirror image: one axis of robot or camera is "
            "reversed, expected right-handed frames"};
  }
  const auto all = static_cast<double>(points.size());
  if (static_cast<double>(fit.rejected.size()) > limits.rejected_share * all) {
    return {Grade::kPoor, std::to_string(fit.rejected.size()) + " of " +
                              std::to_string(points.size()) +
                              " points contradict the others; check that rows of robot and camera "
                              "belong together"};
  }
  if (std::abs(fit.scale - 1.0) > std::max(kScaleNoticed, kScaleSigmas * scale_sigma)) {
    return {Grade::kPoor, "the points fit better if the camera's are scaled by " +
                              decimals(fit.scale, 4) +
                              "; check the rig's baseline and the units of both lists"};
  }
  const double kept = all - static_cast<double>(fit.rejected.size());
  const double factor = boundFactor(3.0 * kept - 6.0);
  if (!(factor * fit.farthest_sigma_m <= limits.usable_m)) {
    return {Grade::kPoor, "points among those given may be wrong by " +
                              millimetres(factor * fit.farthest_sigma_m) +
                              "; take a larger cube, or more points"};
  }
  const bool good = factor * fit.workspace_sigma_m <= limits.good_m;
  return {good ? Grade::kGood : Grade::kUsable,
          "points in the middle of the cube come to within " + millimetres(fit.workspace_sigma_m) +
              " (standard deviation; at most " + millimetres(factor * fit.workspace_sigma_m) + ")" +
              (good ? "" : "; more points will make it better")};
}

}  // namespace

std::vector<PointPair> readPointPairs(const std::filesystem::path& file) {
  const CsvTable table(file);
  const PointColumns robot(table, "robot_");
  const PointColumns camera(table, "camera_");
  requireRows(table, file);
  std::vector<PointPair> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    points.push_back({rowName(table, row), robot.read(row), camera.read(row)});
  }
  return points;
}

PointFit fitPoints(const std::vector<PointPair>& points) {
  if (points.size() < kFewestPoints) {
    throw InputError("expected at least " + std::to_string(kFewestPoints) + " points, found " +
                     std::to_string(points.size()) + ": the eight corners of a cube are usual");
  }
  PointFit fit;
  fit.fMc1 = leastMedian(points);
  settle(points, fit);
  fit.errors_m = distances(fit.fMc1, points);
  fit.residual_m = rms(fit.errors_m, fit.used);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!fit.used[i]) {
      fit.rejected.push_back(
          {points[i].name, i, millimetres(fit.errors_m[i]) + " from where the others put it"});
    }
  }
  leaveOut(points, fit);
  uncertaintyOf(points, fit);
  const double scale_sigma = scaleOf(points, fit);
  fit.verdict = judgePoints(points, fit, scale_sigma);
  return fit;
}

}  // namespace ringhook

#include "calib/solve/verify_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "core/error.h"
#include "rig/camera_model.h"
#include "stereo/rigid_fit.h"
#include "stereo/triangulation.h"

namespace ringhook {
namespace {

constexpr int kMostIterations = 50;
constexpr double kSmallestGain = 1e-10;  // relative, of the sum of squares
constexpr double kGrossMisfit = 0.05;    // of the target's extent

using Matrix86 = Eigen::Matrix<double, 8, 6>;

/// Pixel of a point in a camera, with its derivative by the point [px/m].
struct Sight {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> jacobian;
};

Sight sightOf(const CameraModel& camera, const Eigen::Vector3d& p) {
  Eigen::Matrix2d lens;
  const Eigen::Vector2d distorted = distortNormalised(camera, p.hnormalized(), &lens);
  const Eigen::Matrix2d F = camera.K.topLeftCorner<2, 2>();
  Eigen::Matrix<double, 2, 3> flat;
  flat << 1.0 / p.z(), 0.0, -p.x() / (p.z() * p.z()), 0.0, 1.0 / p.z(), -p.y() / (p.z() * p.z());
  return {F * distorted + camera.K.topRightCorner<2, 1>(), F * lens * flat};
}

/// The normal equations of one view: shared changes, its pose, and both together.
struct ViewSums {
  Matrix8 A = Matrix8::Zero();
  Matrix86 B = Matrix86::Zero();
  Covariance6 C = Covariance6::Zero();
  Vector8 a = Vector8::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  double squares = 0.0;

  void add(const Eigen::Matrix<double, 2, 8>& Js, const Eigen::Matrix<double, 2, 6>& Jp,
           const Eigen::Vector2d& r) {
    A += Js.transpose() * Js;
    B += Js.transpose() * Jp;
    C += Jp.transpose() * Jp;
    a -= Js.transpose() * r;
    b -= Jp.transpose() * r;
    squares += r.squaredNorm();
  }
};

ViewSums sumView(const StereoRig& rig, const Pose& c1Mt, const SightedView& view) {
  ViewSums sums;
  for (std::size_t i = 0; i < view.points_t.size(); ++i) {
    const Eigen::Vector3d p1 = c1Mt * view.points_t[i];
    const Eigen::Vector3d p2 = rig.c2Mc1 * p1;
    Eigen::Matrix<double, 3, 6> motion;  // of p1, by the pose's twist at and in t
    motion << c1Mt.linear(), -c1Mt.linear() * skew(view.points_t[i]);
    Eigen::Matrix<double, 3, 6> turn;  // of p2, by the twist at and in c2
    turn << Eigen::Matrix3d::Identity(), -skew(p2);
    const Sight left = sightOf(rig.left, p1);
    const Sight right = sightOf(*rig.right, p2);
    Eigen::Matrix<double, 2, 8> shared = Eigen::Matrix<double, 2, 8>::Zero();
    shared.col(6) = left.pixel - rig.left.K.topRightCorner<2, 1>();
    sums.add(shared, left.jacobian * motion, left.pixel - view.left_px[i]);
    shared.col(6).setZero();
    shared.leftCols<6>() = right.jacobian * turn;
    shared.col(7) = right.pixel - rig.right->K.topRightCorner<2, 1>();
    sums.add(shared, right.jacobian * rig.c2Mc1.linear() * motion, right.pixel - view.right_px[i]);
  }
  return sums;
}

/// The parameters that may not change get an equation of their own that keeps them.
void hold(const RigChanges& free, Matrix8& H, Vector8& g) {
  for (int i = 0; i < 8; ++i) {
    if (i < 6 ? !free.pose : !free.focal) {
      H.row(i).setZero();
      H.col(i).setZero();
      H(i, i) = 1.0;
      g[i] = 0.0;
    }
  }
}

void scaleFocal(CameraModel& camera, double s) {
  camera.K(0, 0) *= 1.0 + s;
  camera.K(1, 1) *= 1.0 + s;
}

/// One step of Gauss-Newton; the sum of squares before it.
double step(RigFit& fit, const std::vector<SightedView>& views, const RigChanges& free) {
  std::vector<ViewSums> sums;
  Matrix8 H = Matrix8::Zero();
  Vector8 g = Vector8::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewSums& s = sums.emplace_back(sumView(fit.rig, fit.c1Mt[i], views[i]));
    const Matrix86 BC = s.B * s.C.inverse();
    H += s.A - BC * s.B.transpose();
    g += s.a - BC * s.b;
    squares += s.squares;
  }
  hold(free, H, g);
  fit.covariance = H.inverse();
  for (int i = 0; i < 8; ++i) {
    if (i < 6 ? !free.pose : !free.focal) {
      fit.covariance(i, i) = 0.0;
    }
  }
  const Vector8 change = H.ldlt().solve(g);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Twist twist = sums[i].C.ldlt().solve(sums[i].b - sums[i].B.transpose() * change);
    fit.c1Mt[i] = fit.c1Mt[i] * expSe3(twist);
  }
  fit.rig.c2Mc1 = expSe3(change.head<6>()) * fit.rig.c2Mc1;
  scaleFocal(fit.rig.left, change[6]);
  scaleFocal(*fit.rig.right, change[7]);
  fit.change += change;
  return squares;
}

double squaresOf(const RigFit& fit, const std::vector<SightedView>& views) {
  double squares = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    squares += sumView(fit.rig, fit.c1Mt[i], views[i]).squares;
  }
  return squares;
}

PinholeView normalisedView(const Pose& cMc1) { return {1.0, 1.0, 0.0, 0.0, 1, 1, cMc1}; }

}  // namespace

std::vector<Eigen::Vector3d> locatePoints(const StereoRig& rig, const SightedView& view) {
  // In normalised coordinates: no residual is too large here, the rays only have to meet.
  const TriangulationOptions options{1e-6, 1e9};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < view.points_t.size(); ++i) {
    const auto left = undistortPixel(rig.left, view.left_px[i]);
    const auto right = undistortPixel(*rig.right, view.right_px[i]);
    const auto point =
        left && right ? triangulateMidpoint(normalisedView(Pose::Identity()),
                                            normalisedView(rig.c2Mc1), *left, *right, 1.0, options)
                      : Outcome<TriangulatedPoint>(Refusal{"pixel beyond the lens model"});
    if (!point) {
      throw InputError(view.name + ": a point cannot be located with this rig (" + point.reason() +
                       "), expected pictures that the rig's cameras took at one instant");
    }
    points.push_back(point->point_c1);
  }
  return points;
}

RigFit startFit(const StereoRig& rig, const std::vector<SightedView>& views) {
  RigFit fit;
  fit.rig = rig;
  for (const SightedView& view : views) {
    const std::vector<Eigen::Vector3d> points_c1 = locatePoints(rig, view);
    double extent = 0.0;
    for (const Eigen::Vector3d& p : view.points_t) {
      extent = std::max(extent, (p - view.points_t.front()).norm());
    }
    const auto rigid = fitRigid(points_c1, view.points_t);
    if (!rigid || rigid->rms > kGrossMisfit * extent) {
      throw InputError(view.name +
                       ": the points located with this rig do not have the target's "
                       "shape, expected the target as described and pictures taken "
                       "by the rig's cameras at one instant");
    }
    fit.c1Mt.push_back(rigid->aMb);
    fit.residuals += 4 * static_cast<int>(view.points_t.size());
  }
  return fit;
}

RigFit fitRig(const RigFit& start, const std::vector<SightedView>& views, const RigChanges& free) {
  RigFit fit = start;
  double before = step(fit, views, free);
  for (int i = 0; i < kMostIterations; ++i) {
    const double now = step(fit, views, free);
    const bool settled = std::abs(before - now) <= kSmallestGain * (1e-9 + now);
    before = now;
    if (settled) {
      break;
    }
  }
  fit.squares = squaresOf(fit, views);
  if (!std::isfinite(fit.squares) || std::abs(fit.squares - before) > 1e-3 * (1e-6 + before)) {
    throw Error(
        "the views cannot be fitted to the rig: take more of them, with the target tilted "
        "in different directions");
  }
  fit.freedom = fit.residuals - 6 * static_cast<int>(views.size()) - (free.pose ? 6 : 0) -
                (free.focal ? 2 : 0);
  return fit;
}

}  // namespace ringhook

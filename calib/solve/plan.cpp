#include "calib/solve/plan.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "rig/camera_model.h"

namespace ringhook {
namespace {

constexpr int kFieldSteps = 60;  // of the grid that finds the field's middle and area

/// Derivative of the undistorted pixels by the point in that camera [px/m].
Eigen::Matrix<double, 2, 3> pixelByPoint(const Eigen::Matrix3d& K, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> J;
  J << K(0, 0) / p.z(), 0.0, -K(0, 0) * p.x() / (p.z() * p.z()),  //
      0.0, K(1, 1) / p.z(), -K(1, 1) * p.y() / (p.z() * p.z());
  return J;
}

/// Covariance of an undistorted pixel whose raw pixel has noise 1 per axis.
Eigen::Matrix2d undistortedNoise(const CameraModel& camera, const Eigen::Vector3d& point_c) {
  Eigen::Matrix2d lens;
  distortNormalised(camera, point_c.hnormalized(), &lens);
  const Eigen::Matrix2d F = camera.K.topLeftCorner<2, 2>();
  const Eigen::Matrix2d back = F * lens.inverse() * F.inverse();
  return back * back.transpose();
}

double roomIn(const CameraModel& camera, double fold, const Eigen::Vector3d& point_c) {
  if (!(point_c.z() > 0.0) || !(point_c.hnormalized().norm() < fold)) {
    return -std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector2d p = projectNormalised(camera, point_c.hnormalized());
  return std::min({p.x(), p.y(), camera.width - 1.0 - p.x(), camera.height - 1.0 - p.y()});
}

/// The largest step s <= most with visible(s), which holds at 0, by bisection.
template <class Visible>
double reach(double most, Visible visible) {
  double inside = 0.0;
  double outside = most;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + outside);
    (visible(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// Half side of a square about the axis that holds all that the left camera sees at a distance.
double largestReach(const PlanView& view, double distance_m) {
  const CameraModel& camera = view.rig.left;
  const double tangent = std::hypot(camera.width / camera.K(0, 0), camera.height / camera.K(1, 1));
  return 2.0 * distance_m * std::tan(std::min(1.4, std::atan(tangent) + view.vergence_rad)) +
         view.baseline_m;
}

/// What both cameras see of a grid.
struct Seen {
  int cells = 0;
  Eigen::Vector2d sum{0, 0};   ///< of the cells seen [m]
  Eigen::AlignedBox2d bounds;  ///< of them [m]
  double cell_m2 = 0.0;        ///< area of one
};

Seen scan(const PlanView& view, double distance_m, const Eigen::AlignedBox2d& box) {
  Seen seen;
  const Eigen::Vector2d step = box.sizes() / kFieldSteps;
  seen.cell_m2 = step.prod();
  for (int i = 0; i < kFieldSteps; ++i) {
    for (int j = 0; j < kFieldSteps; ++j) {
      const Eigen::Vector2d p = box.min() + step.cwiseProduct(Eigen::Vector2d(i + 0.5, j + 0.5));
      if (view.room({p.x(), p.y(), distance_m}) >= 0.0) {
        seen.sum += p;
        seen.bounds.extend(p);
        ++seen.cells;
      }
    }
  }
  return seen;
}

/// Normal equations of residuals that have noise of their own: (J^T J)^-1 J^T S J (J^T J)^-1.
template <int N>
struct Sandwich {
  Eigen::Matrix<double, N, N> H = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, N> M = Eigen::Matrix<double, N, N>::Zero();

  void add(const Eigen::Matrix<double, 2, N>& J, const Eigen::Matrix2d& noise) {
    H += J.transpose() * J;
    M += J.transpose() * noise * J;
  }
  [[nodiscard]] Eigen::Matrix<double, N, N> covariance(double sigma_px) const {
    const Eigen::Matrix<double, N, N> inverse = H.inverse();
    return sigma_px * sigma_px * inverse * M * inverse;
  }
};

}  // namespace

StereoRig plannedRig(const PlannedSetup& setup) {
  StereoRig rig;
  rig.left.width = setup.sensor.width;
  rig.left.height = setup.sensor.height;
  rig.left.K << setup.sensor.focal_px, 0.0, 0.5 * (setup.sensor.width - 1), 0.0,
      setup.sensor.focal_px, 0.5 * (setup.sensor.height - 1), 0.0, 0.0, 1.0;
  rig.right = rig.left;
  const Eigen::AngleAxisd inwards(0.5 * setup.vergence_rad, Eigen::Vector3d::UnitY());
  Pose mMc1 = Pose::Identity();
  mMc1.linear() = inwards.toRotationMatrix();
  mMc1.translation().x() = -0.5 * setup.baseline_m;
  Pose mMc2 = Pose::Identity();
  mMc2.linear() = inwards.inverse().toRotationMatrix();
  mMc2.translation().x() = 0.5 * setup.baseline_m;
  rig.c2Mc1 = mMc2.inverse() * mMc1;
  return rig;
}

double crossingVergence(double baseline_m, double distance_m) {
  return 2.0 * std::atan2(0.5 * baseline_m, distance_m);
}

PlanView::PlanView(const StereoRig& given) : rig(given) {
  if (!rig.right) {
    throw InputError("the rig has one camera, expected two (keys K2 D2 R T)");
  }
  const Pose c1Mc2 = rig.c2Mc1.inverse();
  const Eigen::Vector3d centre2 = c1Mc2.translation();
  const Eigen::Vector3d axis2 = c1Mc2.linear().col(2);
  baseline_m = centre2.norm();
  vergence_rad = std::atan2(axis2.cross(Eigen::Vector3d::UnitZ()).norm(), axis2.z());
  const Eigen::Vector3d x = (centre2.x() < 0.0 ? -1.0 : 1.0) * centre2.normalized();
  const Eigen::Vector3d y = (Eigen::Vector3d::UnitZ() + axis2).cross(x).normalized();
  if (!y.allFinite() || y.norm() < 0.5) {
    throw InputError("the rig's cameras look along their baseline, expected them side by side");
  }
  c1Mm.linear().col(0) = x;
  c1Mm.linear().col(1) = y;
  c1Mm.linear().col(2) = x.cross(y);
  c1Mm.translation() = 0.5 * centre2;
  c1Mm.makeAffine();
  left_fold = foldRadius(rig.left);
  right_fold = foldRadius(*rig.right);
}

std::optional<double> PlanView::crossingDistance() const {
  // In the plane of x and z of m: both axes as lines x = x0 + s z.
  const Eigen::Vector3d axis1 = c1Mm.linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis2 =
      c1Mm.linear().transpose() * rig.c2Mc1.linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d centre1 = c1Mm.inverse().translation();
  const double closing = axis1.x() / axis1.z() - axis2.x() / axis2.z();
  const double distance = -2.0 * centre1.x() / closing;
  return distance > 0.0 && distance < 1e3 * baseline_m ? std::optional(distance) : std::nullopt;
}

double PlanView::room(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d point_c1 = c1Mm * point_m;
  return std::min(roomIn(rig.left, left_fold, point_c1),
                  roomIn(*rig.right, right_fold, rig.c2Mc1 * point_c1));
}

Eigen::Matrix3d pointCovariance(const PlanView& view, const Eigen::Vector3d& point_m,
                                double sigma_px) {
  const Eigen::Vector3d point_c1 = view.c1Mm * point_m;
  const Eigen::Vector3d point_c2 = view.rig.c2Mc1 * point_c1;
  const Eigen::Matrix3d c1Rm = view.c1Mm.linear();
  Sandwich<3> sum;
  sum.add(pixelByPoint(view.rig.left.K, point_c1) * c1Rm,
          undistortedNoise(view.rig.left, point_c1));
  sum.add(pixelByPoint(view.rig.right->K, point_c2) * view.rig.c2Mc1.linear() * c1Rm,
          undistortedNoise(*view.rig.right, point_c2));
  return sum.covariance(sigma_px);
}

Covariance6 targetCovariance(const PlanView& view, const std::vector<Eigen::Vector3d>& points_o,
                             const Pose& mMo, double sigma_px) {
  Sandwich<6> sum;
  for (const Eigen::Vector3d& point_o : points_o) {
    Eigen::Matrix<double, 3, 6> motion_o;  // of the point, by the twist at and in o
    motion_o << Eigen::Matrix3d::Identity(), -skew(point_o);
    const Pose c1Mo = view.c1Mm * mMo;
    const Pose c2Mo = view.rig.c2Mc1 * c1Mo;
    sum.add(pixelByPoint(view.rig.left.K, c1Mo * point_o) * c1Mo.linear() * motion_o,
            undistortedNoise(view.rig.left, c1Mo * point_o));
    sum.add(pixelByPoint(view.rig.right->K, c2Mo * point_o) * c2Mo.linear() * motion_o,
            undistortedNoise(*view.rig.right, c2Mo * point_o));
  }
  return sum.covariance(sigma_px);
}

std::vector<Eigen::Vector3d> tagCornersOf(double size_m) {
  const double h = 0.5 * size_m;
  return {{-h, -h, 0.0}, {h, -h, 0.0}, {h, h, 0.0}, {-h, h, 0.0}};
}

StereoField stereoField(const PlanView& view, double distance_m) {
  const double half = largestReach(view, distance_m);
  const Seen rough =
      scan(view, distance_m,
           Eigen::AlignedBox2d(Eigen::Vector2d(-half, -half), Eigen::Vector2d(half, half)));
  StereoField field;
  field.distance_m = distance_m;
  if (rough.cells == 0) {
    return field;
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(2.0 * half / kFieldSteps);
  const Seen fine =
      scan(view, distance_m, {rough.bounds.min() - margin, rough.bounds.max() + margin});
  const Eigen::Vector2d middle = fine.sum / fine.cells;
  field.area_m2 = fine.cells * fine.cell_m2;
  const auto edge = [&](const Eigen::Vector2d& way) {
    return reach(half, [&](double s) {
      const Eigen::Vector2d p = middle + s * way;
      return view.room({p.x(), p.y(), distance_m}) >= 0.0;
    });
  };
  field.low_m = middle - Eigen::Vector2d(edge({-1.0, 0.0}), edge({0.0, -1.0}));
  field.high_m = middle + Eigen::Vector2d(edge({1.0, 0.0}), edge({0.0, 1.0}));
  return field;
}

}  // namespace ringhook

#include "stereo/plate_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <optional>

#include "core/shortest_turn.h"
#include "stereo/joint_pose.h"
#include "stereo/plane_fit.h"
#include "stereo/rigid_fit.h"
#include "stereo/triangulation.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

constexpr double kSingular = 1e-6;  // determinant between normalised points, a line's is zero
constexpr double kFlatness = 0.02;  // distance from the plane over extent

/// Plane of model points, refused where they are not flat.
Outcome<Plane> modelPlane(const std::vector<Vector3d>& points_o) {
  auto plane = fitPlane(points_o);
  if (plane) {
    double extent = 0.0;
    for (const Vector3d& p : points_o) {
      extent = std::max(extent, (p - plane->centroid).norm());
    }
    if (plane->rms > kFlatness * extent) {
      return Refusal{"corners not in one plane"};
    }
  }
  return plane;
}

std::vector<Vector3d> modelPoints(const CameraFeatures& camera) {
  std::vector<Vector3d> points;
  for (const CornerFeature& corner : camera.corners) {
    points.push_back(corner.point_o);
  }
  return points;
}

/// Pose that lays the model's plane on the measured one and fits within it: exact where the normal
/// is given, least squares for the rest. `c1Rplane` has the measured normal as its third column.
RigidFit fitInPlane(const std::vector<Vector3d>& points_c1, const Matrix3d& c1Rplane,
                    const Vector3d& centroid_c1, const std::vector<Vector3d>& points_o,
                    const Plane& model) {
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < points_o.size(); ++i) {
    const Vector3d seen = c1Rplane.transpose() * (points_c1[i] - centroid_c1);
    const Vector3d known = model.axes.transpose() * (points_o[i] - model.centroid);
    along += known.head<2>().dot(seen.head<2>());
    across += known.x() * seen.y() - known.y() * seen.x();
  }
  const Matrix3d turn =
      Eigen::AngleAxisd(std::atan2(across, along), Vector3d::UnitZ()).toRotationMatrix();
  RigidFit fit;
  fit.aMb = Pose::Identity();
  fit.aMb.linear() = c1Rplane * turn * model.axes.transpose();
  fit.aMb.translation() = centroid_c1 - fit.aMb.linear() * model.centroid;
  for (std::size_t i = 0; i < points_o.size(); ++i) {
    fit.rms += (points_c1[i] - fit.aMb * points_o[i]).squaredNorm();
  }
  fit.rms = std::sqrt(fit.rms / static_cast<double>(points_o.size()));
  return fit;
}

/// Scale and shift that bring points to mean 0 and mean length sqrt(2).
Matrix3d normaliser(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  double length = 0.0;
  for (const Vector2d& p : points) {
    length += (p - mean).norm() / static_cast<double>(points.size());
  }
  const double s = std::sqrt(2.0) / length;
  Matrix3d T;
  T << s, 0, -s * mean.x(), 0, s, -s * mean.y(), 0, 0, 1;
  return T;
}

/// Homography from plane coordinates to normalised image coordinates, least squares. Its last
/// entry between normalised points is 1: the depth of their centroid, which the camera sees.
Outcome<Matrix3d> homography(const std::vector<Vector2d>& plane,
                             const std::vector<Vector2d>& image) {
  const Matrix3d T = normaliser(plane);
  const Matrix3d S = normaliser(image);
  Matrix8 information = Matrix8::Zero();
  Vector8 right = Vector8::Zero();
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const Eigen::RowVector3d p = (T * plane[i].homogeneous()).transpose();
    const Vector3d q = S * image[i].homogeneous();
    Eigen::Matrix<double, 2, 8> rows;
    rows << p, Eigen::RowVector3d::Zero(), -q.x() * p.head<2>(),  //
        Eigen::RowVector3d::Zero(), p, -q.y() * p.head<2>();
    information += rows.transpose().lazyProduct(rows);
    right += rows.transpose() * q.head<2>();
  }
  const Eigen::LLT<Matrix8> normal(information);
  const Vector8 h = normal.solve(right);
  Matrix3d H;
  H << h.head<3>().transpose(), h.segment<3>(3).transpose(), h.tail<2>().transpose(), 1.0;
  if (normal.info() != Eigen::Success || !(std::abs(H.determinant()) > kSingular)) {
    return Refusal{"corners seen on one line"};
  }
  return Matrix3d(S.inverse() * H * T);
}

/// Camera pose of the plane frame: H = lambda (r1 r2 t), the rotation made orthonormal.
Pose poseOfHomography(Matrix3d H) {
  H *= (H(2, 2) < 0.0 ? -2.0 : 2.0) / (H.col(0).norm() + H.col(1).norm());
  Matrix3d R;
  R << H.col(0), H.col(1), H.col(0).cross(H.col(1));
  const Eigen::JacobiSVD<Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Pose cMplane = Pose::Identity();
  cMplane.linear() = svd.matrixU() * svd.matrixV().transpose();
  cMplane.translation() = H.col(2);
  return cMplane;
}

/// The other pose of a flat target: its normal mirrored at the line of sight, by the shortest turn.
Pose mirroredPose(const Pose& cMplane) {
  const Vector3d sight = cMplane.translation().normalized();
  const Vector3d normal = cMplane.linear().col(2);
  const Vector3d mirrored = 2.0 * normal.dot(sight) * sight - normal;
  Pose other = cMplane;
  other.linear() = shortestTurn(normal, mirrored).toRotationMatrix() * cMplane.linear();
  return other;
}

/// Both candidates c1Mo of one camera.
Outcome<std::vector<Pose>> candidatesOf(const CameraFeatures& camera) {
  const auto model = modelPlane(modelPoints(camera));
  if (!model) {
    return Refusal{model.reason()};
  }
  Pose oMplane = Pose::Identity();
  oMplane.linear() = model->axes;
  oMplane.translation() = model->centroid;
  std::vector<Vector2d> plane;
  std::vector<Vector2d> image;
  for (const CornerFeature& corner : camera.corners) {
    plane.emplace_back((oMplane.inverse() * corner.point_o).head<2>());
    image.emplace_back((corner.pixel.x() - camera.camera.cx) / camera.camera.fx,
                       (corner.pixel.y() - camera.camera.cy) / camera.camera.fy);
  }
  const auto H = homography(plane, image);
  if (!H) {
    return Refusal{H.reason()};
  }
  const Pose cMplane = poseOfHomography(*H);
  const Pose c1Mc = camera.camera.cMc1.inverse();
  return std::vector<Pose>{c1Mc * cMplane * oMplane.inverse(),
                           c1Mc * mirroredPose(cMplane) * oMplane.inverse()};
}

struct MatchedCorners {
  std::vector<Vector3d> points_c1;
  std::vector<Vector3d> points_o;
};

Outcome<MatchedCorners> triangulateCorners(const CameraFeatures& left,
                                           const CameraFeatures& right) {
  MatchedCorners out;
  for (const CornerFeature& l : left.corners) {
    for (const CornerFeature& r : right.corners) {
      if (l.point_o != r.point_o) {
        continue;
      }
      const auto point =
          triangulateMidpoint(left.camera, right.camera, l.pixel, r.pixel, l.sigma_px);
      if (!point) {
        return Refusal{point.reason()};
      }
      out.points_c1.push_back(point->point_c1);
      out.points_o.push_back(l.point_o);
    }
  }
  return out;
}

}  // namespace

Outcome<Pose> platePoseFromPoints(const HookView& view) {
  if (view.cameras.size() < 2) {
    return Refusal{"needs two cameras"};
  }
  const auto corners = triangulateCorners(view.cameras[0], view.cameras[1]);
  if (!corners) {
    return Refusal{corners.reason()};
  }
  const auto model = modelPlane(corners->points_o);
  const auto seen = fitPlane(corners->points_c1);
  if (!model || !seen) {
    return Refusal{model ? seen.reason() : model.reason()};
  }
  // The fitted normal has no sign: the right one lets the corners meet within the plane.
  Matrix3d turned_over = seen->axes;
  turned_over.rightCols<2>() *= -1.0;
  const RigidFit one =
      fitInPlane(corners->points_c1, seen->axes, seen->centroid, corners->points_o, *model);
  const RigidFit other =
      fitInPlane(corners->points_c1, turned_over, seen->centroid, corners->points_o, *model);
  return one.rms <= other.rms ? one.aMb : other.aMb;
}

Outcome<Pose> planarStartPose(const std::vector<CameraFeatures>& cameras) {
  HookView view;
  for (const CameraFeatures& camera : cameras) {
    view.cameras.push_back({camera.camera, camera.corners, {}});
  }
  JointPoseOptions generous;
  generous.largest_rms_px = std::numeric_limits<double>::infinity();
  std::optional<HookFix> best;
  std::string reason = "too few corners";
  for (const CameraFeatures& camera : cameras) {
    if (camera.corners.size() < 4) {
      continue;
    }
    const auto candidates = candidatesOf(camera);
    reason = candidates ? "no pose explains the corners" : candidates.reason();
    for (const Pose& c1Mo : candidates ? *candidates : std::vector<Pose>{}) {
      view.c1Mo_start = c1Mo;
      const auto fix = fixFromView(view, generous);
      if (fix && (!best || fix->rms_px < best->rms_px)) {
        best = *fix;
      }
    }
  }
  if (!best) {
    return Refusal{reason};
  }
  return best->c1Mo;
}

Outcome<HookFix> singleViewFix(const HookView& view, std::size_t camera) {
  if (camera >= view.cameras.size()) {
    return Refusal{"no such camera"};
  }
  HookView one;
  one.time = view.time;
  one.cameras = {view.cameras[camera]};
  const auto start = planarStartPose(one.cameras);
  if (!start) {
    return Refusal{start.reason()};
  }
  one.c1Mo_start = *start;
  return fixFromView(one);
}

}  // namespace ringhook

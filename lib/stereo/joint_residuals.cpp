#include "stereo/joint_residuals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stereo/projection.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double kMadToSigma = 1.4826;  // of a Gaussian

/// Derivative of c1Mo * exp(d) * p_o by d, turned into a frame by R.
Matrix36 motionJacobian(const Matrix3d& R, const Vector3d& point_o) {
  Matrix36 J;
  J.leftCols<3>() = R;
  J.rightCols<3>() = -R * skew(point_o);
  return J;
}

bool addCorner(const PinholeView& camera, const CornerFeature& corner, const Pose& c1Mo,
               ResidualRows& out) {
  const auto projection = projectWithJacobian(camera, c1Mo * corner.point_o);
  if (!projection) {
    return false;
  }
  const Eigen::Matrix<double, 2, 6> J =
      projection->jacobian * motionJacobian(c1Mo.linear(), corner.point_o);
  const Vector2d r = projection->pixel - corner.pixel;
  for (Eigen::Index i = 0; i < 2; ++i) {
    out.rows.push_back({r[i], J.row(i), corner.sigma_px, 1.0, 1.0});
  }
  return true;
}

/// The plane through camera and edge has the normal N = A x B; in pixels the line is L = K^-T N,
/// and r = L . x / |(L_u, L_v)|. It stands even if one end is behind the camera.
bool addEdge(const PinholeView& camera, const EdgeFeature& edge, const Pose& cMo,
             ResidualRows& out) {
  const Vector3d a = cMo * edge.start_o;
  const Vector3d b = cMo * edge.end_o;
  if (!(a.z() > 0.0) && !(b.z() > 0.0)) {
    return false;
  }
  const Vector3d normal = a.cross(b);
  const Vector2d direction(normal.x() / camera.fx, normal.y() / camera.fy);
  const double length = direction.norm();
  const Vector3d ray((edge.pixel.x() - camera.cx) / camera.fx,
                     (edge.pixel.y() - camera.cy) / camera.fy, 1.0);
  const double r = normal.dot(ray) / length;
  const Vector3d by_normal =
      (ray - r / length * Vector3d(direction.x() / camera.fx, direction.y() / camera.fy, 0.0)) /
      length;
  // by_normal . (dA x B + A x dB) = (B x by_normal) . dA + (by_normal x A) . dB
  const Matrix3d R = cMo.linear();
  ResidualRow row;
  row.r_px = r;
  row.J = b.cross(by_normal).transpose() * motionJacobian(R, edge.start_o) +
          by_normal.cross(a).transpose() * motionJacobian(R, edge.end_o);
  row.sigma_px = edge.sigma_px;
  out.rows.push_back(row);
  return true;
}

/// Scale of the standardised edge residuals, at least 1: the given sigma is believed, not beaten.
double edgeScale(const ResidualRows& rows) {
  std::vector<double> sizes;
  sizes.reserve(rows.rows.size() - rows.corner_rows);
  for (std::size_t i = rows.corner_rows; i < rows.rows.size(); ++i) {
    sizes.push_back(std::abs(rows.rows[i].r_px / rows.rows[i].sigma_px));
  }
  if (sizes.empty()) {
    return 1.0;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(1.0, kMadToSigma * *middle);
}

struct EdgeCount {
  const EdgeFeature* edge;
  double sites;
};

EdgeCount& findOrAdd(std::vector<EdgeCount>& counts, const EdgeFeature& edge) {
  for (EdgeCount& count : counts) {
    if (count.edge->start_o == edge.start_o && count.edge->end_o == edge.end_o) {
      return count;
    }
  }
  counts.push_back({&edge, 0.0});
  return counts.back();
}

}  // namespace

bool evaluateRows(const HookView& view, const Pose& c1Mo, ResidualRows& out) {
  out.rows.clear();
  for (const CameraFeatures& camera : view.cameras) {
    for (const CornerFeature& corner : camera.corners) {
      if (!addCorner(camera.camera, corner, c1Mo, out)) {
        return false;
      }
    }
  }
  out.corner_rows = out.rows.size();
  for (const CameraFeatures& camera : view.cameras) {
    const Pose cMo = camera.camera.cMc1 * c1Mo;
    for (const EdgeFeature& edge : camera.edges) {
      if (!addEdge(camera.camera, edge, cMo, out)) {
        return false;
      }
    }
  }
  return true;
}

void countSharedEdges(const HookView& view, double correlation, ResidualRows& rows) {
  std::size_t row = rows.corner_rows;
  for (const CameraFeatures& camera : view.cameras) {
    std::vector<EdgeCount> counts;
    for (const EdgeFeature& edge : camera.edges) {
      findOrAdd(counts, edge).sites += 1.0;
    }
    for (const EdgeFeature& edge : camera.edges) {
      const double sites = findOrAdd(counts, edge).sites;
      rows.rows[row++].independence = 1.0 / (1.0 + (sites - 1.0) * correlation);
    }
  }
}

void weighRows(const JointPoseOptions& options, ResidualRows& rows) {
  for (std::size_t i = 0; i < rows.corner_rows; i += 2) {
    ResidualRow& u = rows.rows[i];
    ResidualRow& v = rows.rows[i + 1];
    const double size = std::hypot(u.r_px, v.r_px) / u.sigma_px;
    u.weight = v.weight = size > options.huber_sigmas ? options.huber_sigmas / size : 1.0;
  }
  const double limit = options.tukey_sigmas * edgeScale(rows);
  for (std::size_t i = rows.corner_rows; i < rows.rows.size(); ++i) {
    ResidualRow& row = rows.rows[i];
    const double share = row.r_px / row.sigma_px / limit;
    const double rest = 1.0 - share * share;
    row.weight = rest > 0.0 ? rest * rest : 0.0;
  }
}

}  // namespace ringhook

#include "tracking/plate_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Normal {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Normal equations of the corner residuals for a small twist d in c1Mo * exp(d).
Normal linearise(const std::vector<CameraFeatures>& cameras, const Pose& c1Mo) {
  Normal sum;
  for (const CameraFeatures& seen : cameras) {
    const PinholeView& cam = seen.camera;
    const Pose cMo = cam.cMc1 * c1Mo;
    for (const CornerFeature& corner : seen.corners) {
      const Eigen::Vector3d p = cMo * corner.point_o;
      Eigen::Matrix<double, 2, 3> projection;
      projection << cam.fx / p.z(), 0.0, -cam.fx * p.x() / (p.z() * p.z()),  //
          0.0, cam.fy / p.z(), -cam.fy * p.y() / (p.z() * p.z());
      Eigen::Matrix<double, 3, 6> motion;
      motion << cMo.linear(), -cMo.linear() * skew(corner.point_o);
      const Eigen::Matrix<double, 2, 6> J = projection * motion;
      const Eigen::Vector2d seen_minus_model =
          corner.pixel -
          Eigen::Vector2d(cam.fx * p.x() / p.z() + cam.cx, cam.fy * p.y() / p.z() + cam.cy);
      sum.information += J.transpose() * J;
      sum.gradient += J.transpose() * seen_minus_model;
    }
  }
  return sum;
}

/// Both poses of one tag in one camera that its four corners allow: cMo.
std::vector<Pose> tagCandidates(const PinholeView& cam, const CornerFeature* corners) {
  // The tag's own frame: origin at its centre, x to the right, y down.
  const Eigen::Vector3d centre =
      (corners[0].point_o + corners[1].point_o + corners[2].point_o + corners[3].point_o) / 4.0;
  const Eigen::Vector3d side = corners[1].point_o - corners[0].point_o;
  Pose oMtag = Pose::Identity();
  oMtag.linear().col(0) = side.normalized();
  oMtag.linear().col(2) = side.cross(corners[3].point_o - corners[0].point_o).normalized();
  oMtag.linear().col(1) = oMtag.linear().col(2).cross(oMtag.linear().col(0));
  oMtag.translation() = centre;
  std::vector<cv::Point3d> model;
  std::vector<cv::Point2d> pixels;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = oMtag.inverse() * corners[i].point_o;
    model.emplace_back(p.x(), p.y(), 0.0);
    pixels.emplace_back(corners[i].pixel.x(), corners[i].pixel.y());
  }
  const cv::Matx33d K(cam.fx, 0, cam.cx, 0, cam.fy, cam.cy, 0, 0, 1);
  std::vector<cv::Vec3d> rotations;
  std::vector<cv::Vec3d> positions;
  cv::solvePnPGeneric(model, pixels, K, cv::noArray(), rotations, positions, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<Pose> found;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const cv::Vec3d& r = rotations[i];
    const cv::Vec3d& t = positions[i];
    const Pose cMtag = makePoseThetaU({t[0], t[1], t[2]}, {r[0], r[1], r[2]});
    if (cMtag.matrix().allFinite()) {
      found.push_back(cMtag * oMtag.inverse());
    }
  }
  return found;
}

/// Every tag must turn its printed face to the camera that reads it (z_tag points into the plate).
bool facesCameras(const std::vector<CameraFeatures>& cameras, const Pose& c1Mo) {
  for (const CameraFeatures& seen : cameras) {
    const Pose cMo = seen.camera.cMc1 * c1Mo;
    for (std::size_t i = 0; i + 3 < seen.corners.size(); i += 4) {
      const Eigen::Vector3d a = cMo * seen.corners[i].point_o;
      const Eigen::Vector3d right = cMo * seen.corners[i + 1].point_o - a;
      const Eigen::Vector3d down = cMo * seen.corners[i + 3].point_o - a;
      if (a.z() <= 0.0 || right.cross(down).dot(a) <= 0.0) {
        return false;
      }
    }
  }
  return true;
}

std::vector<Pose> candidates(const std::vector<CameraFeatures>& cameras) {
  std::vector<Pose> all;
  try {
    for (const CameraFeatures& seen : cameras) {
      for (std::size_t i = 0; i + 3 < seen.corners.size(); i += 4) {
        for (const Pose& cMo : tagCandidates(seen.camera, &seen.corners[i])) {
          all.push_back(seen.camera.cMc1.inverse() * cMo);
        }
      }
    }
  } catch (const cv::Exception& e) {
    throw Error(std::string("tag plate: start pose failed inside OpenCV: ") + e.what());
  }
  return all;
}

}  // namespace

double cornerRms(const std::vector<CameraFeatures>& cameras, const Pose& c1Mo) {
  double sum = 0.0;
  int residuals = 0;
  for (const CameraFeatures& seen : cameras) {
    for (const CornerFeature& corner : seen.corners) {
      const auto pixel = seen.camera.project(c1Mo * corner.point_o);
      if (!pixel) {
        return kFar;
      }
      sum += (*pixel - corner.pixel).squaredNorm();
      residuals += 2;
    }
  }
  return residuals == 0 ? kFar : std::sqrt(sum / residuals);
}

Pose refineOnCorners(const std::vector<CameraFeatures>& cameras, Pose c1Mo) {
  double rms = cornerRms(cameras, c1Mo);
  double damping = 1e-3;
  for (int step = 0; step < 30 && std::isfinite(rms); ++step) {
    const Normal normal = linearise(cameras, c1Mo);
    Eigen::Matrix<double, 6, 6> damped = normal.information;
    damped.diagonal() *= 1.0 + damping;
    const Twist d = damped.ldlt().solve(normal.gradient);
    const Pose moved = c1Mo * expSe3(d);
    const double moved_rms = cornerRms(cameras, moved);
    if (!(moved_rms < rms)) {
      damping *= 10.0;
      if (damping > 1e6) {
        break;
      }
      continue;
    }
    const bool settled = rms - moved_rms < 1e-7;
    c1Mo = moved;
    rms = moved_rms;
    damping = std::max(1e-9, damping * 0.1);
    if (settled) {
      break;
    }
  }
  return c1Mo;
}

std::optional<Pose> startPose(const std::vector<CameraFeatures>& cameras,
                              const std::optional<Pose>& c1Mo_predicted) {
  std::vector<Pose> starts = candidates(cameras);
  if (c1Mo_predicted) {
    starts.push_back(*c1Mo_predicted);
  }
  struct Scored {
    Pose c1Mo;
    double rms;
  };
  std::vector<Scored> scored;
  for (const Pose& start : starts) {
    const Pose refined = refineOnCorners(cameras, start);
    if (facesCameras(cameras, refined)) {
      scored.push_back({refined, cornerRms(cameras, refined)});
    }
  }
  if (scored.empty()) {
    return std::nullopt;
  }
  const double least = std::min_element(scored.begin(), scored.end(), [](auto& a, auto& b) {
                         return a.rms < b.rms;
                       })->rms;
  // Residuals closer than this say nothing about which of two poses is true.
  const double undecided = 1.2 * least + 0.02;
  const auto rank = [&](const Scored& s) {
    if (!c1Mo_predicted) {
      return s.rms;
    }
    const bool open = s.rms <= undecided;
    return open ? thetaU(c1Mo_predicted->linear().transpose() * s.c1Mo.linear()).norm() : kFar;
  };
  return std::min_element(scored.begin(), scored.end(),
                          [&](auto& a, auto& b) { return rank(a) < rank(b); })
      ->c1Mo;
}

}  // namespace ringhook

#include "calib_check/verify_scene.h"

#include <random>

#include "calib/solve/plan.h"
#include "rig/camera_model.h"

namespace ringhook {
namespace {

Eigen::Vector2d seen(const CameraModel& camera, const Eigen::Vector3d& point_c, double sigma_px,
                     std::mt19937_64& engine) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const double du = sigma_px * noise(engine);
  const double dv = sigma_px * noise(engine);
  return projectNormalised(camera, point_c.hnormalized()) + Eigen::Vector2d(du, dv);
}

}  // namespace

StereoRig acceptedRig() {
  StereoRig rig = plannedRig({{2048, 2048, 2500.0}, 0.4, crossingVergence(0.4, 1.3)});
  rig.left.distortion = Eigen::Matrix<double, 5, 1>(-0.12, 0.03, 0.0004, -0.0003, 0.0);
  rig.right->distortion = Eigen::Matrix<double, 5, 1>(-0.11, 0.02, -0.0002, 0.0005, 0.0);
  rig.rms_px = 0.07;
  rig.heldout_vertical_disparity_px = 0.07;
  rig.views = 25;
  return rig;
}

StereoRig movedRig(const Eigen::Vector3d& rotation_rad, const Eigen::Vector3d& translation_m) {
  StereoRig rig = acceptedRig();
  const Pose c2Mnew = makePoseThetaU(translation_m, rotation_rad);
  rig.c2Mc1 = c2Mnew.inverse() * rig.c2Mc1;
  return rig;
}

std::vector<Eigen::Vector3d> boardPoints() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 54; ++i) {
    points.emplace_back(0.03 * (i % 9), 0.03 * (i / 9), 0.0);
  }
  return points;
}

std::vector<SightedView> viewsBy(const StereoRig& rig, int count, double sigma_px,
                                 std::uint64_t seed, double reach_m) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const PlanView middle(acceptedRig());
  std::vector<SightedView> views;
  for (int i = 0; i < count; ++i) {
    const double x = reach_m * any(engine), y = reach_m * any(engine), z = 1.3 + 0.2 * any(engine);
    const double a = 0.5 * any(engine), b = 0.5 * any(engine), c = 0.4 * any(engine);
    const Pose c1Mt = middle.c1Mm * makePoseThetaU({x - 0.12, y - 0.075, z}, {a, b, c});
    SightedView view{"view" + std::to_string(i), {}, {}, {}};
    for (const Eigen::Vector3d& p : boardPoints()) {
      const Eigen::Vector3d p1 = c1Mt * p;
      view.points_t.push_back(p);
      view.left_px.push_back(seen(rig.left, p1, sigma_px, engine));
      view.right_px.push_back(seen(*rig.right, rig.c2Mc1 * p1, sigma_px, engine));
    }
    views.push_back(view);
  }
  return views;
}

}  // namespace ringhook

#include "sim/nominal_rig.h"

#include <random>

namespace ringhook {
namespace {

/// Camera at `eye` looking at `target`, no roll: x horizontal, y down.
Pose lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose fMc = Pose::Identity();
  fMc.linear() << x, z.cross(x), z;
  fMc.translation() = eye;
  return fMc;
}

CameraModel camera(double focal_px, double cx, double cy, const Eigen::Vector4d& distortion) {
  CameraModel model;
  model.width = 2048;
  model.height = 2048;
  model.K << focal_px, 0.0, cx, 0.0, focal_px, cy, 0.0, 0.0, 1.0;
  model.distortion = distortion;
  return model;
}

/// Roughly normal, the same with every standard library: sum of twelve uniform values.
class Disturbance {
 public:
  explicit Disturbance(std::uint64_t seed) : bits_(seed) {}
  Eigen::Vector3d vector(double sigma) {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) {
      double sum = -6.0;
      for (int k = 0; k < 12; ++k) {
        sum += static_cast<double>(bits_() >> 11U) * 0x1p-53;
      }
      v[i] = sigma * sum;
    }
    return v;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace

StereoRig nominalRig() {
  const Eigen::Vector3d target(0.42, 0.0, 0.70);
  const Pose fMc1 = lookAt({1.75, -0.20, 0.70}, target);
  const Pose fMc2 = lookAt({1.75, 0.20, 0.70}, target);
  StereoRig rig;
  rig.left = camera(2500.0, 1027.3, 1019.8, {-0.120, 0.110, 0.00030, -0.00020});
  rig.right = camera(2504.0, 1018.6, 1026.1, {-0.118, 0.105, -0.00020, 0.00025});
  rig.c2Mc1 = fMc2.inverse() * fMc1;
  rig.fMc1 = fMc1;
  rig.camera_delay_s = 0.008;
  return rig;
}

StereoRig disturbedRig(const StereoRig& nominal, std::uint64_t seed, const RigErrors& errors) {
  Disturbance draw(seed);
  StereoRig rig = nominal;
  const Eigen::Vector3d shift = draw.vector(errors.between_m);
  const Eigen::Vector3d turn = draw.vector(errors.between_rad);
  rig.c2Mc1 = nominal.c2Mc1 * makePoseThetaU(shift, turn);
  if (nominal.fMc1) {
    const Eigen::Vector3d robot_shift = draw.vector(errors.to_robot_m);
    rig.fMc1 = *nominal.fMc1 * makePoseThetaU(robot_shift, draw.vector(errors.to_robot_rad));
  }
  return rig;
}

}  // namespace ringhook

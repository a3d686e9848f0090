#include "rig/stereo_rig.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kRotationTolerance = 1e-4;  // a matrix typed with five digits passes
constexpr double kLargestZero = 5.0 / 180.0 * std::numbers::pi;  // [rad]; more is another arm
constexpr int kLargestSide = 16384;  // [px]; fixed-point maps hold coordinates in 16 bits

[[noreturn]] void refuse(const std::string& where, const std::string& key,
                         const std::string& expected) {
  throw InputError(where + ": " + key + " must be " + expected);
}

void checkCamera(const CameraModel& camera, const std::string& where, const std::string& side) {
  if (camera.width <= 0 || camera.width > kLargestSide) {
    refuse(where, "image_width", "a number of pixels from 1 to 16384");
  }
  if (camera.height <= 0 || camera.height > kLargestSide) {
    refuse(where, "image_height", "a number of pixels from 1 to 16384");
  }
  const Eigen::Matrix3d& K = camera.K;
  if (!K.allFinite() || !(K(0, 0) > 0.0) || !(K(1, 1) > 0.0)) {
    refuse(where, "K" + side, "finite with positive focal lengths");
  }
  if (K(0, 1) != 0.0 || K(1, 0) != 0.0 || K.row(2) != Eigen::RowVector3d(0.0, 0.0, 1.0)) {
    refuse(where, "K" + side, "of the form fx 0 cx; 0 fy cy; 0 0 1");
  }
  const Eigen::Index n = camera.distortion.size();
  if (n != 0 && n != 4 && n != 5 && n != 8) {
    refuse(where, "D" + side, "0, 4, 5 or 8 coefficients, not " + std::to_string(n));
  }
  if (!camera.distortion.allFinite()) {
    refuse(where, "D" + side, "finite");
  }
}

void checkRotation(const Eigen::Matrix3d& R, const std::string& where, const std::string& key) {
  const bool rigid =
      R.allFinite() &&
      (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < kRotationTolerance &&
      R.determinant() > 0.0;
  if (!rigid) {
    refuse(where, key, "a rotation (orthonormal to 1e-4, determinant +1)");
  }
}

void checkPair(const StereoRig& rig, const std::string& where) {
  checkCamera(*rig.right, where, "2");
  if (rig.right->width != rig.left.width || rig.right->height != rig.left.height) {
    refuse(where, "the right image", "as large as the left one");
  }
  checkRotation(rig.c2Mc1.linear(), where, "R");
  const Eigen::Vector3d T = rig.c2Mc1.translation();
  if (!T.allFinite() || !(T.norm() > 0.0)) {
    refuse(where, "T", "finite and not zero [m]");
  }
}

}  // namespace

double baseline(const StereoRig& rig) { return rig.right ? rig.c2Mc1.translation().norm() : 0.0; }

void checkRig(const StereoRig& rig, const std::string& where) {
  checkCamera(rig.left, where, "1");
  if (rig.right) {
    checkPair(rig, where);
  }
  if (rig.fMc1) {
    checkRotation(rig.fMc1->linear(), where, "the rotation in fMc1");
    if (!rig.fMc1->translation().allFinite()) {
      refuse(where, "the translation in fMc1", "finite [m]");
    }
  }
  if (!rig.joint_zeros_rad.allFinite() ||
      rig.joint_zeros_rad.cwiseAbs().maxCoeff() >= kLargestZero) {
    refuse(where, "joint_zeros_deg", "six angles below 5 degrees");
  }
  const auto checkFinite = [&](double value, const char* key) {
    if (!std::isfinite(value)) {
      refuse(where, key, "finite");
    }
  };
  checkFinite(rig.robot_delay_s, "robot_delay_ms");
  checkFinite(rig.camera_delay_s, "camera_delay_ms");
  checkFinite(rig.rms_px.value_or(0.0), "rms_px");
  checkFinite(rig.heldout_vertical_disparity_px.value_or(0.0), "heldout_vertical_disparity_px");
}

}  // namespace ringhook

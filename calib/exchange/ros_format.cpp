// left.yaml and right.yaml: ROS's sensor_msgs/CameraInfo as camera_calibration_parsers writes it.

#include "calib/exchange/formats.h"
#include "core/error.h"
#include "core/yaml_fields.h"

namespace ringhook::exchange {
namespace {

constexpr int kLargestSide = 16384;  // [px]

struct CameraInfo {
  CameraModel camera;
  Eigen::Matrix3d R;
  Eigen::Matrix<double, 3, 4> P;
};

Eigen::MatrixXd matrix(YamlFields& fields, const std::string& key, int rows, int cols) {
  YamlFields section = fields.section(key);
  section.integer("rows", rows, rows);
  section.integer("cols", cols, cols);
  const Eigen::VectorXd data = section.vector("data", rows * cols);
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      data.data(), rows, cols);
}

Eigen::VectorXd lens(YamlFields& fields) {
  const bool rational =
      fields.choice("distortion_model", {"plumb_bob", "rational_polynomial"}) == 1;
  YamlFields section = fields.section("distortion_coefficients");
  std::vector<double> told;
  section.update("data", told, 14, -YamlFields::kAny, YamlFields::kAny);
  const std::size_t expected = rational ? 8 : 5;
  const bool shorter = !rational && (told.empty() || told.size() == 4);
  if (told.size() != expected && !shorter) {
    section.refuse("data", std::to_string(expected) + " coefficients of this distortion_model");
  }
  return Eigen::Map<const Eigen::VectorXd>(told.data(), static_cast<Eigen::Index>(told.size()));
}

CameraInfo readInfo(const std::filesystem::path& file) {
  YamlFields fields = YamlFields::open(file);
  CameraInfo info;
  info.camera.width = fields.integer("image_width", 1, kLargestSide);
  info.camera.height = fields.integer("image_height", 1, kLargestSide);
  info.camera.K = matrix(fields, "camera_matrix", 3, 3);
  info.camera.distortion = lens(fields);
  info.R = matrix(fields, "rectification_matrix", 3, 3);
  info.P = matrix(fields, "projection_matrix", 3, 4);
  return info;
}

/// The right camera relative to the left one, from what rectification did to both.
Pose poseBetween(const CameraInfo& left, const CameraInfo& right, double unit_m,
                 const std::filesystem::path& right_file) {
  if (!(right.P(0, 0) > 0.0) || !(right.P(1, 1) > 0.0) ||
      (right.P(0, 3) == 0.0 && right.P(1, 3) == 0.0)) {
    throw InputError(right_file.string() +
                     ": field projection_matrix: expected the baseline in its last column, as the "
                     "right camera of a stereo pair has it");
  }
  const Eigen::Vector3d along(right.P(0, 3) / right.P(0, 0), right.P(1, 3) / right.P(1, 1), 0.0);
  Pose c2Mc1 = Pose::Identity();
  c2Mc1.linear() = right.R.transpose() * left.R;
  c2Mc1.translation() = right.R.transpose() * along * unit_m;
  return c2Mc1;
}

std::string matrixText(const std::string& key, const Eigen::MatrixXd& m) {
  return key + ":\n  rows: " + std::to_string(m.rows()) + "\n  cols: " + std::to_string(m.cols()) +
         "\n  data: [" + listOf(m) + "]\n";
}

std::string infoText(const CameraModel& camera, const std::string& name, const Eigen::Matrix3d& R,
                     const Eigen::MatrixXd& P) {
  const bool rational = camera.distortion.size() > 5;
  Eigen::VectorXd terms = Eigen::VectorXd::Zero(rational ? 8 : 5);
  terms.head(camera.distortion.size()) = camera.distortion;
  return "image_width: " + std::to_string(camera.width) +
         "\nimage_height: " + std::to_string(camera.height) + "\ncamera_name: " + name + "\n" +
         matrixText("camera_matrix", camera.K) +
         "distortion_model: " + (rational ? "rational_polynomial" : "plumb_bob") + "\n" +
         matrixText("distortion_coefficients", terms.transpose()) +
         matrixText("rectification_matrix", R) + matrixText("projection_matrix", P);
}

}  // namespace

StereoRig readRos(const Files& files, const ImportHints& hints) {
  const CameraInfo left = readInfo(files[0]);
  StereoRig rig;
  rig.left = left.camera;
  if (files.size() > 1) {
    const CameraInfo right = readInfo(files[1]);
    rig.right = right.camera;
    rig.c2Mc1 = poseBetween(left, right, unitOf(hints), files[1]);
  }
  return rig;
}

RigExport writeRos(const StereoRig& rig) {
  RigExport written;
  if (!rig.right) {
    Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();
    P.leftCols<3>() = rig.left.K;
    written.files = {{"left.yaml", infoText(rig.left, "left", Eigen::Matrix3d::Identity(), P)}};
    return written;
  }
  const Rectification r = rectification(rig);
  written.files = {{"left.yaml", infoText(rig.left, "left", r.R1, r.P1)},
                   {"right.yaml", infoText(*rig.right, "right", r.R2, r.P2)}};
  return written;
}

}  // namespace ringhook::exchange

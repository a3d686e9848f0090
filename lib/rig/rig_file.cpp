#include <Eigen/SVD>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/angle.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "rig/opencv_keys.h"
#include "rig/opencv_text.h"
#include "rig/stereo_rig.h"
#include "rig/unknown_entries.h"

namespace ringhook {
namespace fs = std::filesystem;

namespace {

/// The rotation closest to a matrix already checked to be nearly one (polar decomposition).
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

CameraModel readCamera(const OpenCvKeys& keys, const std::string& side) {
  CameraModel camera;
  camera.width = keys.integer("image_width");
  camera.height = keys.integer("image_height");
  camera.K = keys.matrix("K" + side, 3, 3);
  camera.distortion = keys.vector("D" + side, 14);
  return camera;
}

void readPair(const OpenCvKeys& keys, StereoRig& rig) {
  rig.right = readCamera(keys, "2");
  rig.c2Mc1.linear() = keys.matrix("R", 3, 3);
  const Eigen::VectorXd T = keys.vector("T", 3);
  if (T.size() != 3) {
    keys.fail("T", "a 3x1 matrix, not " + std::to_string(T.size()) + "x1");
  }
  rig.c2Mc1.translation() = T;
}

void readEvidence(const OpenCvKeys& keys, StereoRig& rig) {
  rig.rms_px = keys.number("rms_px");
  rig.heldout_vertical_disparity_px = keys.number("heldout_vertical_disparity_px");
  rig.board = keys.text("board");
  rig.date = keys.text("date");
  rig.tool_version = keys.text("tool_version");
  if (keys.has("views")) {
    rig.views = keys.integer("views");
  }
}

Eigen::VectorXd readJointZeros(const OpenCvKeys& keys) {
  const Eigen::VectorXd degrees = keys.vector("joint_zeros_deg", 6);
  if (degrees.size() != 6) {
    keys.fail("joint_zeros_deg", "a 6x1 matrix, not " + std::to_string(degrees.size()) + "x1");
  }
  return degrees * kDegree;
}

StereoRig readRig(const OpenCvKeys& keys) {
  StereoRig rig;
  rig.left = readCamera(keys, "1");
  if (keys.has("K2") || keys.has("D2") || keys.has("R") || keys.has("T")) {
    readPair(keys, rig);
  }
  if (keys.has("fMc1")) {
    const Eigen::MatrixXd m = keys.matrix("fMc1", 4, 4);
    if (m.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
      keys.fail("fMc1", "a 4x4 matrix with last row 0 0 0 1");
    }
    rig.fMc1 = Pose(Eigen::Matrix4d(m));
  }
  if (keys.has("joint_zeros_deg")) {
    rig.joint_zeros_rad = readJointZeros(keys);
  }
  rig.robot_delay_s = keys.number("robot_delay_ms").value_or(0.0) * 1e-3;
  rig.camera_delay_s = keys.number("camera_delay_ms").value_or(0.0) * 1e-3;
  readEvidence(keys, rig);
  return rig;
}

cv::Mat toCv(const Eigen::MatrixXd& m) {
  cv::Mat out(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
  for (int r = 0; r < out.rows; ++r) {
    for (int c = 0; c < out.cols; ++c) {
      out.at<double>(r, c) = m(r, c);
    }
  }
  return out;
}

template <class T>
void writeIfKnown(cv::FileStorage& file, const char* key, const std::optional<T>& value) {
  if (value) {
    cv::write(file, key, *value);
  }
}

void writeKnown(cv::FileStorage& file, const StereoRig& rig) {
  cv::write(file, "image_width", rig.left.width);
  cv::write(file, "image_height", rig.left.height);
  cv::write(file, "K1", toCv(rig.left.K));
  cv::write(file, "D1", toCv(rig.left.distortion.transpose()));
  if (rig.right) {
    cv::write(file, "K2", toCv(rig.right->K));
    cv::write(file, "D2", toCv(rig.right->distortion.transpose()));
    cv::write(file, "R", toCv(rig.c2Mc1.linear()));
    cv::write(file, "T", toCv(rig.c2Mc1.translation()));
  }
  if (rig.fMc1) {
    cv::write(file, "fMc1", toCv(rig.fMc1->matrix()));
  }
  if (!rig.joint_zeros_rad.isZero(0.0)) {
    cv::write(file, "joint_zeros_deg", toCv(rig.joint_zeros_rad / kDegree));
  }
  cv::write(file, "robot_delay_ms", rig.robot_delay_s * 1e3);
  cv::write(file, "camera_delay_ms", rig.camera_delay_s * 1e3);
  writeIfKnown(file, "rms_px", rig.rms_px);
  writeIfKnown(file, "heldout_vertical_disparity_px", rig.heldout_vertical_disparity_px);
  writeIfKnown(file, "board", rig.board);
  writeIfKnown(file, "views", rig.views);
  writeIfKnown(file, "date", rig.date);
  writeIfKnown(file, "tool_version", rig.tool_version);
}

}  // namespace

StereoRig loadRig(const fs::path& path) {
  const std::string text = readOpenCvText(path, OpenCvSyntax::kYaml);
  try {
    const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!file.isOpened() || !file.root().isMap()) {
      throw InputError(path.string() + ": is not an OpenCV YAML file with keys at the top");
    }
    StereoRig rig = readRig(OpenCvKeys(file.root(), path.string()));
    checkRig(rig, path.string());
    rig.c2Mc1.linear() = nearestRotation(rig.c2Mc1.linear());
    if (rig.fMc1) {
      rig.fMc1->linear() = nearestRotation(rig.fMc1->linear());
    }
    rig.unknown_entries = unknownEntries(text);
    return rig;
  } catch (const cv::Exception& e) {
    throw InputError(path.string() + ": is not a YAML file that OpenCV can read (" + e.err + ")");
  } catch (const std::length_error&) {  // what OpenCV 4.6 makes of an entry without a key
    throw InputError(path.string() + ": is not a YAML file that OpenCV can read (a key is empty)");
  }
}

void saveRig(const fs::path& path, const StereoRig& rig) {
  checkRig(rig, path.string());
  std::string text;
  try {
    cv::FileStorage file("rig.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    writeKnown(file, rig);
    text = file.releaseAndGetString();
  } catch (const cv::Exception& e) {
    throw InputError(path.string() + ": cannot hold this rig (" + e.err + ")");
  }
  for (const UnknownEntry& entry : rig.unknown_entries) {
    text += entry.text;
    if (!entry.text.ends_with('\n')) {
      text += '\n';
    }
  }
  writeFileAtomically(path, text);
}

}  // namespace ringhook

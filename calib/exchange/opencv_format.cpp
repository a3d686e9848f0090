// intrinsics.yml and extrinsics.yml of OpenCV's sample stereo_calib, or one file with all keys.

#include <opencv2/core.hpp>
#include <stdexcept>

#include "calib/exchange/formats.h"
#include "core/error.h"
#include "rig/opencv_keys.h"
#include "rig/opencv_text.h"

namespace ringhook::exchange {
namespace {

namespace fs = std::filesystem;

/// Coefficients; OpenCV's twelve and fourteen only if the ones that we do not have are zero.
Eigen::VectorXd coefficients(const OpenCvKeys& keys, const std::string& key) {
  const Eigen::VectorXd told = keys.vector(key, 14);
  if (told.size() <= 8) {
    return told;
  }
  if (!told.tail(told.size() - 8).isZero(0.0)) {
    keys.fail(key, "of 4, 5 or 8 coefficients: thin prism and tilt terms are not known here");
  }
  return told.head(8);
}

void readCamera(const OpenCvKeys& keys, const std::string& side, CameraModel& camera) {
  camera.K = keys.matrix("M" + side, 3, 3);
  camera.distortion = coefficients(keys, "D" + side);
}

void readSize(const OpenCvKeys& keys, const std::string& file, const ImportHints& hints,
              CameraModel& camera) {
  camera.width = hints.width;
  camera.height = hints.height;
  if (keys.has("image_width") && keys.has("image_height")) {
    camera.width = keys.integer("image_width");
    camera.height = keys.integer("image_height");
  }
  if (camera.width <= 0 || camera.height <= 0) {
    throw InputError(file +
                     ": tells no image size (image_width, image_height), expected --size WxH");
  }
}

void readPose(const OpenCvKeys& keys, const ImportHints& hints, StereoRig& rig) {
  rig.c2Mc1.linear() = keys.matrix("R", 3, 3);
  const Eigen::VectorXd T = keys.vector("T", 3);
  if (T.size() != 3) {
    keys.fail("T", "a 3x1 matrix");
  }
  rig.c2Mc1.translation() = unitOf(hints) * T;
}

template <class Read>
void withKeys(const fs::path& path, Read read) {
  const std::string text = readOpenCvText(path, OpenCvSyntax::kYamlOrXml);
  try {
    const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!file.isOpened() || !file.root().isMap()) {
      throw InputError(path.string() + ": is not an OpenCV file with keys at the top");
    }
    read(OpenCvKeys(file.root(), path.string()));
  } catch (const cv::Exception& e) {
    throw InputError(path.string() + ": is not a file that OpenCV can read (" + e.err + ")");
  } catch (const std::length_error&) {  // what OpenCV 4.6 makes of an entry without a key
    throw InputError(path.string() + ": is not a file that OpenCV can read (a key is empty)");
  }
}

std::string matrixText(const std::string& key, const Eigen::MatrixXd& m) {
  return key + ": !!opencv-matrix\n   rows: " + std::to_string(m.rows()) +
         "\n   cols: " + std::to_string(m.cols()) + "\n   dt: d\n   data: [ " + listOf(m) + " ]\n";
}

}  // namespace

StereoRig readOpenCv(const Files& files, const ImportHints& hints) {
  StereoRig rig;
  withKeys(files.front(), [&](const OpenCvKeys& keys) {
    readCamera(keys, "1", rig.left);
    readSize(keys, files.front().string(), hints, rig.left);
    if (keys.has("M2") || keys.has("D2") || files.size() > 1) {
      rig.right = rig.left;
      readCamera(keys, "2", *rig.right);
    }
    if (rig.right && files.size() == 1) {
      readPose(keys, hints, rig);
    }
  });
  if (files.size() > 1) {
    withKeys(files[1], [&](const OpenCvKeys& keys) { readPose(keys, hints, rig); });
  }
  return rig;
}

RigExport writeOpenCv(const StereoRig& rig) {
  const std::string head = "%YAML:1.0\n---\n";
  std::string intrinsics = head + "image_width: " + std::to_string(rig.left.width) +
                           "\nimage_height: " + std::to_string(rig.left.height) + "\n" +
                           matrixText("M1", rig.left.K) +
                           matrixText("D1", rig.left.distortion.transpose());
  RigExport written;
  if (!rig.right) {
    written.files = {{"intrinsics.yml", intrinsics}};
    return written;
  }
  intrinsics +=
      matrixText("M2", rig.right->K) + matrixText("D2", rig.right->distortion.transpose());
  const Rectification r = rectification(rig);
  written.files = {{"intrinsics.yml", intrinsics},
                   {"extrinsics.yml", head + matrixText("R", rig.c2Mc1.linear()) +
                                          matrixText("T", rig.c2Mc1.translation()) +
                                          matrixText("R1", r.R1) + matrixText("R2", r.R2) +
                                          matrixText("P1", r.P1) + matrixText("P2", r.P2)}};
  return written;
}

}  // namespace ringhook::exchange

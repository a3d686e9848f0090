#pragma once

/// \file
/// Rigs to and from other programs' files. All keep OpenCV's lens terms and x2 = R x1 + T, and
/// pixel coordinates with the first pixel's centre at (0, 0), so that only the spelling differs:
/// - opencv: intrinsics.yml (M1 D1 M2 D2) and extrinsics.yml (R T R1 R2 P1 P2), the files of its
///   sample stereo_calib, YAML or XML; the sample tells no image size;
/// - visp: left.xml, right.xml (vpXmlParserCamera) and c2Mc1.txt, a 4x4 matrix; its lens has k1
///   alone, called kud, and a polynomial kdu for the way back;
/// - ros: left.yaml, right.yaml (sensor_msgs/CameraInfo as camera_calibration_parsers writes it),
///   the pose between the cameras in rectification and projection matrices:
///   R = R2^T R1, T = R2^T (P2[0,3] / P2[0,0], P2[1,3] / P2[1,1], 0);
/// - kalibr: camchain.yaml, cam0 left and cam1 right, T_cn_cnm1 = c2Mc1, lens radtan (k1 k2 p1 p2).
/// What a format cannot hold is measured in pixels and told, never dropped in silence.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rig/stereo_rig.h"

namespace ringhook {

enum class RigFormat { kOpenCv, kVisp, kRos, kKalibr };

/// From "opencv", "visp", "ros" or "kalibr". Throws InputError naming --format.
RigFormat rigFormat(const std::string& name);

/// What the files leave open.
struct ImportHints {
  int width = 0;                 ///< of the images, 0: as the files say [px]
  int height = 0;                ///< likewise [px]
  std::optional<double> unit_m;  ///< of lengths in the files [m]; absent: metres, and doubted
};

/// Reads the files in the order of the list above; the right camera may be left out. Throws
/// InputError in one sentence that names file and key and says what was expected: also for lens
/// models that cannot be told in rig.yaml, and for a baseline above 10 m without a stated unit.
StereoRig importRig(RigFormat format, const std::vector<std::filesystem::path>& files,
                    const ImportHints& hints);

struct ExportedFile {
  std::string name;
  std::string text;
};

struct RigExport {
  std::vector<ExportedFile> files;
  double loss_px = 0.0;            ///< largest difference of both lenses; 0: told exactly
  std::vector<std::string> notes;  ///< sentences on what is lost or only approximate
};

/// Throws InputError if the rig cannot be told in that format at all.
RigExport exportRig(RigFormat format, const StereoRig& rig);

/// Rectification as ROS and OpenCV tell it: x_rectified = R1 x1 and R2 x2, and one pinhole camera
/// [px] for both, of the images' size, whose middle shows the middle of both views.
struct Rectification {
  Eigen::Matrix3d R1;
  Eigen::Matrix3d R2;
  Eigen::Matrix<double, 3, 4> P1;  ///< [px], last column [px m]
  Eigen::Matrix<double, 3, 4> P2;  ///< [px], last column [px m]
};
Rectification rectification(const StereoRig& rig);

}  // namespace ringhook

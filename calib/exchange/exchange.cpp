#include "calib/exchange/exchange.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cstdio>

#include "calib/exchange/formats.h"
#include "core/error.h"
#include "core/number_text.h"
#include "rig/rectifier.h"

namespace ringhook {
namespace {

constexpr double kLongestBaseline_m = 10.0;

/// Matrices that were printed with few digits are rotations to that precision only.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void doubtLength(const StereoRig& rig, const std::filesystem::path& file,
                 const ImportHints& hints) {
  if (hints.unit_m || baseline(rig) <= kLongestBaseline_m) {
    return;
  }
  char text[200];
  std::snprintf(text, sizeof(text),
                ": a baseline of %.4g m is hard to believe; if the file is in millimetres say "
                "--unit mm, if it is in metres --unit m",
                baseline(rig));
  throw InputError(file.string() + text);
}

/// Mean direction of the image's border in the rectified frame.
Eigen::Vector2d middleOf(const CameraModel& camera, const Eigen::Matrix3d& R) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = (camera.width - 1.0) * i / kSteps;
    const double y = (camera.height - 1.0) * i / kSteps;
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(x, 0.0), Eigen::Vector2d(x, camera.height - 1.0), Eigen::Vector2d(0.0, y),
          Eigen::Vector2d(camera.width - 1.0, y)}) {
      const Outcome<Eigen::Vector2d> ray = undistortPixel(camera, p);
      if (ray) {
        sum += (R * ray->homogeneous()).hnormalized();
        ++count;
      }
    }
  }
  return count > 0 ? Eigen::Vector2d(sum / count) : Eigen::Vector2d::Zero();
}

}  // namespace

RigFormat rigFormat(const std::string& name) {
  if (name == "opencv") {
    return RigFormat::kOpenCv;
  }
  if (name == "visp") {
    return RigFormat::kVisp;
  }
  if (name == "ros") {
    return RigFormat::kRos;
  }
  if (name == "kalibr") {
    return RigFormat::kKalibr;
  }
  throw InputError("--format: expected opencv, visp, ros or kalibr, got '" + name + "'");
}

StereoRig importRig(RigFormat format, const std::vector<std::filesystem::path>& files,
                    const ImportHints& hints) {
  StereoRig rig;
  switch (format) {
    case RigFormat::kOpenCv:
      rig = exchange::readOpenCv(files, hints);
      break;
    case RigFormat::kVisp:
      rig = exchange::readVisp(files, hints);
      break;
    case RigFormat::kRos:
      rig = exchange::readRos(files, hints);
      break;
    case RigFormat::kKalibr:
      rig = exchange::readKalibr(files, hints);
      break;
  }
  checkRig(rig, files.back().string());
  rig.c2Mc1.linear() = nearestRotation(rig.c2Mc1.linear());
  doubtLength(rig, files.back(), hints);
  return rig;
}

RigExport exportRig(RigFormat format, const StereoRig& rig) {
  RigExport written;
  switch (format) {
    case RigFormat::kOpenCv:
      written = exchange::writeOpenCv(rig);
      break;
    case RigFormat::kVisp:
      written = exchange::writeVisp(rig);
      break;
    case RigFormat::kRos:
      written = exchange::writeRos(rig);
      break;
    case RigFormat::kKalibr:
      written = exchange::writeKalibr(rig);
      break;
  }
  if (rig.fMc1) {
    written.notes.emplace_back("the cameras' pose in the robot frame (fMc1) stays behind");
  }
  if (rig.robot_delay_s != 0.0 || rig.camera_delay_s != 0.0) {
    written.notes.emplace_back("the delays of arm and cameras stay behind");
  }
  return written;
}

Rectification rectification(const StereoRig& rig) {
  const Rectifier rectifier(rig);
  Rectification r;
  r.R1 = rectifier.view(0).cMc1.linear();
  r.R2 = rectifier.view(1).cMc1.linear() * rig.c2Mc1.linear().transpose();
  const double f = rectifier.view(0).fx;
  const Eigen::Vector2d middle = 0.5 * (middleOf(rig.left, r.R1) + middleOf(*rig.right, r.R2));
  const Eigen::Vector2d c =
      0.5 * Eigen::Vector2d(rig.left.width - 1.0, rig.left.height - 1.0) - f * middle;
  r.P1 << f, 0.0, c.x(), 0.0, 0.0, f, c.y(), 0.0, 0.0, 0.0, 1.0, 0.0;
  r.P2 = r.P1;
  r.P2(0, 3) = f * rectifier.view(1).cMc1.translation().x();
  return r;
}

std::array<CameraModel, 2> exchange::tellLenses(const StereoRig& rig, LensKind kind,
                                                const std::string& format, RigExport& written) {
  std::array<CameraModel, 2> lenses;
  const std::array<const CameraModel*, 2> given{&rig.left, rig.right ? &*rig.right : &rig.left};
  const std::array<const char*, 2> names{"left", "right"};
  for (std::size_t i = 0; i < (rig.right ? 2U : 1U); ++i) {
    const FittedLens lens = closestLens(*given[i], kind);
    lenses[i] = lens.camera;
    written.loss_px = std::max(written.loss_px, lens.loss_px);
    if (lens.loss_px > 0.0) {
      char text[200];
      std::snprintf(text, sizeof(text),
                    "%s has fewer lens terms: the closest %s lens differs by up to %.2g px",
                    format.c_str(), names[i], lens.loss_px);
      written.notes.emplace_back(text);
    }
  }
  return lenses;
}

std::string exchange::listOf(const Eigen::MatrixXd& values) {
  std::string text;
  for (Eigen::Index r = 0; r < values.rows(); ++r) {
    for (Eigen::Index c = 0; c < values.cols(); ++c) {
      // YAML readers take 1e-05 for text, 1.0e-05 for a number.
      std::string number = exactText(values(r, c));
      const std::size_t e = number.find('e');
      if (e != std::string::npos && number.find('.') == std::string::npos) {
        number.insert(e, ".0");
      }
      if (number.find('.') == std::string::npos && number.find('e') == std::string::npos) {
        number += ".0";
      }
      text += (text.empty() ? "" : ", ") + number;
    }
  }
  return text;
}

}  // namespace ringhook

// Kalibr's camchain.yaml: cam0 is left, cam1 right, T_cn_cnm1 takes points of cam0 to cam1.

#include <yaml-cpp/yaml.h>

#include "calib/exchange/formats.h"
#include "calib/exchange/lens_fit.h"
#include "core/error.h"
#include "core/yaml_fields.h"

namespace ringhook::exchange {
namespace {

constexpr double kLargestSide = 16384.0;  // [px]

CameraModel readCamera(YamlFields& cam) {
  cam.choice("camera_model", {"pinhole"});
  CameraModel camera;
  const Eigen::VectorXd k = cam.vector("intrinsics", 4);
  camera.K << k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0;
  if (cam.choice("distortion_model", {"radtan", "none"}) == 0) {
    camera.distortion = cam.vector("distortion_coeffs", 4);
  }
  const Eigen::VectorXd size = cam.vector("resolution", 2);
  if (!size.allFinite() || size.minCoeff() < 1.0 || size.maxCoeff() > kLargestSide) {
    cam.refuse("resolution", "width and height in pixels");
  }
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  return camera;
}

/// Four rows of four numbers in a list of lists; nothing if it is anything else.
std::optional<Eigen::Matrix4d> rowsOf(const YAML::Node& rows) {
  if (!rows.IsSequence() || rows.size() != 4) {
    return std::nullopt;
  }
  Eigen::Matrix4d m;
  for (int r = 0; r < 4; ++r) {
    const YAML::Node row = rows[r];
    if (!row.IsSequence() || row.size() != 4) {
      return std::nullopt;
    }
    for (int c = 0; c < 4; ++c) {
      if (!row[c].IsScalar() || !YAML::convert<double>::decode(row[c], m(r, c))) {
        return std::nullopt;
      }
    }
  }
  return m;
}

Pose readPose(YamlFields& cam, const std::filesystem::path& file, double unit_m) {
  const std::string key = "T_cn_cnm1";
  std::optional<Eigen::Matrix4d> m;
  if (cam.has(key)) {
    try {
      const YAML::Node root = YAML::LoadFile(file.string());
      m = rowsOf(root["cam1"][key]);
    } catch (const YAML::Exception&) {
      m.reset();
    }
  } else {
    cam.refuseWhole("field " + key + ", the pose of cam0 in cam1");
  }
  if (!m || !m->allFinite() || m->row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    cam.refuse(key, "four rows of four numbers, the last one 0, 0, 0, 1");
  }
  Pose pose(*m);
  pose.translation() *= unit_m;
  return pose;
}

std::string cameraText(const CameraModel& lens, const std::string& name) {
  const Eigen::Vector4d intrinsics(lens.K(0, 0), lens.K(1, 1), lens.K(0, 2), lens.K(1, 2));
  return name + ":\n  camera_model: pinhole\n  intrinsics: [" + listOf(intrinsics) +
         "]\n  distortion_model: radtan\n  distortion_coeffs: [" + listOf(lens.distortion) +
         "]\n  resolution: [" + std::to_string(lens.width) + ", " + std::to_string(lens.height) +
         "]\n";
}

}  // namespace

StereoRig readKalibr(const Files& files, const ImportHints& hints) {
  YamlFields chain = YamlFields::open(files.front());
  StereoRig rig;
  YamlFields cam0 = chain.section("cam0");
  rig.left = readCamera(cam0);
  if (chain.has("cam1")) {
    YamlFields cam1 = chain.section("cam1");
    rig.right = readCamera(cam1);
    rig.c2Mc1 = readPose(cam1, files.front(), unitOf(hints));
  }
  return rig;
}

RigExport writeKalibr(const StereoRig& rig) {
  RigExport written;
  const auto lenses = tellLenses(rig, LensKind::kRadTan, "Kalibr", written);
  std::string text = cameraText(lenses[0], "cam0");
  if (rig.right) {
    text += cameraText(lenses[1], "cam1") + "  T_cn_cnm1:\n";
    for (int r = 0; r < 4; ++r) {
      text += "  - [" + listOf(rig.c2Mc1.matrix().row(r)) + "]\n";
    }
  }
  written.files = {{"camchain.yaml", text}};
  return written;
}

}  // namespace ringhook::exchange

// left.xml, right.xml (vpXmlParserCamera) and c2Mc1.txt, which vpHomogeneousMatrix loads.

#include <cstdio>
#include <fstream>

#include "calib/exchange/formats.h"
#include "calib/exchange/lens_fit.h"
#include "camera/visp_camera_xml.h"
#include "core/error.h"
#include "core/file_kind.h"
#include "core/number_text.h"

namespace ringhook::exchange {
namespace {

namespace fs = std::filesystem;

Pose readPose(const fs::path& path, double unit_m) {
  std::ifstream file(path);
  if (!isFile(path) || !file) {
    throw InputError(path.string() + ": no such file, expected the matrix c2Mc1");
  }
  Eigen::Matrix4d m;
  for (int i = 0; i < 16; ++i) {
    if (!(file >> m(i / 4, i % 4))) {
      throw InputError(path.string() + ": number " + std::to_string(i + 1) +
                       " is missing or none, expected a 4x4 matrix row by row");
    }
  }
  if (!m.allFinite() || m.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    throw InputError(path.string() + ": expected a 4x4 matrix with last row 0 0 0 1");
  }
  Pose pose(m);
  pose.translation() *= unit_m;
  return pose;
}

std::string element(const char* name, const std::string& value) {
  return std::string("      <") + name + ">" + value + "</" + name + ">\n";
}

std::string cameraText(const CameraModel& lens, const std::string& name, double kdu) {
  const bool distorted = lens.distortion[0] != 0.0;
  std::string text =
      "<?xml version=\"1.0\"?>\n<root>\n  <camera>\n    <name>" + name +
      "</name>\n    <image_width>" + std::to_string(lens.width) +
      "</image_width>\n    <image_height>" + std::to_string(lens.height) +
      "</image_height>\n    <model>\n" +
      element("type",
              distorted ? "perspectiveProjWithDistortion" : "perspectiveProjWithoutDistortion") +
      element("px", exactText(lens.K(0, 0))) + element("py", exactText(lens.K(1, 1))) +
      element("u0", exactText(lens.K(0, 2))) + element("v0", exactText(lens.K(1, 2)));
  if (distorted) {
    text += element("kud", exactText(lens.distortion[0])) + element("kdu", exactText(kdu));
  }
  return text + "    </model>\n  </camera>\n</root>\n";
}

void addCamera(const CameraModel& lens, const std::string& name, RigExport& written) {
  const InverseRadial back = inverseRadial(lens);
  written.files.push_back({name + ".xml", cameraText(lens, name, back.kdu)});
  if (back.loss_px > 0.0) {
    char text[200];
    std::snprintf(text, sizeof(text),
                  "ViSP's way from pixel to ray (kdu) is a polynomial of its own: wrong by up to "
                  "%.2g px in the %s image",
                  back.loss_px, name.c_str());
    written.notes.emplace_back(text);
  }
}

std::string matrixText(const Pose& pose) {
  std::string text;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      text += exactText(pose.matrix()(r, c)) + (c < 3 ? " " : "\n");
    }
  }
  return text;
}

}  // namespace

StereoRig readVisp(const Files& files, const ImportHints& hints) {
  const ImageSize size{hints.width, hints.height};
  StereoRig rig = loadVispCamera(files.front(), "", size);
  if (files.size() == 2) {
    throw InputError(files[1].string() +
                     ": a right camera needs its pose, expected left.xml right.xml c2Mc1.txt");
  }
  if (files.size() > 2) {
    rig.right = loadVispCamera(files[1], "", size).left;
    rig.c2Mc1 = readPose(files[2], unitOf(hints));
  }
  return rig;
}

RigExport writeVisp(const StereoRig& rig) {
  RigExport written;
  const auto lenses = tellLenses(rig, LensKind::kRadialOne, "ViSP", written);
  addCamera(lenses[0], "left", written);
  if (rig.right) {
    addCamera(lenses[1], "right", written);
    written.files.push_back({"c2Mc1.txt", matrixText(rig.c2Mc1)});
  }
  return written;
}

}  // namespace ringhook::exchange

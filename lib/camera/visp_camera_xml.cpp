#include "camera/visp_camera_xml.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <cmath>

#include "core/error.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// Reads one projection model; false if the file has none of that kind for that camera.
bool parse(vpXmlParserCamera& parser, vpCameraParameters& camera, const fs::path& file,
           const std::string& name, vpCameraParameters::vpCameraParametersProjType kind,
           ImageSize size) {
  return parser.parse(camera, file.string(), name, kind, static_cast<unsigned>(size.width),
                      static_cast<unsigned>(size.height)) == vpXmlParserCamera::SEQUENCE_OK;
}

}  // namespace

StereoRig loadVispCamera(const fs::path& file, const std::string& name, ImageSize size) {
  if (!fs::is_regular_file(file)) {
    throw InputError("there is no file " + file.string() + ": expected ViSP camera parameters");
  }
  vpXmlParserCamera parser;
  vpCameraParameters camera;
  bool distorted = false;
  try {
    distorted =
        parse(parser, camera, file, name, vpCameraParameters::perspectiveProjWithDistortion, size);
    if (!distorted && !parse(parser, camera, file, name,
                             vpCameraParameters::perspectiveProjWithoutDistortion, size)) {
      throw InputError(file.string() + ": expected a <camera>" +
                       (name.empty() ? "" : " called " + name) +
                       " with a perspective model for this image size");
    }
  } catch (const vpException& e) {
    throw InputError(file.string() + ": expected ViSP camera parameters, but " +
                     e.getStringMessage());
  }
  StereoRig rig;
  rig.left.width = size.width > 0 ? size.width : static_cast<int>(parser.getWidth());
  rig.left.height = size.height > 0 ? size.height : static_cast<int>(parser.getHeight());
  if (rig.left.width <= 0 || rig.left.height <= 0) {
    throw InputError(file.string() + ": expected <image_width> and <image_height>");
  }
  rig.left.K << camera.get_px(), 0.0, camera.get_u0(), 0.0, camera.get_py(), camera.get_v0(), 0.0,
      0.0, 1.0;
  if (distorted) {
    rig.left.distortion = Eigen::Vector4d(camera.get_kud(), 0.0, 0.0, 0.0);
  }
  return rig;
}

StereoRig loadAnyRig(const fs::path& file, ImageSize size) {
  if (file.extension() == ".xml") {
    return loadVispCamera(file, "", size);
  }
  return loadRig(file);
}

}  // namespace ringhook

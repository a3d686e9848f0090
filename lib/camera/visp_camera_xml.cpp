#include "camera/visp_camera_xml.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// Keeps what ViSP's reader tells std::cout away from the program's own output.
class QuietOutput {
 public:
  QuietOutput() : kept_(std::cout.rdbuf(swallowed_.rdbuf())) {}
  ~QuietOutput() { std::cout.rdbuf(kept_); }
  QuietOutput(const QuietOutput&) = delete;
  QuietOutput& operator=(const QuietOutput&) = delete;

 private:
  std::ostringstream swallowed_;
  std::streambuf* kept_;
};

/// Reads one projection model, for the image size or for any; false if the file has none of that
/// kind for that camera.
bool parse(vpXmlParserCamera& parser, vpCameraParameters& camera, const fs::path& file,
           const std::string& name, vpCameraParameters::vpCameraParametersProjType kind,
           ImageSize size) {
  const auto width = static_cast<unsigned>(size.width);
  const auto height = static_cast<unsigned>(size.height);
  const auto path = file.string();
  const QuietOutput quiet;
  return parser.parse(camera, path, name, kind, width, height) == vpXmlParserCamera::SEQUENCE_OK ||
         parser.parse(camera, path, name, kind) == vpXmlParserCamera::SEQUENCE_OK;
}

/// Name of the first camera in the file, by which ViSP's reader wants to be asked; empty if
/// unnamed.
std::string firstCameraName(const fs::path& file) {
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string opening = "<name>";
  const auto begin = text.find(opening);
  const auto end = text.find("</name>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    return {};
  }
  return text.substr(begin + opening.size(), end - begin - opening.size());
}

/// The image size that file and images agree on.
ImageSize agreedSize(const vpXmlParserCamera& parser, const fs::path& file, ImageSize images) {
  const ImageSize stored{static_cast<int>(parser.getWidth()), static_cast<int>(parser.getHeight())};
  const ImageSize size{images.width > 0 ? images.width : stored.width,
                       images.height > 0 ? images.height : stored.height};
  if (size.width <= 0 || size.height <= 0) {
    throw InputError(file.string() + ": expected <image_width> and <image_height>");
  }
  if (stored.width > 0 && (stored.width != size.width || stored.height != size.height)) {
    throw InputError(file.string() + " is for images of " + std::to_string(stored.width) + "x" +
                     std::to_string(stored.height) + ", but the images are " +
                     std::to_string(size.width) + "x" + std::to_string(size.height));
  }
  return size;
}

}  // namespace

StereoRig loadVispCamera(const fs::path& file, const std::string& name, ImageSize size) {
  if (!isFile(file)) {
    throw InputError("there is no file " + file.string() + ": expected ViSP camera parameters");
  }
  vpXmlParserCamera parser;
  vpCameraParameters camera;
  bool distorted = false;
  const std::string asked = name.empty() ? firstCameraName(file) : name;
  try {
    distorted =
        parse(parser, camera, file, asked, vpCameraParameters::perspectiveProjWithDistortion, size);
    if (!distorted && !parse(parser, camera, file, asked,
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
  const ImageSize agreed = agreedSize(parser, file, size);
  rig.left.width = agreed.width;
  rig.left.height = agreed.height;
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

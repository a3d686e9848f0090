#include "camera/asl_folder.h"

#include <yaml-cpp/yaml.h>

#include <Eigen/LU>
#include <map>

#include "camera/csv_table.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

fs::path rootOf(const fs::path& folder) {
  return fs::exists(folder / "mav0" / "cam0" / "data.csv") ? folder / "mav0" : folder;
}

int pixelsOf(double value, const std::string& where) {
  constexpr double kMostPixels = 1e6;
  if (!(value >= 1.0 && value <= kMostPixels)) {
    throw InputError(where + ": expected a width and a height from 1 to 1000000");
  }
  return static_cast<int>(value);
}

/// One camera of the folder: its model and its place in the body.
struct AslCamera {
  CameraModel model;
  Eigen::Matrix4d bMc = Eigen::Matrix4d::Identity();
  double rate_hz = 0.0;
};

std::vector<double> numbersOf(const YAML::Node& node, std::size_t count, const std::string& where) {
  if (!node || !node.IsSequence() || node.size() != count) {
    throw InputError(where + ": expected " + std::to_string(count) + " numbers");
  }
  std::vector<double> values;
  for (const auto& value : node) {
    values.push_back(value.as<double>());
  }
  return values;
}

AslCamera readSensor(const fs::path& file) {
  if (!isFile(file)) {
    throw InputError("there is no file " + file.string() + ": expected the camera's calibration");
  }
  const std::string name = file.string();
  const YAML::Node yaml = YAML::LoadFile(name);
  const auto kind = yaml["distortion_model"] ? yaml["distortion_model"].as<std::string>() : "";
  if (kind != "radial-tangential" && kind != "radtan") {
    throw InputError(name + ", key distortion_model: expected radial-tangential, found '" + kind +
                     "'");
  }
  AslCamera camera;
  const auto size = numbersOf(yaml["resolution"], 2, name + ", key resolution");
  const auto k = numbersOf(yaml["intrinsics"], 4, name + ", key intrinsics (fu, fv, cu, cv)");
  const auto d =
      numbersOf(yaml["distortion_coefficients"], 4, name + ", key distortion_coefficients");
  const auto m = numbersOf(yaml["T_BS"]["data"], 16, name + ", key T_BS.data");
  camera.model.width = pixelsOf(size[0], name + ", key resolution");
  camera.model.height = pixelsOf(size[1], name + ", key resolution");
  camera.model.K << k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0;
  camera.model.distortion = Eigen::Map<const Eigen::VectorXd>(d.data(), 4);
  for (int i = 0; i < 16; ++i) {
    camera.bMc(i / 4, i % 4) = m[static_cast<std::size_t>(i)];
  }
  camera.rate_hz = yaml["rate_hz"] ? yaml["rate_hz"].as<double>() : 0.0;
  return camera;
}

/// Image files by stamp [ns].
std::map<long long, fs::path> readStamps(const fs::path& camera) {
  const CsvTable table(camera / "data.csv");
  const auto stamp = table.column("timestamp [ns]");
  const auto file = table.column("filename");
  std::map<long long, fs::path> stamps;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    fs::path image = camera / "data" / table.text(row, file);
    if (!isFile(image)) {
      throw InputError(table.where(row, file) + ": there is no file " + image.string());
    }
    stamps.emplace(table.integer(row, stamp), std::move(image));
  }
  return stamps;
}

StereoRig rigOf(const AslCamera& left, const std::optional<AslCamera>& right) {
  StereoRig rig;
  rig.left = left.model;
  if (right) {
    rig.right = right->model;
    rig.c2Mc1.matrix() = right->bMc.inverse() * left.bMc;
  }
  return rig;
}

Sequence readFolder(const fs::path& root) {
  const bool stereo = fs::exists(root / "cam1" / "data.csv");
  const AslCamera left = readSensor(root / "cam0" / "sensor.yaml");
  std::optional<AslCamera> right;
  std::map<long long, fs::path> right_stamps;
  if (stereo) {
    right = readSensor(root / "cam1" / "sensor.yaml");
    right_stamps = readStamps(root / "cam1");
  }
  Sequence sequence;
  sequence.name = root.filename().string();
  sequence.rate_hz = left.rate_hz > 0.0 ? left.rate_hz : 20.0;
  sequence.rig = rigOf(left, right);
  for (const auto& [stamp, image] : readStamps(root / "cam0")) {
    const auto partner = right_stamps.find(stamp);
    if (stereo && partner == right_stamps.end()) {
      continue;
    }
    SequenceFrame frame;
    frame.frame = sequence.frames.size();
    frame.time = Time::fromNanoseconds(stamp);
    frame.left = image;
    frame.right = stereo ? partner->second : fs::path();
    sequence.frames.push_back(std::move(frame));
  }
  if (sequence.frames.empty()) {
    throw InputError(root.string() + ": expected stamps that cam0 and cam1 share, found none");
  }
  return sequence;
}

}  // namespace

bool isAslFolder(const fs::path& folder) {
  return fs::exists(rootOf(folder) / "cam0" / "data.csv");
}

Sequence openAslFolder(const fs::path& folder) {
  try {
    return readFolder(rootOf(folder));
  } catch (const YAML::Exception& e) {
    throw InputError(folder.string() + ": expected numbers in sensor.yaml, line " +
                     std::to_string(e.mark.line + 1) + ": " + e.msg);
  }
}

}  // namespace ringhook

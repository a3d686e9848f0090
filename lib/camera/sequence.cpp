#include "camera/sequence.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <cmath>
#include <fstream>

#include "camera/asl_folder.h"
#include "camera/csv_table.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

Pose poseFromNumbers(const std::array<double, 7>& v, const std::string& where) {
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  if (std::abs(rotation.norm() - 1.0) > 0.01) {
    throw InputError(where + ": expected a quaternion qx,qy,qz,qw of norm 1, found norm " +
                     std::to_string(rotation.norm()));
  }
  return makePose({v[0], v[1], v[2]}, rotation);
}

Pose poseFromPosFile(const fs::path& file, const std::string& where) {
  std::ifstream stream(file);
  std::array<double, 6> v{};
  for (double& value : v) {
    if (!(stream >> value)) {
      throw InputError(where + ": expected six numbers x y z tux tuy tuz in " + file.string());
    }
  }
  return makePoseThetaU({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
}

/// Text of a key; empty if absent.
std::string textOf(const YAML::Node& node, const std::string& key, const fs::path& file) {
  const YAML::Node value = node[key];
  if (!value || value.IsNull()) {
    return {};
  }
  if (!value.IsScalar()) {
    throw InputError(file.string() + ": expected a text for the key " + key);
  }
  return value.Scalar();
}

fs::path existing(const fs::path& base, const std::string& name, const std::string& where) {
  if (name.empty()) {
    return {};
  }
  fs::path path = base / name;
  if (!isFile(path)) {
    throw InputError(where + ": there is no file " + path.string());
  }
  return path;
}

Pose startPose(const YAML::Node& start, const fs::path& folder, const std::string& where) {
  if (start.IsScalar()) {
    const fs::path file = folder / start.Scalar();
    return poseFromText(file.extension() == ".pos" ? file.string() : start.Scalar(), where);
  }
  std::string text;
  for (const auto& value : start) {
    text += (text.empty() ? "" : ",") + (value.IsScalar() ? value.Scalar() : std::string("?"));
  }
  return poseFromText(text, where);
}

int offsetOf(const CsvTable& table, std::size_t row, const std::string& column) {
  if (!table.has(column)) {
    return 0;
  }
  const std::size_t index = table.column(column);
  const long long value = table.integer(row, index);
  if (value < 0 || value > 1'000'000) {
    throw InputError(table.where(row, index) + ": expected an offset of 0 or more pixels");
  }
  return static_cast<int>(value);
}

Time growingTime(const CsvTable& table, std::size_t row, std::size_t column,
                 const std::optional<Time>& before) {
  const double seconds = table.number(row, column);
  if (std::abs(seconds) > 9e9) {
    throw InputError(table.where(row, column) + ": expected seconds, found " +
                     table.text(row, column));
  }
  const Time time = Time::fromSeconds(seconds);
  if (before && !(time > *before)) {
    throw InputError(table.where(row, column) + ": time must grow from row to row, found " +
                     table.text(row, column) + " after " + std::to_string(before->seconds()));
  }
  return time;
}

std::vector<SequenceFrame> readFrames(const fs::path& file, const fs::path& images) {
  const CsvTable table(file);
  const auto number = table.column("frame");
  const auto time = table.column("time_s");
  const auto left = table.column("left");
  std::vector<SequenceFrame> frames;
  std::optional<Time> before;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    SequenceFrame frame;
    frame.frame = static_cast<std::uint64_t>(table.integer(row, number));
    frame.time = growingTime(table, row, time, before);
    frame.left = existing(images, table.text(row, left), table.where(row, left));
    if (frame.left.empty()) {
      throw InputError(table.where(row, left) + ": expected the name of an image");
    }
    if (table.has("right")) {
      const auto right = table.column("right");
      frame.right = existing(images, table.text(row, right), table.where(row, right));
      if (row > 0 && frame.right.empty() != frames.front().right.empty()) {
        throw InputError(table.where(row, right) + ": expected a right image in every row or none");
      }
    }
    frame.left_x_px = offsetOf(table, row, "left_x_px");
    frame.left_y_px = offsetOf(table, row, "left_y_px");
    frame.right_x_px = offsetOf(table, row, "right_x_px");
    frame.right_y_px = offsetOf(table, row, "right_y_px");
    frame.placed = table.has("left_x_px") && table.has("left_y_px");
    before = frame.time;
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) {
    throw InputError(file.string() + " has no rows: expected at least one frame");
  }
  return frames;
}

Pose poseOfRow(const CsvTable& table, std::size_t row) {
  static constexpr std::array kNames = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    v.at(i) = table.number(row, table.column(kNames.at(i)));
  }
  return poseFromNumbers(v, table.where(row, table.column("qw")));
}

std::vector<StampedArm> readArm(const fs::path& file) {
  const CsvTable table(file);
  const auto time = table.column("time_s");
  std::vector<StampedArm> samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    StampedArm sample;
    sample.time = growingTime(table, row, time,
                              samples.empty() ? std::nullopt : std::optional(samples.back().time));
    for (int joint = 0; joint < 6; ++joint) {
      const std::string column = "j" + std::to_string(joint + 1) + "_rad";
      sample.position(joint) = table.number(row, table.column(column));
    }
    sample.fMe = poseOfRow(table, row);
    samples.push_back(sample);
  }
  return samples;
}

Sequence openOwnFolder(const fs::path& folder) {
  const fs::path file = folder / "sequence.yaml";
  const std::string name = file.string();
  const YAML::Node yaml = YAML::LoadFile(name);
  if (!yaml.IsMap()) {
    throw InputError(name + ": expected keys such as name, rate_hz, rig and target");
  }
  Sequence sequence;
  sequence.name = textOf(yaml, "name", file);
  const auto rate = numberFromText(textOf(yaml, "rate_hz", file));
  if (!rate || *rate <= 0.0) {
    throw InputError(name + ": expected a positive number for the key rate_hz");
  }
  sequence.rate_hz = *rate;
  const std::string rig = textOf(yaml, "rig", file);
  sequence.rig_file = existing(folder, rig.empty() ? "rig.yaml" : rig, name + ", key rig");
  sequence.target_file = existing(folder, textOf(yaml, "target", file), name + ", key target");
  sequence.settings_file =
      existing(folder, textOf(yaml, "settings", file), name + ", key settings");
  sequence.notes = textOf(yaml, "notes", file);
  sequence.licence = textOf(yaml, "licence", file);
  if (yaml["start"]) {
    sequence.c1Mo_start = startPose(yaml["start"], folder, name + ", key start");
  }
  sequence.frames = readFrames(folder / "frames.csv", folder / textOf(yaml, "images", file));
  if (fs::exists(folder / "truth.csv")) {
    sequence.c1Mo_truth = readStampedPoses(folder / "truth.csv");
  }
  if (fs::exists(folder / "robot.csv")) {
    sequence.robot = readArm(folder / "robot.csv");
  }
  return sequence;
}

}  // namespace

Sequence openSequence(const fs::path& folder) {
  if (!isFolder(folder)) {
    throw InputError("there is no folder " + folder.string() + ": expected a sequence folder");
  }
  if (!fs::exists(folder / "sequence.yaml")) {
    if (isAslFolder(folder)) {
      return openAslFolder(folder);
    }
    throw InputError(folder.string() + " is no sequence folder: expected sequence.yaml, or " +
                     "cam0/data.csv as EuRoC and ASL have it");
  }
  try {
    return openOwnFolder(folder);
  } catch (const YAML::Exception& e) {
    throw InputError((folder / "sequence.yaml").string() + " line " +
                     std::to_string(e.mark.line + 1) + ": expected YAML, but " + e.msg);
  }
}

std::vector<StampedPose> readStampedPoses(const fs::path& file) {
  const CsvTable table(file);
  const auto time = table.column("time_s");
  std::vector<StampedPose> poses;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto before = poses.empty() ? std::nullopt : std::optional(poses.back().time);
    poses.push_back({growingTime(table, row, time, before), poseOfRow(table, row)});
  }
  return poses;
}

Pose poseFromText(const std::string& text, const std::string& where) {
  if (fs::path(text).extension() == ".pos") {
    return poseFromPosFile(text, where);
  }
  const auto pieces = splitText(text, ',');
  std::array<double, 7> v{};
  bool good = pieces.size() == v.size();
  for (std::size_t i = 0; good && i < v.size(); ++i) {
    const auto number = numberFromText(pieces[i]);
    good = number.has_value();
    v.at(i) = number.value_or(0.0);
  }
  if (!good) {
    throw InputError(where + ": expected seven numbers x,y,z,qx,qy,qz,qw or a .pos file, found '" +
                     text + "'");
  }
  return poseFromNumbers(v, where);
}

}  // namespace ringhook

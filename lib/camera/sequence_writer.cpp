#include "camera/sequence_writer.h"

#include <yaml-cpp/yaml.h>

#include <cstdio>
#include <utility>

#include "camera/image_file.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/number_text.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr auto kFramesHeader =
    "frame,time_s,left,right,left_x_px,left_y_px,right_x_px,right_y_px\n";
constexpr auto kTruthHeader = "time_s,x,y,z,qx,qy,qz,qw\n";
constexpr auto kRobotHeader =
    "time_s,j1_rad,j2_rad,j3_rad,j4_rad,j5_rad,j6_rad,x,y,z,qx,qy,qz,qw\n";

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

std::string poseText(const Pose& pose) {
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  std::string text;
  for (const double value : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
    text += (text.empty() ? "" : ",") + digits(value);
  }
  return text;
}

/// Copies the target beside the images, so that the folder can travel.
std::string copiedTarget(const fs::path& folder, const fs::path& target) {
  if (target.empty()) {
    return {};
  }
  std::error_code failed;
  const fs::path copy = folder / target.filename();
  fs::copy_file(target, copy, fs::copy_options::overwrite_existing, failed);
  if (failed) {
    throw InputError("cannot copy the target " + target.string() + " to " + copy.string() + ": " +
                     failed.message());
  }
  return target.filename().string();
}

std::string sequenceYaml(const SequenceInfo& info, const std::string& target) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "name" << YAML::Value << info.name;
  out << YAML::Key << "rate_hz" << YAML::Value << info.rate_hz;
  out << YAML::Key << "rig" << YAML::Value << "rig.yaml";
  if (!target.empty()) {
    out << YAML::Key << "target" << YAML::Value << target;
  }
  if (info.c1Mo_start) {
    out << YAML::Key << "start" << YAML::Value << poseText(*info.c1Mo_start);
  }
  out << YAML::Key << "notes" << YAML::Value << info.notes;
  out << YAML::Key << "licence" << YAML::Value << info.licence;
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace

SequenceWriter::SequenceWriter(fs::path folder, const SequenceInfo& info, const StereoRig& rig)
    : folder_(std::move(folder)), extension_("." + info.image_format) {
  if (info.image_format != "png" && info.image_format != "pgm") {
    throw InputError("image format " + info.image_format + ": expected png or pgm");
  }
  if (!(info.rate_hz > 0.0)) {
    throw InputError("a recording needs a positive rate_hz");
  }
  std::error_code failed;
  fs::create_directories(folder_ / "left", failed);
  fs::create_directories(folder_ / "right", failed);
  for (const auto* table : {"frames.csv", "truth.csv", "robot.csv"}) {
    fs::remove(folder_ / table, failed);
  }
  saveRig(folder_ / "rig.yaml", rig);
  writeFileAtomically(folder_ / "sequence.yaml",
                      sequenceYaml(info, copiedTarget(folder_, info.target)));
  frame_table_ = std::make_unique<TableFile>(folder_ / "frames.csv", kFramesHeader);
}

SequenceWriter::~SequenceWriter() {
  try {
    close();
  } catch (const std::exception&) {
    frame_table_.reset();
  }
}

void SequenceWriter::addFrame(const StereoFrame& frame) {
  char number[24];
  std::snprintf(number, sizeof(number), "%06zu", frames_);
  const std::string left = "left/" + std::string(number) + extension_;
  const std::string right =
      frame.right.empty() ? std::string() : "right/" + std::string(number) + extension_;
  try {
    writeGrayImage(folder_ / left, frame.left);
    if (!right.empty()) {
      writeGrayImage(folder_ / right, frame.right);
    }
    frame_table_->append(std::to_string(frame.index) + "," + secondsText(frame.time) + "," + left +
                         "," + right + "," + std::to_string(frame.left_window.x) + "," +
                         std::to_string(frame.left_window.y) + "," +
                         std::to_string(frame.right_window.x) + "," +
                         std::to_string(frame.right_window.y) + "\n");
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(folder_ / left, ignored);
    if (!right.empty()) {
      fs::remove(folder_ / right, ignored);
    }
    throw;
  }
  ++frames_;
}

void SequenceWriter::addTruth(Time time, const Pose& c1Mo) {
  if (!truth_table_) {
    truth_table_ = std::make_unique<TableFile>(folder_ / "truth.csv", kTruthHeader);
  }
  truth_table_->append(secondsText(time) + "," + poseText(c1Mo) + "\n");
}

void SequenceWriter::addRobot(Time time, const JointVector& position, const Pose& fMe) {
  if (!robot_table_) {
    robot_table_ = std::make_unique<TableFile>(folder_ / "robot.csv", kRobotHeader);
  }
  std::string row = secondsText(time);
  for (const double angle : position) {
    row += "," + digits(angle);
  }
  robot_table_->append(row + "," + poseText(fMe) + "\n");
}

void SequenceWriter::close() {
  for (const auto* table : {&frame_table_, &truth_table_, &robot_table_}) {
    if (*table) {
      (*table)->close();
    }
  }
}

}  // namespace ringhook

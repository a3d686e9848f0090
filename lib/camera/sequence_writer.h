#pragma once

/// \file
/// Records a sequence folder (doc/formats.md). Each image is written whole or not at all; the
/// tables grow row by row, each row after the images that it names. So what ends a recording, an
/// exception, Ctrl-C, a full disk or a kill, leaves a valid sequence of the frames that were whole
/// by then.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "camera/table_file.h"
#include "core/joints.h"
#include "core/pose.h"
#include "core/stereo_frame.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// What sequence.yaml says of a recording.
struct SequenceInfo {
  std::string name;
  double rate_hz = 0.0;            ///< nominal frame rate [Hz]
  std::filesystem::path target;    ///< marker.yaml or .cao; copied into the folder, may be empty
  std::optional<Pose> c1Mo_start;  ///< target in the left camera at the first frame
  std::string notes;
  std::string licence;
  std::string image_format = "png";  ///< png or pgm: smaller, or faster to write
};

class SequenceWriter {
 public:
  /// Makes the folder, writes sequence.yaml and rig.yaml and drops an older recording's tables.
  /// Throws InputError for an unknown format or a rate that is none, Error if the disk refuses.
  SequenceWriter(std::filesystem::path folder, const SequenceInfo& info, const StereoRig& rig);
  /// Closes; a failure is then silent, so call close() to hear of it.
  ~SequenceWriter();
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// Stores the images and their window offsets. Throws Error if the disk refuses; the sequence
  /// then stands as it was before.
  void addFrame(const StereoFrame& frame);
  /// One row of truth.csv: target in the left camera. Throws Error.
  void addTruth(Time time, const Pose& c1Mo);
  /// One row of robot.csv: joint angles [rad] and flange in the robot reference. Throws Error.
  void addRobot(Time time, const JointVector& position, const Pose& fMe);

  /// Frames that are whole.
  [[nodiscard]] std::size_t frames() const { return frames_; }

  /// Waits until the disk has the tables. Nothing may be added afterwards. Throws Error.
  void close();

 private:
  std::filesystem::path folder_;
  std::string extension_;
  std::size_t frames_ = 0;
  std::unique_ptr<TableFile> frame_table_;
  std::unique_ptr<TableFile> truth_table_;  ///< made with its first row
  std::unique_ptr<TableFile> robot_table_;  ///< likewise
};

}  // namespace ringhook

#pragma once

/// \file
/// Records a sequence folder (doc/formats.md). Each image is written whole or not at all; the
/// tables are rewritten whole every `rows_per_save` frames and on close(), after the images that
/// they name. So a run that ends by an exception, by Ctrl-C or by a lost power line leaves a
/// valid sequence of what it had.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

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
  std::size_t rows_per_save = 100;   ///< frames between two writings of the tables
};

class SequenceWriter {
 public:
  /// Makes the folder, writes sequence.yaml and rig.yaml and drops an older recording's tables.
  /// Throws InputError if the folder cannot be written or the format is unknown.
  SequenceWriter(std::filesystem::path folder, const SequenceInfo& info, const StereoRig& rig);
  /// Closes; a failure is then silent, so call close() to hear of it.
  ~SequenceWriter();
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// Stores the images and their window offsets. Throws Error if the disk refuses.
  void addFrame(const StereoFrame& frame);
  /// One row of truth.csv: target in the left camera.
  void addTruth(Time time, const Pose& c1Mo);
  /// One row of robot.csv: joint angles [rad] and flange in the robot reference.
  void addRobot(Time time, const JointVector& position, const Pose& fMe);

  /// Writes the tables a last time. Nothing may be added afterwards. Throws Error.
  void close();

 private:
  void saveTables() const;

  std::filesystem::path folder_;
  std::string extension_;
  std::size_t rows_per_save_;
  std::size_t frames_ = 0;
  std::string frame_rows_;  ///< of frames.csv, as text
  std::string truth_rows_;
  std::string robot_rows_;
  bool closed_ = false;
};

}  // namespace ringhook

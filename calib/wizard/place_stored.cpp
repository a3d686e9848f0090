#include <algorithm>
#include <utility>
#include <vector>

#include "calib/solve/pose_table.h"
#include "calib/wizard/place.h"
#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "camera/sequence.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr double kArmGap = 0.1;  // a frame may lie so far from the arm's nearest row [s]

struct Shot {
  SequenceFrame files;
  std::optional<StampedArm> arm;
};

/// The arm at `time` between its rows; nothing far from all of them.
std::optional<StampedArm> armAt(const std::vector<StampedArm>& rows, Time time) {
  const auto next = std::lower_bound(rows.begin(), rows.end(), time,
                                     [](const StampedArm& row, Time t) { return row.time < t; });
  const auto last = next == rows.begin() ? next : next - 1;
  if (rows.empty() || (next == rows.end() && time - last->time > kArmGap) ||
      (next != rows.end() && next == last && next->time - time > kArmGap)) {
    return std::nullopt;
  }
  if (next == rows.end() || next == last) {
    return *last;
  }
  if (next->time - last->time > 2.0 * kArmGap) {
    return std::nullopt;
  }
  const double share = (time - last->time) / (next->time - last->time);
  return StampedArm{time, last->position + share * (next->position - last->position),
                    interpolate(last->fMe, next->fMe, share)};
}

std::vector<Shot> shotsOfSequence(const fs::path& folder) {
  Sequence sequence = openSequence(folder);
  std::vector<Shot> shots;
  for (SequenceFrame& frame : sequence.frames) {
    if (frame.right.empty()) {
      throw InputError(folder.string() + ": expected a sequence of two cameras");
    }
    const Time time = frame.time;
    shots.push_back({std::move(frame), armAt(sequence.robot, time)});
  }
  return shots;
}

std::vector<Shot> looseShots(const fs::path& folder) {
  const auto left = filesMatching((folder / "left" / "*").string());
  const auto right = filesMatching((folder / "right" / "*").string());
  if (left.empty() || left.size() != right.size()) {
    throw InputError(folder.string() + ": expected a sequence, or left/ and right/ with as many " +
                     "images each; found " + std::to_string(left.size()) + " and " +
                     std::to_string(right.size()));
  }
  std::vector<ArmRow> arm;
  if (isFile(folder / "robot.csv")) {
    arm = readArmRows(folder / "robot.csv");
    if (arm.size() != left.size()) {
      throw InputError((folder / "robot.csv").string() + ": expected a row for each of the " +
                       std::to_string(left.size()) + " pairs, found " + std::to_string(arm.size()));
    }
  }
  std::vector<Shot> shots(left.size());
  for (std::size_t i = 0; i < shots.size(); ++i) {
    shots[i].files.frame = i;
    shots[i].files.time = Time::fromSeconds(static_cast<double>(i));
    shots[i].files.left = left[i];
    shots[i].files.right = right[i];
    if (!arm.empty()) {
      shots[i].arm = {shots[i].files.time, arm[i].joints, arm[i].fMe};
    }
  }
  return shots;
}

class StoredPlace final : public CalibrationPlace {
 public:
  explicit StoredPlace(fs::path folder)
      : folder_(std::move(folder)),
        shots_(isFile(folder_ / "sequence.yaml") || isFolder(folder_ / "cam0")
                   ? shotsOfSequence(folder_)
                   : looseShots(folder_)) {
    const GrayImage first = readGrayImage(shots_.front().files.left);
    full_ = {0, 0, first.width, first.height};
  }

  [[nodiscard]] std::string name() const override {
    return std::to_string(shots_.size()) + " stored pairs of " + folder_.string();
  }
  [[nodiscard]] Window fullImage() const override { return full_; }

  [[nodiscard]] std::optional<StereoFrame> takePair() override {
    step();
    if (next_ == shots_.size()) {
      return std::nullopt;
    }
    const SequenceFrame& files = shots_[next_++].files;
    StereoFrame frame;
    frame.time = files.time;
    frame.index = files.frame;
    frame.left = readGrayImage(files.left);
    frame.right = readGrayImage(files.right);
    frame.left_window = {files.left_x_px, files.left_y_px, frame.left.width, frame.left.height};
    frame.right_window = {files.right_x_px, files.right_y_px, frame.right.width,
                          frame.right.height};
    return frame;
  }

  [[nodiscard]] Outcome<ArmState> armState() override {
    const std::optional<StampedArm> arm = lastArm();
    if (!arm) {
      return Refusal{"no robot.csv tells where the arm was"};
    }
    return ArmState{arm->time, arm->position, JointVector::Zero(), false};
  }
  /// As the folder tells, whatever arm it was.
  [[nodiscard]] Outcome<Pose> flange() override {
    const std::optional<StampedArm> arm = lastArm();
    if (!arm) {
      return Refusal{"no robot.csv tells where the arm was"};
    }
    return arm->fMe;
  }

 private:
  [[nodiscard]] std::optional<StampedArm> lastArm() const {
    return next_ == 0 ? std::nullopt : shots_[next_ - 1].arm;
  }

  fs::path folder_;
  std::vector<Shot> shots_;
  Window full_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<CalibrationPlace> openStoredPlace(const std::filesystem::path& folder) {
  if (!isFolder(folder)) {
    throw InputError(folder.string() + ": expected a folder with stored pairs of images");
  }
  return std::make_unique<StoredPlace>(folder);
}

}  // namespace ringhook

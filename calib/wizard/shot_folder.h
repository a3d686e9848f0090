#pragma once

/// \file
/// Pairs of pictures on disk, one after the other, and where the arm stood: left/0001.png,
/// right/0001.png, robot.csv (doc/formats.md). A pair counts once both pictures and its row are
/// whole, so that a wizard that is killed loses nothing but the pair it was taking; and the folder
/// can be calibrated from again without the wizard.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/solve/pose_table.h"
#include "core/image.h"

namespace ringhook {

class ShotFolder {
 public:
  /// Takes up what is there; pictures without partner or row are not counted. Throws InputError
  /// naming file and line for a table that is none.
  ShotFolder(std::filesystem::path folder, bool with_arm);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::filesystem::path left(std::size_t index) const;
  [[nodiscard]] std::filesystem::path right(std::size_t index) const;
  [[nodiscard]] std::filesystem::path table() const { return folder_ / "robot.csv"; }
  [[nodiscard]] std::vector<std::filesystem::path> allLeft() const;
  [[nodiscard]] std::vector<std::filesystem::path> allRight() const;
  [[nodiscard]] const std::vector<ArmRow>& arms() const { return arms_; }

  /// Stores a pair, and where the arm stood if the folder was made with_arm. Throws Error if the
  /// disk refuses; the folder then counts as before.
  void add(const GrayImage& left, const GrayImage& right, const ArmRow& arm = {});
  /// Removes every pair.
  void clear();

 private:
  void writeTable(const std::vector<ArmRow>& arms) const;

  std::filesystem::path folder_;
  bool with_arm_;
  std::size_t count_ = 0;
  std::vector<ArmRow> arms_;
};

}  // namespace ringhook

#pragma once

/// \file
/// How near each place of an image is to an edge of a given direction: one distance map for each
/// of eight directions, on the image reduced so that a search costs little.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/stereo_frame.h"

namespace ringhook {

class EdgeField {
 public:
  static constexpr int kDirections = 8;  ///< of 22.5 degrees each
  static constexpr int kReduction = 4;   ///< full-size pixels per pixel of the maps

  /// \param cutoff_px distance beyond which an edge no longer counts [full-size px].
  EdgeField(const RectifiedView& view, double cutoff_px);

  /// 0 (no edge of this direction near) to 255 (on one). `direction` is any vector along the line.
  [[nodiscard]] int nearness(const Eigen::Vector2d& pixel, const Eigen::Vector2d& direction) const;
  [[nodiscard]] const PinholeView& camera() const { return camera_; }

 private:
  PinholeView camera_;
  Window window_;
  int width_ = 0;   ///< of the maps
  int height_ = 0;  ///< of the maps
  std::array<std::vector<std::uint8_t>, kDirections> maps_;
};

}  // namespace ringhook

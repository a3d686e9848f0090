#pragma once

/// \file
/// What the cameras see, for the person who holds the board: both pictures side by side, small,
/// with the points that were found, rewritten in place as a file that any viewer shows, and in a
/// window where there is a display.

#include <filesystem>
#include <vector>

#include "core/stereo_frame.h"

namespace ringhook {

class LiveView {
 public:
  /// \param file PNG to rewrite. \param window whether to open one, too.
  LiveView(std::filesystem::path file, bool window);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  /// \param left, right points found, pixels of the full images [px]. Throws Error if the disk
  /// refuses.
  void show(const StereoFrame& frame, const std::vector<Eigen::Vector2d>& left,
            const std::vector<Eigen::Vector2d>& right);

  /// Whether a window can be opened here: a display is named in the environment.
  static bool displayAtHand();

 private:
  std::filesystem::path file_;
  bool window_;
};

}  // namespace ringhook

#pragma once

/// \file
/// A StereoCamera that plays a recording: a stored sequence, two globs of images, or two videos.
/// Colour becomes grey (ITU-R BT.601 luma, as OpenCV does it). The recording keeps its own windows
/// and rate: setWindows() and setFrameRate() are heard and change nothing. Every image must fit
/// the rig; the first that does not ends the replay with an InputError that names it and both
/// sizes.

#include <cstddef>
#include <memory>
#include <string>

#include "camera/sequence.h"
#include "camera/stereo_camera.h"

namespace ringhook {

class ReplaySource;

class ReplayStereoCamera : public StereoCamera {
 public:
  /// Plays `sequence`, taken by a camera of the given full size [px].
  ReplayStereoCamera(Sequence sequence, int width, int height);

  /// Plays loose files, `rate_hz` [Hz] apart. Each side is a glob ("left/*.png", played in the
  /// order of their names) or a video file; `right` empty for one camera. Throws InputError if
  /// nothing matches, a video cannot be opened, or the globs differ in length.
  ReplayStereoCamera(const std::string& left, const std::string& right, double rate_hz, int width,
                     int height);
  ~ReplayStereoCamera() override;

  [[nodiscard]] Window fullImage() const override;
  void setWindows(const Window& left, const Window& right) override;
  void setFrameRate(double rate_hz) override;
  [[nodiscard]] std::optional<StereoFrame> grab(double timeout_s) override;
  [[nodiscard]] bool finished() const override;

  /// Frames in all, as far as the files tell; a video's container may be wrong or silent (0).
  [[nodiscard]] std::size_t expectedFrames() const;

 private:
  std::unique_ptr<ReplaySource> source_;
  Window full_;
};

/// Files that match a glob (*, ? and [...]), in natural order ("2" before "10"); a name
/// without wildcards matches itself.
[[nodiscard]] std::vector<std::filesystem::path> filesMatching(const std::string& pattern);

}  // namespace ringhook

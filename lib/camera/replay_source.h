#pragma once

/// \file
/// Where a replay's images come from: stored files or videos. Used by replay_camera.cpp only.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "camera/sequence.h"
#include "core/stereo_frame.h"

namespace ringhook {

/// A pair as read, not yet checked against the rig.
struct ReplayedFrame {
  StereoFrame frame;
  bool placed = false;     ///< the windows' places were stored
  std::string left_name;   ///< file, for messages
  std::string right_name;  ///< file, for messages; empty for one camera
};

class ReplaySource {
 public:
  ReplaySource() = default;
  ReplaySource(const ReplaySource&) = delete;
  ReplaySource& operator=(const ReplaySource&) = delete;
  virtual ~ReplaySource() = default;

  /// Nothing at the end. Throws InputError for an unreadable file.
  [[nodiscard]] virtual std::optional<ReplayedFrame> next() = 0;
  [[nodiscard]] virtual bool finished() const = 0;
  [[nodiscard]] virtual std::size_t expectedFrames() const = 0;  ///< 0 if unknown
};

/// Files of a sequence.
[[nodiscard]] std::unique_ptr<ReplaySource> sourceOfSequence(Sequence sequence);

/// Two globs or two videos (or one), frames `rate_hz` [Hz] apart. Throws InputError.
[[nodiscard]] std::unique_ptr<ReplaySource> sourceOfFiles(const std::string& left,
                                                          const std::string& right, double rate_hz);

}  // namespace ringhook

#pragma once

/// \file
/// Grey images from and to files; OpenCV stays behind this fence.

#include <filesystem>
#include <memory>
#include <optional>

#include "core/image.h"

namespace ringhook {

/// Reads PNG, PGM, PPM, JPEG, TIFF or BMP; colour becomes grey, 16 bits become 8, the rotation
/// tag of a photograph is ignored (a calibration is of the pixels). Throws InputError.
[[nodiscard]] GrayImage readGrayImage(const std::filesystem::path& file);

/// Writes PNG or PGM by the name's extension, whole or not at all. Throws Error.
void writeGrayImage(const std::filesystem::path& file, const GrayImage& image);

/// True for the names of the video containers that are read (.mp4, .avi, .mkv, .mov, .webm, .mpg,
/// .mpeg, .m4v, .ogv).
[[nodiscard]] bool isVideoName(const std::filesystem::path& file);

/// A video file, frame after frame, as grey images.
class VideoReader {
 public:
  /// Throws InputError if it cannot be opened.
  explicit VideoReader(const std::filesystem::path& file);
  ~VideoReader();
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;

  /// Nothing after the last frame.
  [[nodiscard]] std::optional<GrayImage> next();
  /// As the container says; 0 if it does not.
  [[nodiscard]] std::size_t expectedFrames() const;
  [[nodiscard]] double rateHz() const;  ///< [Hz], 0 if the container does not say

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

}  // namespace ringhook

#pragma once

/// \file
/// OpenGL buffers that own themselves: a multisampled canvas with the plain one that it is
/// resolved into, and a depth map that shaders can compare with. To be made, used and ended with
/// their context current.

namespace ringhook {

/// 4 samples a pixel, averaged where they are resolved.
class GlCanvas {
 public:
  /// \param format of a pixel, an OpenGL internal format. Throws DeviceError if OpenGL refuses.
  GlCanvas(int width, int height, unsigned format);
  ~GlCanvas();
  GlCanvas(const GlCanvas&) = delete;
  GlCanvas& operator=(const GlCanvas&) = delete;

  [[nodiscard]] int width() const { return width_; }    ///< [px]
  [[nodiscard]] int height() const { return height_; }  ///< [px]
  /// Draw into the rectangle from now on; clears it.
  void begin(int x, int y, int width, int height) const;
  /// Averages that rectangle's samples and copies it out, one row after the other.
  void read(int x, int y, int width, int height, unsigned format, unsigned type, void* to) const;

 private:
  int width_;
  int height_;
  unsigned drawn_ = 0;
  unsigned resolved_ = 0;
  unsigned buffers_[3] = {0, 0, 0};
};

class GlDepthMap {
 public:
  /// \param side of the square map [px]. Throws DeviceError if OpenGL refuses.
  explicit GlDepthMap(int side);
  ~GlDepthMap();
  GlDepthMap(const GlDepthMap&) = delete;
  GlDepthMap& operator=(const GlDepthMap&) = delete;

  [[nodiscard]] int side() const { return side_; }
  /// Draw into the rectangle from now on; clears it.
  void begin(int x, int y, int width, int height) const;
  /// For a sampler2DShadow: farther than the map is 0, outside of the map nothing is hidden.
  [[nodiscard]] unsigned texture() const { return texture_; }

 private:
  int side_;
  unsigned frame_ = 0;
  unsigned texture_ = 0;
};

}  // namespace ringhook

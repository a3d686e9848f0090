#include "sim/camera_eye.h"

#include <cmath>

namespace ringhook {
namespace {

/// Luma of ITU-R BT.601.
void toGrey(const ColourImage& colour, std::vector<float>& grey) {
  grey.resize(colour.pixels.size() / 4);
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const std::uint8_t* p = &colour.pixels[4 * i];
    grey[i] = 0.299F * static_cast<float>(p[0]) + 0.587F * static_cast<float>(p[1]) +
              0.114F * static_cast<float>(p[2]);
  }
}

/// The lens's blur: weights 1 6 1 / 8 along both axes, a standard deviation of half a pixel.
/// The image's outermost pixels stay as they are.
void blur(int width, int height, std::vector<float>& grey, std::vector<float>& scratch) {
  scratch = grey;
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y) {
    const float* from = &grey[at(0, y)];
    float* to = &scratch[at(0, y)];
    for (int x = 1; x < width - 1; ++x) {
      to[x] = 0.75F * from[x] + 0.125F * (from[x - 1] + from[x + 1]);
    }
  }
  for (int y = 1; y < height - 1; ++y) {
    const float* above = &scratch[at(0, y - 1)];
    const float* from = &scratch[at(0, y)];
    const float* below = &scratch[at(0, y + 1)];
    float* to = &grey[at(0, y)];
    for (int x = 0; x < width; ++x) {
      to[x] = 0.75F * from[x] + 0.125F * (above[x] + below[x]);
    }
  }
}

/// Bilinear interpolation; (x, y) from the first pixel's centre, one pixel off every border.
float sampleAt(const std::vector<float>& grey, int width, float x, float y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float s = x - static_cast<float>(column);
  const float t = y - static_cast<float>(row);
  const float* p = &grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(column)];
  const float upper = p[0] + s * (p[1] - p[0]);
  const float lower = p[width] + s * (p[width + 1] - p[width]);
  return upper + t * (lower - upper);
}

}  // namespace

CameraEye::CameraEye(const CameraModel& camera, const Pose& wMc) : lens_(camera), wMc_(wMc) {}

GrayImage CameraEye::expose(Renderer& renderer, const SensorNoise& sensor, const ExposureKey& key,
                            const Window& window) {
  const Window plane = lens_.planeWindow(window);
  renderer.draw({wMc_, lens_.focalPx(), plane}, drawn_);
  toGrey(drawn_, grey_);
  blur(drawn_.width, drawn_.height, grey_, scratch_);
  GrayImage image(window.width, window.height);
  develop(sensor, key, window, plane, image);
  return image;
}

void CameraEye::develop(const SensorNoise& sensor, const ExposureKey& key, const Window& window,
                        const Window& plane, GrayImage& image) {
  samples_.resize(static_cast<std::size_t>(window.width));
  light_.resize(static_cast<std::size_t>(window.width));
  const auto left = static_cast<float>(plane.x);
  const auto top = static_cast<float>(plane.y);
  for (int y = 0; y < window.height; ++y) {
    lens_.row(window.x, window.y + y, samples_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const LensMap::Sample& s = samples_[i];
      light_[i] = s.light * sampleAt(grey_, plane.width, s.x - left, s.y - top);
    }
    sensor.expose(key, window.x, window.y + y, light_.data(), window.width, image.row(y));
  }
}

}  // namespace ringhook

#include "sim/camera_eye.h"

#include <algorithm>
#include <cmath>
#include <future>

namespace ringhook {
namespace {

constexpr float kGreyStep = 255.0F / Renderer::kWhite;

/// Rows 0 .. height - 1 by work(from, to), to excluded; of a large image both halves at once.
template <class Work>
void inHalves(int height, Work work) {
  constexpr int kLarge = 1024;  // below, starting a thread costs more than it saves
  if (height < kLarge) {
    work(0, height);
    return;
  }
  const int half = height / 2;
  std::future<void> upper = std::async(std::launch::async, work, 0, half);
  work(half, height);
  upper.get();
}

/// The lens's blur: weights 1 6 1 / 8 along both axes, a standard deviation of half a pixel.
/// The image's outermost pixels stay as they are.
void blur(int width, int height, std::vector<float>& grey, std::vector<float>& scratch) {
  scratch = grey;
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  inHalves(height, [&](int from_y, int to_y) {
    for (int y = from_y; y < to_y; ++y) {
      const float* from = &grey[at(0, y)];
      float* to = &scratch[at(0, y)];
      for (int x = 1; x < width - 1; ++x) {
        to[x] = 0.75F * from[x] + 0.125F * (from[x - 1] + from[x + 1]);
      }
    }
  });
  inHalves(height, [&](int from_y, int to_y) {
    for (int y = std::max(1, from_y); y < std::min(height - 1, to_y); ++y) {
      const float* above = &scratch[at(0, y - 1)];
      const float* from = &scratch[at(0, y)];
      const float* below = &scratch[at(0, y + 1)];
      float* to = &grey[at(0, y)];
      for (int x = 0; x < width; ++x) {
        to[x] = 0.75F * from[x] + 0.125F * (above[x] + below[x]);
      }
    }
  });
}

std::size_t indexOf(const Window& window, int x, int y) {
  return static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
         static_cast<std::size_t>(x - window.x);
}

/// The whole number below; the rest is exact, wherever the window starts.
int floorOf(float value) {
  const int whole = static_cast<int>(value);
  return whole - (value < static_cast<float>(whole) ? 1 : 0);
}

/// Bilinear interpolation at a place of the plane that lies one pixel off every border of `seen`.
float sampleAt(const std::vector<float>& grey, const Window& seen, float x, float y) {
  const int column = floorOf(x);
  const int row = floorOf(y);
  const float s = x - static_cast<float>(column);
  const float t = y - static_cast<float>(row);
  const float* p = &grey[indexOf(seen, column, row)];
  const float upper = p[0] + s * (p[1] - p[0]);
  const float lower = p[seen.width] + s * (p[seen.width + 1] - p[seen.width]);
  return upper + t * (lower - upper);
}

}  // namespace

CameraEye::CameraEye(const CameraModel& camera, const Pose& fMc)
    : lens_(camera),
      eye_{fMc, lens_.focalPx()},
      plane_(lens_.planeWindow({0, 0, camera.width, camera.height})) {}

void CameraEye::begin(const Window& window, const std::vector<Window>& moving) {
  window_ = window;
  seen_ = lens_.planeWindow(window);
  begun_ = false;
  moving_.clear();
  for (const Window& part : moving) {
    const Window inside = intersect(part, seen_);
    if (!inside.empty()) {
      moving_.push_back(inside);
    }
  }
}

void CameraEye::collect(Renderer& renderer, double weight) {
  if (!begun_) {
    drawWhole(renderer, weight);
    begun_ = true;
    return;
  }
  for (const Window& part : moving_) {
    addPart(renderer, part, weight);
  }
}

void CameraEye::drawWhole(Renderer& renderer, double weight) {
  renderer.drawGrey(eye_, plane_, seen_, drawn_);
  grey_.resize(drawn_.size());
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    grey_[i] = kGreyStep * static_cast<float>(drawn_[i]);
  }
  for (const Window& part : moving_) {
    for (int y = 0; y < part.height; ++y) {
      float* row = &grey_[indexOf(seen_, part.x, part.y + y)];
      for (int x = 0; x < part.width; ++x) {
        row[x] *= static_cast<float>(weight);
      }
    }
  }
}

void CameraEye::addPart(Renderer& renderer, const Window& part, double weight) {
  renderer.drawGrey(eye_, plane_, part, drawn_);
  const float step = kGreyStep * static_cast<float>(weight);
  for (int y = 0; y < part.height; ++y) {
    float* row = &grey_[indexOf(seen_, part.x, part.y + y)];
    const std::uint16_t* from = &drawn_[indexOf(part, part.x, part.y + y)];
    for (int x = 0; x < part.width; ++x) {
      row[x] += step * static_cast<float>(from[x]);
    }
  }
}

GrayImage CameraEye::develop(const SensorNoise& sensor, const ExposureKey& key) {
  blur(seen_.width, seen_.height, grey_, scratch_);
  GrayImage image(window_.width, window_.height);
  inHalves(window_.height, [&](int from_y, int to_y) {
    std::vector<LensMap::Sample> samples(static_cast<std::size_t>(window_.width));
    std::vector<float> light(samples.size());
    for (int y = from_y; y < to_y; ++y) {
      lens_.row(window_.x, window_.y + y, samples);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const LensMap::Sample& s = samples[i];
        light[i] = s.light * sampleAt(grey_, seen_, s.x, s.y);
      }
      sensor.expose(key, window_.x, window_.y + y, light.data(), window_.width, image.row(y));
    }
  });
  return image;
}

}  // namespace ringhook

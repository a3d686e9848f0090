#include "camera/replay_camera.h"

#include <utility>

#include "camera/replay_source.h"
#include "core/error.h"

namespace ringhook {
namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// An image without a place must fill the full image, one with a place must lie inside.
void checkFits(const Window& window, bool placed, const Window& full, const std::string& name) {
  const bool inside = intersect(window, full) == window;
  if (inside && (placed || window == full)) {
    return;
  }
  std::string place;
  if (placed) {
    place = " at column " + std::to_string(window.x) + ", row " + std::to_string(window.y);
  }
  throw InputError(name + " is " + sizeText(window.width, window.height) + place +
                   ", but the rig expects images of " + sizeText(full.width, full.height));
}

}  // namespace

ReplayStereoCamera::ReplayStereoCamera(Sequence sequence, int width, int height)
    : source_(sourceOfSequence(std::move(sequence))), full_{0, 0, width, height} {}

ReplayStereoCamera::ReplayStereoCamera(const std::string& left, const std::string& right,
                                       double rate_hz, int width, int height)
    : source_(sourceOfFiles(left, right, rate_hz)), full_{0, 0, width, height} {}

ReplayStereoCamera::~ReplayStereoCamera() = default;

Window ReplayStereoCamera::fullImage() const { return full_; }

void ReplayStereoCamera::setWindows(const Window& /*left*/, const Window& /*right*/) {}

void ReplayStereoCamera::setFrameRate(double rate_hz) {
  if (!(rate_hz > 0.0)) {
    throw DeviceError("a frame rate must be positive, not " + std::to_string(rate_hz) + " Hz");
  }
}

std::optional<StereoFrame> ReplayStereoCamera::grab(double /*timeout_s*/) {
  auto read = source_->next();
  if (!read) {
    return std::nullopt;
  }
  checkFits(read->frame.left_window, read->placed, full_, read->left_name);
  if (!read->frame.right.empty()) {
    checkFits(read->frame.right_window, read->placed, full_, read->right_name);
  }
  return std::move(read->frame);
}

bool ReplayStereoCamera::finished() const { return source_->finished(); }

std::size_t ReplayStereoCamera::expectedFrames() const { return source_->expectedFrames(); }

}  // namespace ringhook

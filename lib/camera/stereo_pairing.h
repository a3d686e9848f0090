#pragma once

/// \file
/// Which left and which right image belong together. Two cameras deliver on their own, late, and
/// sometimes not at all; both tell when they exposed. The images of one exposure are those whose
/// instants differ by less than a tolerance, and each camera delivers in order of time. So an image
/// stays alone for certain as soon as the other camera has delivered a later one: nothing waits for
/// a timeout, and no late image is paired with the wrong one.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "core/image.h"
#include "core/time.h"

namespace ringhook {

/// An image of one camera.
struct MonoFrame {
  Time time;  ///< mid-exposure, on the host's clock
  Window window;
  GrayImage image;  ///< pixels of `window`
};

class StereoPairing {
 public:
  /// \param tolerance_s largest difference of two instants of one exposure [s], positive.
  /// \param excused whether an image of that instant may stay alone without being a loss.
  explicit StereoPairing(
      double tolerance_s, std::function<bool(Time)> excused = [](Time) { return false; })
      : tolerance_s_(tolerance_s), excused_(std::move(excused)) {}

  void setTolerance(double tolerance_s) { tolerance_s_ = tolerance_s; }

  /// An image of the left (0) or right (1) camera, in the order of its time.
  void add(int side, MonoFrame frame);

  /// The oldest complete pair, left first; each is given once.
  [[nodiscard]] std::optional<std::pair<MonoFrame, MonoFrame>> take();

  /// Images that stayed alone, of the left (0) or right (1) camera; not the excused ones.
  [[nodiscard]] std::int64_t unpaired(int side) const { return unpaired_[side]; }
  /// Images of both that stayed alone and were excused.
  [[nodiscard]] std::int64_t excused() const { return excused_alone_; }

 private:
  /// More waiting images than this of one side mean that the other camera is silent.
  static constexpr std::size_t kMostWaiting = 64;

  void dropOldest(int side);

  double tolerance_s_;
  std::deque<MonoFrame> waiting_[2];
  std::function<bool(Time)> excused_;
  std::int64_t unpaired_[2] = {0, 0};
  std::int64_t excused_alone_ = 0;
};

}  // namespace ringhook

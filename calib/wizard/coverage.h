#pragma once

/// \file
/// What the pictures of a board show so far, and how to hold it next. A calibration knows a lens
/// only where a board was seen, tells focal length from distance only by tilted boards, and tells
/// distortion from perspective only by boards near and far (Zhang, PAMI 2000, section 5; Sturm and
/// Maybank, CVPR 1999, on what untilted boards leave open). Hence three counts: thirds of both
/// images in which points were seen, tilts, distances.

#include <array>
#include <string>

#include "calib/solve/stereo_problem.h"

namespace ringhook {

constexpr int kImageThirds = 9;  ///< of each image, row by row

enum class Tilt { kFlat, kLeftAway, kRightAway, kTopAway, kBottomAway };
constexpr int kTilts = 5;

/// From the cameras, all before the place where the hooks pass.
enum class Distance { kNear, kMiddle, kFar };
constexpr int kDistances = 3;

/// How one pair of pictures shows the board.
struct Appearance {
  std::array<std::array<bool, kImageThirds>, 2> thirds{};  ///< [left, right]: points seen there
  int centre_third = 4;                                    ///< of the left image
  Tilt tilt = Tilt::kFlat;                                 ///< flat: within 12 degrees
  double size = 0.0;  ///< side of the square that covers as much of the left image, per width
};

/// \param focal_px of the left camera, to a tenth or so [px].
Appearance appearanceOf(const StereoView& view, const Board& board, double focal_px);

struct Coverage {
  int pairs = 0;
  std::array<std::array<int, kImageThirds>, 2> thirds{};  ///< pairs with points there
  std::array<int, kImageThirds> centres{};                ///< of the board, in the left image
  std::array<int, kTilts> tilts{};
  double smallest = 0.0;  ///< size
  double largest = 0.0;

  void add(const Appearance& seen);
  /// What is still missing, as a sentence for the integrator; empty if nothing is.
  [[nodiscard]] std::string lacking() const;
  /// Both images as three rows of three counts, side by side, and the tilts.
  [[nodiscard]] std::string drawing() const;
};

/// How to hold the board.
struct Hold {
  int third = 4;  ///< of the left image, for the board's centre
  Tilt tilt = Tilt::kFlat;
  Distance distance = Distance::kMiddle;
};

/// What would add most to the coverage.
Hold nextHold(const Coverage& coverage);

/// "upper left of the picture, its top edge tilted away by about 30 degrees, near".
std::string words(const Hold& hold);

/// That board in the left camera, c1Mt, for cameras that stand about as `rough` says: moved
/// towards the middle until both images show the whole board. Precondition: two cameras.
Pose heldPose(const Hold& hold, const StereoRig& rough, const Board& board);

}  // namespace ringhook

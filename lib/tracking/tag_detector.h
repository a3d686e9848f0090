#pragma once

/// \file
/// AprilTag 3 behind a fence: grey images in, corners in the project's pixel convention out.
/// The detector puts the centre of the first pixel at (0.5, 0.5); half a pixel is subtracted here
/// and nowhere else. Corners are used as the detector fits them (lines through the gradient of the
/// black square's sides); a further corner refinement makes them worse.
/// Source: Wang and Olson, "AprilTag 2: efficient and robust fiducial detection", IROS 2016.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"

namespace ringhook {

struct TagDetection {
  int id = 0;                    ///< number of the code within its family
  int hamming = 0;               ///< corrected bits
  double decision_margin = 0.0;  ///< mean distance of the bits from the decision [grey levels]
  /// Corners of the black square in the image given [px]: upper left, upper right, lower right,
  /// lower left as one reads the upright tag.
  std::array<Eigen::Vector2d, 4> corners;
};

class TagDetector {
 public:
  /// \param family a family that tagFamilySize() knows; anything else throws InputError.
  /// \param threads of the detector, at least 1.
  TagDetector(const std::string& family, int threads, bool refine_edges);
  ~TagDetector();
  TagDetector(const TagDetector&) = delete;
  TagDetector& operator=(const TagDetector&) = delete;

  /// All tags of the family within `region` of the image [px]; corners are coordinates of the
  /// whole image. `decimate` reduces the image for the search of squares, 1 means not.
  std::vector<TagDetection> detect(const GrayImage& image, const Window& region, double decimate);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook

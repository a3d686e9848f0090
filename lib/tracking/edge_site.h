#pragma once

/// \file
/// Where exactly an image edge crosses the normal of a model line. The moving-edge search works in
/// whole pixels; here the gradient across the line, averaged over three pixels along it, is sampled
/// around the site and the vertex of the parabola through its peak is taken (Devernay, "A
/// non-maxima suppression method for edge detection with sub-pixel accuracy", INRIA RR-2724, 1995).

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/pinhole_view.h"

namespace ringhook {

/// A straight line in the image: normal . pixel = offset.
struct ImageLine {
  Eigen::Vector2d normal;  ///< of length 1
  double offset = 0.0;     ///< [px]

  [[nodiscard]] double distance(const Eigen::Vector2d& pixel) const {
    return normal.dot(pixel) - offset;
  }
};

/// Image of a model edge under a pose; nothing if an end lies behind or the line shrinks to a
/// point.
std::optional<ImageLine> projectEdge(const PinholeView& camera, const Pose& c1Mo,
                                     const Eigen::Vector3d& start_o, const Eigen::Vector3d& end_o);

struct RefinedSite {
  Eigen::Vector2d pixel;   ///< sub-pixel position [px]
  double contrast = 0.0;   ///< gradient across the line [grey levels per pixel]
  double direction = 0.0;  ///< angle between the image gradient and the normal, 0..pi/2 [rad]
};

/// Looks within `reach_px` of `pixel` along `normal`. Nothing if there is no peak inside, if it is
/// weaker than `least_contrast` [grey levels per pixel] or if the window ends too near.
std::optional<RefinedSite> refineAcross(const GrayImage& image, const Window& window,
                                        const Eigen::Vector2d& pixel, const Eigen::Vector2d& normal,
                                        int reach_px, double least_contrast);

/// 1.4826 times the median of absolute values: standard deviation of the good majority.
double robustSigma(std::vector<double> values);

}  // namespace ringhook

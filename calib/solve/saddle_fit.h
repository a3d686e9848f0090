#pragma once

/// \file
/// Where four squares of a chessboard meet, by explaining every pixel around it:
///   I(p) = a + b . p + c s(n1 . (p - q)) s(n2 . (p - q)),   s(d) = erf(d / (sqrt(2) w)),
/// two straight edges through the corner q with normals n1, n2, blurred by w, between light and
/// dark, on a shading that may slope. Least squares over the window is maximum likelihood for noise
/// that is alike in all pixels, and so comes to the least variance that the pixels allow
/// (Cramer-Rao); cornerSubPix, which only asks gradients to point past the corner, has a multiple
/// of it. The model is symmetric about q, as such a corner is under any perspective, blur and
/// response curve: what of it is wrong does not move the corner. Of the model-based kind of
/// Sinzinger ("A model-based approach to junction detection using radial energy", Pattern
/// Recognition 41, 2008).

#include <Eigen/Core>
#include <optional>

#include "core/image.h"

namespace ringhook {

/// The corner near `start` [px], or nothing if the window shows no such corner.
/// \param half_side of the window [px]; pixels outside the image are left out.
std::optional<Eigen::Vector2d> fitSaddle(const GrayImage& image, const Eigen::Vector2d& start,
                                         int half_side);

}  // namespace ringhook

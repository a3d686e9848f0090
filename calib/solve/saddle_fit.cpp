#include "calib/solve/saddle_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/grey_between.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
// Corner x, y from the patch's middle; angles of both normals; logarithm of the blur; grey in the
// middle, its slopes in x and y; contrast.
using Parameters = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

constexpr int kRing = 64;              // directions looked at for the edges
constexpr double kRingShare = 0.75;    // radius of that ring, of the window's half side
constexpr double kStartBlur_px = 0.8;  // of lenses in focus
constexpr double kFlat = 4.0;          // blurs from an edge beyond which grey does not change
constexpr int kSteps = 30;
constexpr double kSettled_px = 1e-4;
constexpr double kFarthest_px = 1.5;       // from a start that is right to a fraction of a pixel
constexpr double kLeastContrast = 4.0;     // half of dark to light [grey levels]
constexpr double kLeastSine = 0.26;        // of the angle between the edges
constexpr double kLargestResidual = 0.35;  // RMS, of the contrast

struct Patch {
  Vector2d middle;               // a whole pixel
  std::vector<Vector2d> pixels;  // from there
  std::vector<double> grey;
};

Patch patchAround(const GrayImage& image, const Vector2d& start, int half_side) {
  const int middle_x = static_cast<int>(std::lround(start.x()));
  const int middle_y = static_cast<int>(std::lround(start.y()));
  const Window window =
      intersect({middle_x - half_side, middle_y - half_side, 2 * half_side + 1, 2 * half_side + 1},
                {0, 0, image.width, image.height});
  Patch patch{Vector2d(middle_x, middle_y), {}, {}};
  for (int y = window.y; y < window.y + window.height; ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = window.x; x < window.x + window.width; ++x) {
      patch.pixels.emplace_back(x - middle_x, y - middle_y);
      patch.grey.push_back(row[x]);
    }
  }
  return patch;
}

// Beyond the image's border as at it.
double greyAt(const GrayImage& image, const Vector2d& at) {
  constexpr double kBefore = 1.0 + 1e-9;  // the last pixel has none behind it
  return greyBetween(image, std::clamp(at.x(), 0.0, image.width - kBefore),
                     std::clamp(at.y(), 0.0, image.height - kBefore));
}

// Angles of the two edges, where the grey on a ring about the corner passes its mean.
std::optional<std::array<double, 2>> edgesAcross(const GrayImage& image, const Vector2d& corner,
                                                 double radius) {
  std::array<double, kRing> grey{};
  double mean = 0.0;
  for (int i = 0; i < kRing; ++i) {
    const double angle = 2.0 * M_PI * i / kRing;
    grey.at(static_cast<std::size_t>(i)) =
        greyAt(image, corner + radius * Vector2d(std::cos(angle), std::sin(angle)));
    mean += grey.at(static_cast<std::size_t>(i)) / kRing;
  }
  std::vector<double> passes;
  for (std::size_t i = 0; i < kRing; ++i) {
    const double here = grey.at(i) - mean;
    const double next = grey.at((i + 1) % kRing) - mean;
    if ((here < 0.0) != (next < 0.0)) {
      passes.push_back(2.0 * M_PI * (static_cast<double>(i) + here / (here - next)) / kRing);
    }
  }
  if (passes.size() != 4) {
    return std::nullopt;
  }
  return std::array{0.5 * (passes[0] + passes[2] - M_PI), 0.5 * (passes[1] + passes[3] - M_PI)};
}

struct Step {
  double value;  // s(d)
  double slope;  // ds/dd
};

Step blurred(double d, double blur) {
  const double z = d / blur;
  if (std::abs(z) > kFlat) {
    return {z > 0.0 ? 1.0 : -1.0, 0.0};
  }
  return {std::erf(z / M_SQRT2), std::sqrt(2.0 / M_PI) * std::exp(-0.5 * z * z) / blur};
}

// The normal equations H d = -g at p, and the sum of squares.
struct Normal {
  Matrix9 H = Matrix9::Zero();
  Parameters g = Parameters::Zero();
  double cost = 0.0;
};

// Most pixels lie flat between the edges and move the last four parameters only.
Normal explain(const Patch& patch, const Parameters& p) {
  const double blur = std::exp(p[4]);
  const Vector2d n1(std::cos(p[2]), std::sin(p[2]));
  const Vector2d n2(std::cos(p[3]), std::sin(p[3]));
  Normal normal;
  Eigen::Matrix4d H_flat = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < patch.grey.size(); ++i) {
    const Vector2d& from_middle = patch.pixels[i];
    const Vector2d r = from_middle - p.head<2>();
    const double d1 = n1.dot(r);
    const double d2 = n2.dot(r);
    const Step s1 = blurred(d1, blur);
    const Step s2 = blurred(d2, blur);
    const Eigen::Vector4d by_grey(1.0, from_middle.x(), from_middle.y(), s1.value * s2.value);
    const double e = by_grey.dot(p.tail<4>()) - patch.grey[i];
    normal.cost += e * e;
    if (s1.slope == 0.0 && s2.slope == 0.0) {
      H_flat += by_grey * by_grey.transpose();
      normal.g.tail<4>() += e * by_grey;
      continue;
    }
    const double by1 = p[8] * s1.slope * s2.value;
    const double by2 = p[8] * s1.value * s2.slope;
    Parameters J;
    J << -by1 * n1 - by2 * n2, by1 * (n1.x() * r.y() - n1.y() * r.x()),
        by2 * (n2.x() * r.y() - n2.y() * r.x()), -by1 * d1 - by2 * d2, by_grey;
    normal.H += J * J.transpose();
    normal.g += e * J;
  }
  normal.H.bottomRightCorner<4, 4>() += H_flat;
  return normal;
}

// Levenberg-Marquardt; nothing where it does not settle.
std::optional<Normal> minimise(const Patch& patch, Parameters& p) {
  Normal here = explain(patch, p);
  double damping = 1e-3;
  for (int step = 0; step < kSteps; ++step) {
    Matrix9 damped = here.H;
    damped.diagonal() *= 1.0 + damping;
    const Parameters d = -damped.ldlt().solve(here.g);
    const Normal next = explain(patch, p + d);
    if (next.cost < here.cost) {
      p += d;
      here = next;
      damping *= 0.1;
    } else {
      damping *= 10.0;
    }
    if (d.head<2>().norm() < kSettled_px) {
      return here;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vector2d> fitSaddle(const GrayImage& image, const Vector2d& start, int half_side) {
  const Patch patch = patchAround(image, start, half_side);
  if (image.width < 2 || image.height < 2 || patch.grey.empty()) {
    return std::nullopt;
  }
  const auto edges = edgesAcross(image, start, kRingShare * half_side);
  if (!edges) {
    return std::nullopt;
  }
  const auto [dark, light] = std::minmax_element(patch.grey.begin(), patch.grey.end());
  Parameters p;
  p << start - patch.middle, (*edges)[0] + M_PI_2, (*edges)[1] + M_PI_2, std::log(kStartBlur_px),
      0.5 * (*dark + *light), 0.0, 0.0, 0.0;
  // The contrast's sign: which of the two pairs of opposite squares is the light one.
  const double half = 0.4 * (*light - *dark);
  Parameters turned = p;
  p[8] = half;
  turned[8] = -half;
  if (explain(patch, turned).cost < explain(patch, p).cost) {
    p = turned;
  }
  const auto least = minimise(patch, p);
  if (!least) {
    return std::nullopt;
  }
  const double rms = std::sqrt(least->cost / static_cast<double>(patch.grey.size()));
  const Vector2d corner = patch.middle + p.head<2>();
  const bool plausible =
      std::abs(p[8]) > kLeastContrast && std::abs(std::sin(p[2] - p[3])) > kLeastSine &&
      rms < kLargestResidual * std::abs(p[8]) && (corner - start).norm() < kFarthest_px;
  return plausible ? std::optional(corner) : std::nullopt;
}

}  // namespace ringhook

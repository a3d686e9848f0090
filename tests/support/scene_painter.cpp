#include "tests/support/scene_painter.h"

#include <algorithm>
#include <cmath>

namespace ringhook::test {
namespace {

/// Part of a pixel that a figure covers, and the grey level that it adds. Where the four outer
/// rays agree, so do the rest: figures are wider than a pixel.
struct Covered {
  double part = 0.0;
  double grey = 0.0;
};

Covered cover(const Eigen::Matrix3d& pixel_to_plane, int u, int v, const Figure& figure) {
  const auto greyAt = [&](int k) {
    const Eigen::Vector3d ray(u - 0.375 + 0.25 * (k % 4), v - 0.375 + 0.25 * (k / 4), 1.0);
    const Eigen::Vector3d hit = pixel_to_plane * ray;
    return figure(hit.x() / hit.z(), hit.y() / hit.z());
  };
  Covered covered;
  const double first = greyAt(0);
  if (greyAt(3) == first && greyAt(12) == first && greyAt(15) == first) {
    return first < 0.0 ? covered : Covered{1.0, first};
  }
  for (int k = 0; k < 16; ++k) {
    const double grey = greyAt(k);
    if (grey >= 0.0) {
      covered.part += 1.0 / 16.0;
      covered.grey += grey / 16.0;
    }
  }
  return covered;
}

}  // namespace

void paint(RectifiedView& view, const Pose& c1Mplane, const Eigen::Vector2d& half_size,
           const Figure& figure) {
  const PinholeView& cam = view.camera;
  const Pose cMplane = cam.cMc1 * c1Mplane;
  Eigen::Matrix3d K;
  K << cam.fx, 0, cam.cx, 0, cam.fy, cam.cy, 0, 0, 1;
  Eigen::Matrix3d plane_to_pixel;
  plane_to_pixel << cMplane.linear().leftCols<2>(), cMplane.translation();
  plane_to_pixel = K * plane_to_pixel;
  const Eigen::Matrix3d pixel_to_plane = plane_to_pixel.inverse();
  Eigen::Vector2d low(1e9, 1e9);
  Eigen::Vector2d high(-1e9, -1e9);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner(i % 2 ? half_size.x() : -half_size.x(),
                                 i / 2 ? half_size.y() : -half_size.y(), 1.0);
    const Eigen::Vector2d pixel = (plane_to_pixel * corner).hnormalized();
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const Window& w = view.window;
  for (int v = std::max(w.y, static_cast<int>(low.y()) - 1);
       v <= std::min(w.y + w.height - 1, static_cast<int>(high.y()) + 1); ++v) {
    for (int u = std::max(w.x, static_cast<int>(low.x()) - 1);
         u <= std::min(w.x + w.width - 1, static_cast<int>(high.x()) + 1); ++u) {
      const Covered covered = cover(pixel_to_plane, u, v, figure);
      std::uint8_t& pixel = view.image.row(v - w.y)[u - w.x];
      pixel = static_cast<std::uint8_t>(std::lround((1.0 - covered.part) * pixel + covered.grey));
    }
  }
}

Figure polygon(std::vector<Eigen::Vector2d> corners, double grey) {
  return [corners = std::move(corners), grey](double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const Eigen::Vector2d& a = corners[i];
      const Eigen::Vector2d& b = corners[j];
      if ((a.y() > y) != (b.y() > y) &&
          x < (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x()) {
        inside = !inside;
      }
    }
    return inside ? grey : -1.0;
  };
}

void addNoise(GrayImage& image, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, sigma);
  for (std::uint8_t& pixel : image.pixels) {
    pixel = static_cast<std::uint8_t>(std::clamp(std::lround(pixel + noise(random)), 0L, 255L));
  }
}

RectifiedFrame emptyPair(std::uint8_t grey) {
  RectifiedFrame frame;
  for (int side = 0; side < 2; ++side) {
    PinholeView camera{2500.0, 2500.0, side == 0 ? 823.5 : 1223.5, 1023.5, 2048, 2048};
    camera.cMc1.translation() = Eigen::Vector3d(side == 0 ? 0.0 : -0.4, 0.0, 0.0);
    frame.views.push_back({camera, {0, 0, 2048, 2048}, GrayImage(2048, 2048, grey)});
  }
  return frame;
}

Pose pairPose() {
  Pose fMc1 = Pose::Identity();
  fMc1.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;  // x_c = y_f, y_c = -z_f, z_c = -x_f
  fMc1.translation() = Eigen::Vector3d(1.75, -0.2, 0.70);
  return fMc1;
}

}  // namespace ringhook::test

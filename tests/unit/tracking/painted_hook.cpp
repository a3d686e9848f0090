#include "tests/unit/tracking/painted_hook.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace ringhook::test {
namespace {

/// The J and the shank up to the pivot, in (y_o, -z_o), after doc/frames.md.
std::vector<Eigen::Vector2d> barOutline() {
  std::vector<Eigen::Vector2d> corners{{-0.041, -0.400}};
  constexpr int kPieces = 16;  // as the model's chords
  const auto arc = [&](double radius, bool back) {
    for (int i = 0; i <= kPieces; ++i) {
      const double turn = std::numbers::pi * (back ? kPieces - i : i) / kPieces;
      const double r = radius;
      corners.emplace_back(-r * std::cos(turn), r * std::sin(turn));
    }
  };
  arc(0.041, false);
  corners.emplace_back(0.041, -0.025);
  corners.emplace_back(0.029, -0.025);
  arc(0.029, true);
  corners.emplace_back(-0.029, -0.400);
  return corners;
}

}  // namespace

Pose planeInHook(double depth_m) {
  Pose oMplane = Pose::Identity();
  oMplane.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  oMplane.translation() = Eigen::Vector3d(depth_m, 0.0, 0.0);
  return oMplane;
}

void paintHook(RectifiedFrame& frame, const Pose& c1Mo, double bar_grey, double plate_grey) {
  const Figure bar = polygon(barOutline(), bar_grey);
  const Figure plate =
      polygon({{-0.062, -0.254}, {-0.008, -0.254}, {-0.008, -0.146}, {-0.062, -0.146}}, plate_grey);
  for (RectifiedView& view : frame.views) {
    paint(view, c1Mo * planeInHook(0.003), {0.07, 0.41}, bar);
    paint(view, c1Mo * planeInHook(0.005), {0.07, 0.26}, plate);
  }
}

void paintTags(RectifiedFrame& frame, const TagPlate& plate, const Pose& c1Mo) {
  apriltag_family_t* family = tag36h11_create();
  for (const PlateTag& tag : plate.tags) {
    image_u8_t* code = apriltag_to_image(family, static_cast<std::uint32_t>(tag.id));
    const double cell = tag.size_m / family->width_at_border;
    const double half = cell * family->total_width / 2.0;
    const Figure figure = [&](double x, double y) {
      const int column = static_cast<int>(std::floor((x + half) / cell));
      const int row = static_cast<int>(std::floor((y + half) / cell));
      const bool on = column >= 0 && row >= 0 && column < code->width && row < code->height;
      return on ? 40.0 + 170.0 * code->buf[row * code->stride + column] / 255.0 : -1.0;
    };
    for (RectifiedView& view : frame.views) {
      paint(view, c1Mo * plate.oMk * tag.kMtag, {half, half}, figure);
    }
    std::free(code->buf);
    std::free(code);
  }
  tag36h11_destroy(family);
}

void cutWindows(RectifiedFrame& frame, const Eigen::Vector3d& centre_c1, int width, int height) {
  for (RectifiedView& view : frame.views) {
    const Eigen::Vector2d centre = view.camera.project(centre_c1).value();
    const Window wanted{static_cast<int>(centre.x()) - width / 2,
                        static_cast<int>(centre.y()) - height / 2, width, height};
    const Window part = intersect(wanted, view.window);
    GrayImage image(part.width, part.height);
    for (int y = 0; y < part.height; ++y) {
      const std::uint8_t* from = view.image.row(part.y - view.window.y + y);
      std::copy_n(from + (part.x - view.window.x), part.width, image.row(y));
    }
    view.image = std::move(image);
    view.window = part;
  }
}

}  // namespace ringhook::test

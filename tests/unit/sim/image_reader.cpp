#include "image_reader.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

namespace ringhook {
std::map<int, std::vector<Eigen::Vector2d>> readTags(GrayImage image) {
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  detector->quad_decimate = 1.0F;
  image_u8_t view{image.width, image.height, image.width, image.pixels.data()};
  zarray_t* found = apriltag_detector_detect(detector, &view);
  std::map<int, std::vector<Eigen::Vector2d>> tags;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* tag = nullptr;
    zarray_get(found, i, &tag);
    // The detector starts at the lower left and goes round towards the lower right.
    for (const int corner : {3, 2, 1, 0}) {
      tags[tag->id].emplace_back(tag->p[corner][0] - 0.5, tag->p[corner][1] - 0.5);
    }
  }
  apriltag_detections_destroy(found);
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
  return tags;
}

double greyAt(const GrayImage& image, const Eigen::Vector2d& at) {
  const auto x = static_cast<int>(at.x());
  const auto y = static_cast<int>(at.y());
  const double s = at.x() - x;
  const double t = at.y() - y;
  const std::uint8_t* upper = image.row(y) + x;
  const std::uint8_t* lower = image.row(y + 1) + x;
  return (1.0 - t) * ((1.0 - s) * upper[0] + s * upper[1]) +
         t * ((1.0 - s) * lower[0] + s * lower[1]);
}

double edgeOffset(const GrayImage& image, const Eigen::Vector2d& at,
                  const Eigen::Vector2d& normal) {
  constexpr double kReach = 4.0;
  constexpr int kSteps = 160;
  const double inner = greyAt(image, at - kReach * normal);
  const double outer = greyAt(image, at + kReach * normal);
  double area = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = kReach * (2.0 * (i + 0.5) / kSteps - 1.0);
    area += (greyAt(image, at + t * normal) - outer) / (inner - outer) * 2.0 * kReach / kSteps;
  }
  return area - kReach;
}

}  // namespace ringhook

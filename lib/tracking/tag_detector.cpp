#include "tracking/tag_detector.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
}

#include <algorithm>

#include "core/error.h"

namespace ringhook {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

const Family& familyNamed(const std::string& name) {
  static const std::array<Family, 3> known{Family{"tag36h11", tag36h11_create, tag36h11_destroy},
                                           Family{"tag25h9", tag25h9_create, tag25h9_destroy},
                                           Family{"tag16h5", tag16h5_create, tag16h5_destroy}};
  const auto at = std::find_if(known.begin(), known.end(), [&](auto& f) { return f.name == name; });
  if (at == known.end()) {
    throw InputError("tag family '" + name +
                     "' is unknown, one of tag36h11, tag25h9, tag16h5 expected");
  }
  return *at;
}

TagDetection convert(const apriltag_detection_t& raw, const Window& region) {
  TagDetection tag;
  tag.id = raw.id;
  tag.hamming = raw.hamming;
  tag.decision_margin = static_cast<double>(raw.decision_margin);
  // The detector's order: lower left, lower right, upper right, upper left.
  const std::array<int, 4> order{3, 2, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double* p = raw.p[order[i]];
    tag.corners[i] = Eigen::Vector2d(p[0] - 0.5 + region.x, p[1] - 0.5 + region.y);
  }
  return tag;
}

}  // namespace

struct TagDetector::Impl {
  explicit Impl(const std::string& name) : family(familyNamed(name)) {
    codes.reset(family.create());
    apriltag_detector_add_family(detector.get(), codes.get());
  }

  struct DeleteDetector {
    void operator()(apriltag_detector_t* d) const { apriltag_detector_destroy(d); }
  };
  const Family& family;
  std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> codes{nullptr, family.destroy};
  std::unique_ptr<apriltag_detector_t, DeleteDetector> detector{apriltag_detector_create()};
};

TagDetector::TagDetector(const std::string& family, int threads, bool refine_edges)
    : impl_(std::make_unique<Impl>(family)) {
  impl_->detector->nthreads = std::max(1, threads);
  impl_->detector->refine_edges = refine_edges;
}

TagDetector::~TagDetector() = default;

std::vector<TagDetection> TagDetector::detect(const GrayImage& image, const Window& region,
                                              double decimate) {
  const Window part = intersect(region, {0, 0, image.width, image.height});
  constexpr int kSmallest = 16;  // Below this the detector's tiles do not fit [px].
  if (part.width < kSmallest || part.height < kSmallest) {
    return {};
  }
  impl_->detector->quad_decimate = static_cast<float>(decimate);
  // The detector only reads from the image, though its interface does not say const.
  auto* first = const_cast<std::uint8_t*>(image.row(part.y)) + part.x;
  image_u8_t view{part.width, part.height, image.width, first};
  zarray_t* found = apriltag_detector_detect(impl_->detector.get(), &view);
  std::vector<TagDetection> tags;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* raw = nullptr;
    zarray_get(found, i, &raw);
    tags.push_back(convert(*raw, part));
  }
  apriltag_detections_destroy(found);
  return tags;
}

}  // namespace ringhook

#include "tracking/marker_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "tracking/plate_pose.h"
#include "tracking/tag_detector.h"

namespace ringhook {
namespace {

/// Corners whose common pose leaves more than this are not one rigid plate [px].
constexpr double kContradiction = 3.0;

void check(const TagPlate& plate, const MarkerTrackerOptions& options) {
  if (plate.tags.empty()) {
    throw InputError("tag plate: 'layout' must hold at least one tag");
  }
  if (!(options.quad_decimate >= 1.0) || options.threads < 1 || options.max_hamming < 0 ||
      !(options.corner_sigma_px > 0.0)) {
    throw InputError(
        "marker tracker: quad_decimate >= 1, threads >= 1, max_hamming >= 0 and "
        "corner_sigma_px > 0 expected");
  }
}

double perimeter(const TagDetection& tag) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += (tag.corners[i] - tag.corners[(i + 1) % 4]).norm();
  }
  return sum;
}

/// Bounding box of the tags, grown by half a tag (the white border and some background).
Window around(const std::vector<TagDetection>& tags) {
  Eigen::Vector2d low = tags.front().corners[0];
  Eigen::Vector2d high = low;
  double margin = 0.0;
  for (const TagDetection& tag : tags) {
    for (const Eigen::Vector2d& corner : tag.corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    margin = std::max(margin, 8.0 + perimeter(tag) / 8.0);
  }
  const int x0 = static_cast<int>(std::floor(low.x() - margin));
  const int y0 = static_cast<int>(std::floor(low.y() - margin));
  const int x1 = static_cast<int>(std::ceil(high.x() + margin));
  const int y1 = static_cast<int>(std::ceil(high.y() + margin));
  return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

bool insideImage(const TagDetection& tag, const GrayImage& image) {
  const Window whole{0, 0, image.width, image.height};
  return std::all_of(tag.corners.begin(), tag.corners.end(),
                     [&](const Eigen::Vector2d& c) { return whole.contains(c.x(), c.y()); });
}

}  // namespace

struct MarkerTracker::Impl {
  Impl(TagPlate p, const MarkerTrackerOptions& o)
      : plate(std::move(p)), options(o), detector(plate.family, o.threads, o.refine_edges) {}

  /// Believable tags of the plate, one per id. An id seen twice is believed only where one of the
  /// two is clearly the better decoding.
  [[nodiscard]] std::vector<TagDetection> believable(std::vector<TagDetection> tags,
                                                     const GrayImage& image) const {
    std::erase_if(tags, [&](const TagDetection& t) {
      return plate.find(t.id) == nullptr || t.hamming > options.max_hamming ||
             t.decision_margin < options.min_decision_margin || !insideImage(t, image);
    });
    std::sort(tags.begin(), tags.end(), [](auto& a, auto& b) {
      return std::pair(a.id, -a.decision_margin) < std::pair(b.id, -b.decision_margin);
    });
    std::vector<TagDetection> unique;
    for (std::size_t i = 0; i < tags.size();) {
      std::size_t next = i + 1;
      while (next < tags.size() && tags[next].id == tags[i].id) {
        ++next;
      }
      if (next == i + 1 || tags[i].decision_margin > 1.5 * tags[i + 1].decision_margin) {
        unique.push_back(tags[i]);
      }
      i = next;
    }
    return unique;
  }

  std::vector<TagDetection> detect(const GrayImage& image) {
    const Window whole{0, 0, image.width, image.height};
    const double pixels = static_cast<double>(image.width) * image.height;
    const bool large = pixels > options.full_size_pixels && options.quad_decimate > 1.0;
    const double decimate = large ? options.quad_decimate : 1.0;
    std::vector<TagDetection> tags = believable(detector.detect(image, whole, decimate), image);
    if (!large || tags.empty()) {
      return tags;
    }
    return believable(detector.detect(image, around(tags), 1.0), image);
  }

  CameraFeatures see(const RectifiedView& view) {
    CameraFeatures seen;
    seen.camera = view.camera;
    for (const TagDetection& tag : detect(view.image)) {
      const auto corners = tagCorners(plate, *plate.find(tag.id));
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d pixel =
            tag.corners[i] + Eigen::Vector2d(view.window.x, view.window.y);
        seen.corners.push_back({corners[i], pixel, options.corner_sigma_px});
      }
    }
    return seen;
  }

  TagPlate plate;
  MarkerTrackerOptions options;
  TagDetector detector;
};

MarkerTracker::MarkerTracker(TagPlate plate, const MarkerTrackerOptions& options) {
  check(plate, options);
  impl_ = std::make_unique<Impl>(std::move(plate), options);
}

MarkerTracker::~MarkerTracker() = default;

Outcome<HookView> MarkerTracker::track(const RectifiedFrame& frame,
                                       const std::optional<Pose>& c1Mo_predicted) {
  HookView view;
  view.time = frame.time;
  for (const RectifiedView& rectified : frame.views) {
    CameraFeatures seen = impl_->see(rectified);
    if (!seen.corners.empty()) {
      view.cameras.push_back(std::move(seen));
    }
  }
  if (view.cameras.empty()) {
    return Refusal{"no tag seen"};
  }
  const std::optional<Pose> start = startPose(view.cameras, c1Mo_predicted);
  if (!start || !(cornerRms(view.cameras, *start) < kContradiction)) {
    return Refusal{"tags contradict each other"};
  }
  view.c1Mo_start = *start;
  return view;
}

}  // namespace ringhook

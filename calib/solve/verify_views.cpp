#include "calib/solve/verify_views.h"

#include <algorithm>
#include <map>

#include "camera/image_file.h"
#include "core/error.h"
#include "tracking/tag_detector.h"

namespace ringhook {
namespace {

using TagCorners = std::array<Eigen::Vector2d, 4>;

/// Tags of the plate in one image, in pixels of the full image.
std::map<int, TagCorners> tagsIn(const std::filesystem::path& file, const SequenceFrame& frame,
                                 bool right, const StereoRig& rig, const TagPlate& plate,
                                 TagDetector& detector) {
  const GrayImage image = readGrayImage(file);
  const Eigen::Vector2i offset(right ? frame.right_x_px : frame.left_x_px,
                               right ? frame.right_y_px : frame.left_y_px);
  const bool whole = image.width == rig.left.width && image.height == rig.left.height;
  if (!whole && (!frame.placed || offset.x() + image.width > rig.left.width ||
                 offset.y() + image.height > rig.left.height)) {
    throw InputError(file.string() + ": the image is " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + " px, expected the rig's " +
                     std::to_string(rig.left.width) + "x" + std::to_string(rig.left.height) +
                     " px or a window in it");
  }
  std::map<int, TagCorners> tags;
  for (const TagDetection& tag :
       detector.detect(image, Window{0, 0, image.width, image.height}, 1.0)) {
    if (tag.hamming == 0 && plate.find(tag.id) != nullptr) {
      TagCorners corners = tag.corners;
      for (Eigen::Vector2d& corner : corners) {
        corner += offset.cast<double>();
      }
      tags[tag.id] = corners;
    }
  }
  return tags;
}

SightedView sightFrame(const SequenceFrame& frame, const StereoRig& rig, const TagPlate& plate,
                       TagDetector& detector) {
  SightedView view{frame.left.filename().string(), {}, {}, {}};
  const auto left = tagsIn(frame.left, frame, false, rig, plate, detector);
  const auto right = tagsIn(frame.right, frame, true, rig, plate, detector);
  for (const auto& [id, corners] : left) {
    const auto other = right.find(id);
    if (other == right.end()) {
      continue;
    }
    const auto points_t = tagCorners(plate, *plate.find(id));
    view.points_t.insert(view.points_t.end(), points_t.begin(), points_t.end());
    view.left_px.insert(view.left_px.end(), corners.begin(), corners.end());
    view.right_px.insert(view.right_px.end(), other->second.begin(), other->second.end());
  }
  return view;
}

}  // namespace

std::vector<SightedView> sightPlate(const Sequence& sequence, const StereoRig& rig, TagPlate plate,
                                    std::size_t most, const StepHook& hook) {
  plate.oMk = Pose::Identity();
  TagDetector detector(plate.family, 1, true);
  const std::size_t count = std::min(most, sequence.frames.size());
  std::vector<SightedView> views;
  for (std::size_t i = 0; i < count; ++i) {
    hook(static_cast<double>(i) / static_cast<double>(count), "frame " + std::to_string(i + 1));
    const SequenceFrame& frame = sequence.frames[i * sequence.frames.size() / count];
    if (frame.right.empty()) {
      throw InputError(frame.left.string() + ": the sequence has one camera, expected two");
    }
    const SightedView view = sightFrame(frame, rig, plate, detector);
    if (view.points_t.size() >= 4) {
      views.push_back(view);
    }
  }
  return views;
}

BarEnds barBetween(TagPlate plate, int id_a, int id_b) {
  plate.oMk = Pose::Identity();
  const auto cornersOf = [&](int id) {
    const PlateTag* tag = plate.find(id);
    if (tag == nullptr) {
      throw InputError("--bar: the plate has no tag " + std::to_string(id));
    }
    const auto corners = tagCorners(plate, *tag);
    return std::vector<Eigen::Vector3d>(corners.begin(), corners.end());
  };
  BarEnds bar{cornersOf(id_a), cornersOf(id_b)};
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    along += 0.25 * (bar.a_t[i] - bar.b_t[i]);
  }
  bar.known_m = along.norm();
  if (!(bar.known_m > 0.0)) {
    throw InputError("--bar: expected two different tags");
  }
  return bar;
}

}  // namespace ringhook

#include "calib/solve/plate_images.h"

#include "calib/solve/pose_table.h"
#include "camera/csv_table.h"
#include "camera/image_file.h"
#include "core/error.h"
#include "tracking/plate_pose.h"
#include "tracking/tag_detector.h"

namespace ringhook {
namespace {

GrayImage readOfSize(const std::filesystem::path& file, const CameraModel& camera) {
  GrayImage image = readGrayImage(file);
  if (image.width != camera.width || image.height != camera.height) {
    throw InputError(file.string() + ": the image is " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + " px, the rig's are " +
                     std::to_string(camera.width) + "x" + std::to_string(camera.height) + " px");
  }
  return image;
}

constexpr double kDecisionMargin = 25.0;  // weaker decodings are not believed [grey levels]
constexpr double kContradiction = 3.0;    // corners off their common pose by more are no plate [px]
constexpr double kCornerSigma = 0.1;      // a start; estimated from the views later [px]

// Corners as the detector fits them in the image as it is, moved by the exact lens model:
// resampling the image first would cost accuracy.
CameraFeatures see(const GrayImage& image, const CameraModel& camera, const Pose& cMc1,
                   const TagPlate& plate, TagDetector& detector) {
  CameraFeatures seen;
  const Eigen::Matrix3d& K = camera.K;
  seen.camera = {K(0, 0), K(1, 1), K(0, 2), K(1, 2), camera.width, camera.height, cMc1};
  for (const TagDetection& tag : detector.detect(image, {0, 0, image.width, image.height}, 1.0)) {
    const PlateTag* known = plate.find(tag.id);
    if (known == nullptr || tag.hamming > 1 || tag.decision_margin < kDecisionMargin) {
      continue;
    }
    const auto points = tagCorners(plate, *known);
    std::vector<CornerFeature> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (const auto ray = undistortPixel(camera, tag.corners[i])) {
        const Eigen::Vector2d pixel(K(0, 0) * ray->x() + K(0, 2), K(1, 1) * ray->y() + K(1, 2));
        corners.push_back({points[i], pixel, kCornerSigma});
      }
    }
    if (corners.size() == points.size()) {
      seen.corners.insert(seen.corners.end(), corners.begin(), corners.end());
    }
  }
  return seen;
}

Outcome<HookView> viewOf(std::vector<CameraFeatures> cameras) {
  std::erase_if(cameras, [](const CameraFeatures& c) { return c.corners.empty(); });
  if (cameras.empty()) {
    return Refusal{"no tag of the plate seen"};
  }
  const auto start = startPose(cameras, std::nullopt);
  if (!start || !(cornerRms(cameras, *start) < kContradiction)) {
    return Refusal{"the tags seen are not where the plate has them"};
  }
  HookView view;
  view.cameras = std::move(cameras);
  view.c1Mo_start = *start;
  return view;
}

void requireSame(const std::string& what, std::size_t found, std::size_t images) {
  if (found != images) {
    throw InputError(what + " are " + std::to_string(found) + ", expected " +
                     std::to_string(images) + ", one for each image of --images");
  }
}

/// Reported joints of all images [rad], where the poses come as a table that has them.
std::vector<std::optional<JointVector>> readJoints(const PlateImages& images) {
  std::vector<std::optional<JointVector>> joints(images.left.size());
  if (images.poses.size() != 1 || images.poses.front().extension() != ".csv") {
    return joints;
  }
  const CsvTable table(images.poses.front());
  if (!table.has("j1_rad")) {
    return joints;
  }
  const JointColumns columns(table);
  for (std::size_t row = 0; row < joints.size(); ++row) {
    joints[row] = columns.read(row);
  }
  return joints;
}

}  // namespace

std::vector<Pose> readFlangePoses(const PlateImages& images) {
  if (images.poses.size() == 1 && images.poses.front().extension() == ".csv") {
    std::vector<Pose> poses = readPoseTable(images.poses.front());
    requireSame(images.poses.front().string() + ": the rows", poses.size(), images.left.size());
    return poses;
  }
  requireSame("--poses: the files", images.poses.size(), images.left.size());
  std::vector<Pose> poses;
  for (const auto& file : images.poses) {
    poses.push_back(readVispPose(file));
  }
  return poses;
}

FoundPlates findPlates(const PlateImages& images, const StereoRig& rig, TagPlate plate,
                       const StepHook& hook) {
  const bool stereo = !images.right.empty();
  if (stereo && !rig.right) {
    throw InputError("--right: the rig has one camera only");
  }
  if (stereo) {
    requireSame("--right: the images", images.right.size(), images.left.size());
  }
  const std::vector<Pose> poses = readFlangePoses(images);
  const auto joints = readJoints(images);
  plate.oMk = Pose::Identity();
  TagDetector detector(plate.family, 1, true);
  FoundPlates found;
  for (std::size_t i = 0; i < images.left.size(); ++i) {
    const std::string name = images.left[i].filename().string();
    hook(static_cast<double>(i) / static_cast<double>(images.left.size()), name);
    std::vector<CameraFeatures> cameras{
        see(readOfSize(images.left[i], rig.left), rig.left, Pose::Identity(), plate, detector)};
    if (stereo) {
      cameras.push_back(
          see(readOfSize(images.right[i], *rig.right), *rig.right, rig.c2Mc1, plate, detector));
    }
    const Outcome<HookView> seen = viewOf(std::move(cameras));
    if (seen) {
      found.views.push_back({name, poses[i], *seen, joints[i]});
    } else {
      found.blind.push_back({name, i, seen.reason()});
    }
  }
  return found;
}

}  // namespace ringhook

#include "calib/solve/plate_images.h"

#include "calib/solve/pose_table.h"
#include "camera/image_file.h"
#include "core/error.h"
#include "rig/rectifier.h"
#include "tracking/marker_tracker.h"

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

void requireSame(const std::string& what, std::size_t found, std::size_t images) {
  if (found != images) {
    throw InputError(what + " are " + std::to_string(found) + ", expected " +
                     std::to_string(images) + ", one for each image of --images");
  }
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
  StereoRig used = rig;
  if (!stereo) {
    used.right.reset();
    used.c2Mc1 = Pose::Identity();
  }
  const Rectifier rectifier(used);
  plate.oMk = Pose::Identity();
  MarkerTracker tracker(plate);
  FoundPlates found;
  for (std::size_t i = 0; i < images.left.size(); ++i) {
    const std::string name = images.left[i].filename().string();
    hook(static_cast<double>(i) / static_cast<double>(images.left.size()), name);
    StereoFrame frame;
    frame.left = readOfSize(images.left[i], rig.left);
    frame.left_window = {0, 0, rig.left.width, rig.left.height};
    if (stereo) {
      frame.right = readOfSize(images.right[i], *rig.right);
      frame.right_window = frame.left_window;
    }
    const auto seen = tracker.track(rectifier.rectify(frame), std::nullopt);
    if (seen) {
      found.views.push_back({name, poses[i], *seen});
    } else {
      found.blind.push_back({name, i, seen.reason()});
    }
  }
  return found;
}

}  // namespace ringhook

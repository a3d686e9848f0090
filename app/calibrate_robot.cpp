#include "app/calibrate_robot.h"

#include <cstdio>
#include <memory>
#include <string>

#include "app/calibrate_job.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/robot_report.h"
#include "calib/solve/plate_images.h"
#include "calib/solve/stereo_images.h"
#include "camera/visp_camera_xml.h"
#include "core/error.h"
#include "rig/stereo_rig.h"

namespace ringhook {
namespace {

struct RobotJob {
  std::string pairs;
  std::string points;
  std::string images;
  std::string right;
  std::string poses;
  std::string rig;
  std::string target;
  std::string setup = "eye-to-hand";
  std::string out;
  std::string json;
  bool keep_zeros = false;
};

void requireSources(const RobotJob& job) {
  const int sources =
      (job.pairs.empty() ? 0 : 1) + (job.points.empty() ? 0 : 1) + (job.images.empty() ? 0 : 1);
  if (sources != 1) {
    throw InputError("expected exactly one of --pairs, --points and --images");
  }
  const bool complete = !job.poses.empty() && !job.rig.empty() && !job.target.empty();
  if (!job.images.empty() && !complete) {
    throw InputError("--images needs --poses, --rig and --target as well");
  }
  if (job.images.empty() && (job.keep_zeros || !(job.poses + job.target + job.right).empty())) {
    throw InputError("--poses, --target, --right and --keep-zeros go with --images only");
  }
  if (!job.out.empty() && job.rig.empty()) {
    throw InputError("--out writes the rig of --rig with fMc1 in it: --rig is missing");
  }
  const EyeSetup setup = parseSetup(job.setup);
  if (setup == EyeSetup::kEyeInHand && (!job.points.empty() || !job.out.empty())) {
    throw InputError(!job.points.empty()
                         ? "--points is for a fixed camera: --setup eye-to-hand"
                         : "--out: a rig file holds a camera fixed in the robot reference (fMc1), "
                           "eye-in-hand has none; use --json");
  }
}

// The rig with the camera's new place; nothing is written after a poor verdict.
void finish(const RobotJob& job, const Pose& camera, const Verdict& verdict,
            const JointVector& arm_zeros_rad = JointVector::Zero()) {
  if (verdict.grade == Grade::kPoor) {
    throw Error("the robot-camera calibration is not usable: " + verdict.sentence);
  }
  if (job.out.empty()) {
    return;
  }
  StereoRig rig = loadAnyRig(job.rig);
  rig.fMc1 = camera;
  if (!rig.joint_zeros_rad.isZero(0.0) && arm_zeros_rad.isZero(0.0)) {
    std::printf("the joint zeros of %s are dropped: the flange poses were taken without them\n",
                job.rig.c_str());
  }
  rig.joint_zeros_rad = arm_zeros_rad;
  rig.date = utcDate();
  rig.tool_version = RINGHOOK_VERSION;
  saveRig(job.out, rig);
  std::printf("wrote %s\n", job.out.c_str());
}

// What a job refuses, with the name of what it was given.
template <class Job>
auto named(const std::string& source, const Job& run) {
  try {
    return run();
  } catch (const InputError& e) {
    throw InputError(source + ": " + e.what());
  }
}

void fromPoints(const RobotJob& job, JsonFile& json) {
  const std::vector<PointPair> points = readPointPairs(job.points);
  const PointFit fit = named(job.points, [&] { return fitPoints(points); });
  json.commit(summaryOf(fit, points).dump(2) + "\n");
  printResult(fit, points);
  finish(job, fit.fMc1, fit.verdict);
}

void fromPairs(const RobotJob& job, JsonFile& json) {
  const std::vector<PosePair> pairs = readPosePairs(job.pairs);
  HandEyeResult result;
  {
    Progress progress("calibrating");
    const EyeSetup setup = parseSetup(job.setup);
    result =
        named(job.pairs, [&] { return calibrateRobotCamera(pairs, setup, hookFor(progress)); });
  }
  json.commit(summaryOf(result).dump(2) + "\n");
  printResult(result, pairs);
  finish(job, result.pose.camera, result.verdict);
}

void fromImages(const RobotJob& job, JsonFile& json) {
  PlateImages images{expandGlob(job.images, "--images"), {}, expandGlob(job.poses, "--poses")};
  if (!job.right.empty()) {
    images.right = expandGlob(job.right, "--right");
  }
  const StereoRig rig = loadAnyRig(job.rig);
  const TagPlate plate = loadTagPlate(job.target);
  FoundPlates found;
  {
    Progress progress("finding the plate");
    found = findPlates(images, rig, plate, hookFor(progress));
  }
  PlateCalibration calibration;
  {
    Progress progress("calibrating");
    const EyeSetup setup = parseSetup(job.setup);
    const ZeroChoice choice = job.keep_zeros ? ZeroChoice::kKeep : ZeroChoice::kWherePaying;
    calibration = named("--images with the plate in sight", [&] {
      return calibrateFromViews(found.views, setup, choice, hookFor(progress), rig.joint_zeros_rad);
    });
  }
  calibration.blind.insert(calibration.blind.begin(), found.blind.begin(), found.blind.end());
  json.commit(summaryOf(calibration).dump(2) + "\n");
  printResult(calibration);
  finish(job, calibration.result.pose.camera, calibration.result.verdict,
         calibration.arm_zeros_rad);
}

void calibrateRobot(const RobotJob& job) {
  requireSources(job);
  JsonFile json(job.json);
  if (!job.out.empty()) {
    checkRig(loadAnyRig(job.rig), job.rig);  // a bad file is found out before the work
  }
  if (!job.points.empty()) {
    fromPoints(job, json);
  } else if (!job.pairs.empty()) {
    fromPairs(job, json);
  } else {
    fromImages(job, json);
  }
}

}  // namespace

void addCalibrateRobot(CLI::App& calibrate) {
  auto job = std::make_shared<RobotJob>();
  CLI::App& robot = addCommand(
      calibrate, "robot",
      "Find where the camera stands in the robot's reference, or on its flange.",
      "Examples:\n"
      "  ringhook calibrate robot --images 'shots/left*.png' --right 'shots/right*.png' \\\n"
      "    --poses robot.csv --rig rig.yaml --target marker.yaml --out rig.yaml\n"
      "  ringhook calibrate robot --pairs pairs.csv --setup eye-to-hand --json robot.json\n"
      "  ringhook calibrate robot --points points.csv\n"
      "Exit status 1 if the result is not usable; it is not written then.\n"
      "Which way to take, and what the figures mean: doc/robot-camera.md");
  robot.add_option("--pairs", job->pairs, "table of flange and target poses (pairs.csv)");
  robot.add_option("--points", job->points, "table of marker positions (points.csv)");
  robot.add_option("--images", job->images, "images of the tag plate, a quoted pattern");
  robot.add_option("--right", job->right, "images of the right camera, a quoted pattern");
  robot.add_option("--poses", job->poses,
                   "flange poses of the images, by name order: one ViSP pose file each, or one "
                   "table x,y,z,qx,qy,qz,qw (.csv)");
  robot.add_option("--rig", job->rig, "rig.yaml, or a ViSP camera file (.xml)");
  robot.add_option("--target", job->target, "the tag plate (marker.yaml)");
  robot
      .add_option("--setup", job->setup,
                  "eye-to-hand: camera fixed, target on the flange; eye-in-hand: the other way")
      ->capture_default_str();
  robot.add_flag("--keep-zeros", job->keep_zeros,
                 "take the arm's joint zeros as they are, even where correcting them pays");
  robot.add_option("--out", job->out, "rig file to write: that of --rig with fMc1 in it");
  addJsonOption(robot, job->json, "write the figures to this file");
  robot.callback([job] { calibrateRobot(*job); });
}

}  // namespace ringhook

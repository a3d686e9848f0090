#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "calib/solve/plate_images.h"
#include "calib/solve/plate_views.h"
#include "calib/solve/sentence.h"
#include "calib/wizard/arm_poses.h"
#include "calib/wizard/shot_folder.h"
#include "calib/wizard/steps.h"
#include "core/angle.h"
#include "core/error.h"
#include "tracking/tag_detector.h"

namespace ringhook {
namespace {

constexpr std::size_t kGoal = 20;    // views of the plate
constexpr std::size_t kFewest = 12;  // below it the step goes on asking

class ArmPairs {
 public:
  ArmPairs(WizardContext& context, const TagPlate& plate)
      : context_(context),
        plate_(plate),
        detector_(plate.family, 2, true),
        place_(context.place("arm")),
        folder_(context.session.file("arm"), true) {
    if (folder_.count() > 0) {
      say(std::to_string(folder_.count()) + " pairs of the plate are there already.");
    }
  }

  ShotFolder take() {
    if (context_.stored()) {
      takeStored();
    } else if (folder_.count() < kGoal && place_.canMoveArm() && permitted()) {
      takeMoving();
    } else if (folder_.count() < kGoal) {
      takeAsked();
    }
    return folder_;
  }

 private:
  void say(const std::string& text) const { context_.console.say(text); }

  bool permitted() {
    if (!place_.needsConfirmation()) {
      return true;
    }
    say("The arm can go by itself to 24 poses within a cube of 0.2 m around where it stands now,\n"
        "turning the flange by up to 20 degrees. Only floor, pedestal and belt are known to it: "
        "keep\neverything else away, stay clear, and have the emergency stop at hand.");
    if (!context_.console.confirm("May the arm move?", false)) {
      return false;
    }
    place_.confirmMotion();
    return true;
  }

  void takeStored() {
    for (std::size_t i = 0; auto frame = place_.takePair(); ++i) {
      const auto fMe = place_.flange();
      if (!fMe) {
        throw InputError((context_.answers.images / "arm").string() + ": " + fMe.reason());
      }
      if (i >= folder_.count()) {
        (void)keep(*frame, *fMe);
      }
    }
  }

  void takeMoving() {
    const auto start = place_.flange();
    if (!start) {
      throw DeviceError("the arm does not say where it stands: " + start.reason());
    }
    const std::vector<Pose> poses = armPoses(*start);
    for (std::size_t i = 0; i < poses.size() && folder_.count() < kGoal; ++i) {
      const auto reached = place_.moveFlange(poses[i]);
      if (!reached) {
        say("pose " + std::to_string(i + 1) + " left out: " + reached.reason());
        continue;
      }
      if (const auto frame = place_.takePair()) {
        (void)keep(*frame, *reached);
      }
    }
    (void)place_.moveFlange(*start).hasValue();
    if (folder_.count() < kFewest) {
      say("Too few poses showed the plate from where the arm began; please help.");
      takeAsked();
    }
  }

  void takeAsked() {
    say("Move the arm with its pendant so that both cameras see the plate; turn the flange by 20\n"
        "degrees and more about every axis, and move it through the whole workspace.");
    while (folder_.count() < kGoal) {
      const std::string answer = context_.console.ask(
          "Pair " + std::to_string(folder_.count() + 1) + " of " + std::to_string(kGoal) +
              ": Enter when the arm stands; d: done; q: leave and go on later",
          "take", [](const std::string& text) -> std::string {
            return text == "take" || text == "d" || text == "q"
                       ? ""
                       : "Please press Enter, or answer d or q.";
          });
      if (answer == "q") {
        throw Interrupted("left; the same command goes on from here");
      }
      if (answer == "d") {
        return;
      }
      const auto fMe = place_.flange();
      const auto frame = place_.takePair();
      if (!fMe) {
        throw DeviceError("the arm does not say where it stands: " + fMe.reason());
      }
      if (frame) {
        (void)keep(*frame, *fMe);
      }
    }
  }

  std::vector<Eigen::Vector2d> cornersIn(const GrayImage& image, const Window& window) {
    std::vector<Eigen::Vector2d> corners;
    for (const TagDetection& tag : detector_.detect(image, {0, 0, image.width, image.height}, 1)) {
      if (plate_.find(tag.id) != nullptr) {
        for (const Eigen::Vector2d& corner : tag.corners) {
          corners.push_back(corner + Eigen::Vector2d(window.x, window.y));
        }
      }
    }
    return corners;
  }

  bool keep(const StereoFrame& frame, const Pose& fMe) {
    const auto left = cornersIn(frame.left, frame.left_window);
    const auto right = cornersIn(frame.right, frame.right_window);
    context_.view.show(frame, left, right);
    if (left.empty() || right.empty()) {
      say(std::string("not used, the ") + (left.empty() ? "left" : "right") +
          " picture does not show the plate");
      return false;
    }
    ArmRow arm;
    arm.fMe = fMe;
    if (const auto state = place_.armState()) {
      arm.joints = state->position;
    }
    folder_.add(frame.left, frame.right, arm);
    say("pair " + std::to_string(folder_.count()) + ": " + std::to_string(left.size() / 4) +
        " tags on the left, " + std::to_string(right.size() / 4) + " on the right");
    return true;
  }

  WizardContext& context_;
  const TagPlate& plate_;
  TagDetector detector_;
  CalibrationPlace& place_;
  ShotFolder folder_;
};

std::string figures(const HandEyeResult& r) {
  char text[300];
  std::snprintf(text, sizeof(text),
                "  pairs used %zu, rejected %zu\n"
                "  residual %.3f mm and %.3f deg, held-out %.3f mm",
                r.errors.size() - r.rejected.size(), r.rejected.size(),
                1e3 * r.residual.translation_m, r.residual.rotation_rad / kDegree,
                1e3 * r.heldout.translation_m);
  return text;
}

std::string zerosText(const JointVector& zeros_rad) {
  std::string text;
  for (const double zero : zeros_rad) {
    text += fmt::format(" {:.3f}", zero / kDegree);
  }
  return text;
}

std::string json(const PlateCalibration& calibration) {
  const HandEyeResult& r = calibration.result;
  const JointVector zeros_deg = calibration.arm_zeros_rad / kDegree;
  const Eigen::Vector3d t = r.pose.camera.translation();
  const Eigen::Quaterniond q(r.pose.camera.linear());
  return nlohmann::json{{"translation_m", {t.x(), t.y(), t.z()}},
                        {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                        {"residual_mm", 1e3 * r.residual.translation_m},
                        {"heldout_mm", 1e3 * r.heldout.translation_m},
                        {"joint_zeros_deg", std::vector(zeros_deg.begin(), zeros_deg.end())},
                        {"solver", r.solver},
                        {"weights", toString(r.weights)},
                        {"rejected_pairs", r.rejected.size()},
                        {"verdict", toString(r.verdict.grade)},
                        {"verdict_sentence", r.verdict.sentence}}
      .dump();
}

void tell(WizardContext& context, const PlateCalibration& calibration) {
  const HandEyeResult& result = calibration.result;
  for (const RejectedPair& pair : result.rejected) {
    context.console.say("  not used: " + pair.name + ", " + pair.reason);
  }
  context.console.say(figures(result) + "\n  verdict: " + toString(result.verdict.grade) + ": " +
                      result.verdict.sentence);
  if (weightsRefuted(result)) {
    context.console.say("  weighed by: " + toString(result.weights) +
                        ", since pairs left out contradict the errors that the pictures tell of");
  }
  if (calibration.zeros_used) {
    context.console.say("  the arm's joint zeros are off by" +
                        zerosText(calibration.arm_zeros_rad) +
                        " deg; the rig file holds them, and the held-out error falls from " +
                        millimetres(calibration.plain_heldout.translation_m));
  }
}

}  // namespace

void robotStep(WizardContext& context) {
  Console& console = context.console;
  console.say("\nStep 2 of 5: the cameras and the robot. The arm shows the plate on its gripper.");
  if (context.cell.arm.gripper_plate.empty()) {
    throw InputError(context.cell.file.string() +
                     ": field arm.gripper_plate: expected the file of the gripper's tag plate");
  }
  if (!context.has("arm")) {
    throw InputError(context.answers.images.string() +
                     ": expected a folder arm/ with left/, right/ and robot.csv");
  }
  StereoRig rig = context.session.rig("stereo").value();
  const TagPlate plate = loadTagPlate(context.cell.arm.gripper_plate);
  const ShotFolder shots = ArmPairs(context, plate).take();
  const PlateImages images{shots.allLeft(), shots.allRight(), {shots.table()}};
  const FoundPlates found = findPlates(images, rig, plate, context.progress("finding the plate"));
  const PlateCalibration result =
      calibrateFromViews(found.views, EyeSetup::kEyeToHand, ZeroChoice::kWherePaying,
                         context.progress("calibrating the robot"));
  tell(context, result);
  context.session.report("robot", json(result));
  if (result.result.verdict.grade == Grade::kPoor) {
    throw Error(
        "the cameras' place in the robot's frame is not known well enough to go on: --again robot "
        "takes new pictures");
  }
  rig.fMc1 = result.result.pose.camera;
  rig.joint_zeros_rad = result.arm_zeros_rad;
  context.session.keepRig("robot", rig);
}

}  // namespace ringhook

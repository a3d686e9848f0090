#pragma once

/// \file
/// What the places with devices have in common: an arm and a stereo camera behind their interfaces,
/// simulated or real. The arm's states clock everything; every motion is made by the product's own
/// motion code (cycle/arm_motion.h), passes its limiter, and ends with the arm stopped if anything
/// is thrown.

#include "calib/wizard/place.h"
#include "camera/stereo_camera.h"
#include "cycle/arm_motion.h"
#include "robot/arm.h"

namespace ringhook {

class DevicePlace : public CalibrationPlace {
 public:
  [[nodiscard]] Window fullImage() const override { return camera_->fullImage(); }
  [[nodiscard]] std::optional<StereoFrame> takePair() override;
  [[nodiscard]] bool canMoveArm() const override { return true; }
  [[nodiscard]] Outcome<ArmState> armState() override;
  [[nodiscard]] Outcome<Pose> moveJoints(const JointVector& target) override;
  [[nodiscard]] const PlaceDevices* devices() override { return &devices_; }

 protected:
  DevicePlace(const CellConfig& cell, std::unique_ptr<Arm> arm,
              std::unique_ptr<StereoCamera> camera, bool stamps_are_mid_exposure);

  [[nodiscard]] const CellConfig& cell() const { return cell_; }
  [[nodiscard]] Arm& arm() { return *arm_; }
  void tellLateness(std::function<std::optional<double>()> lateness_s) {
    devices_.lateness_s = std::move(lateness_s);
  }

 private:
  ArmState run(ArmMotion& motion, const JointVector& target, ArmState state);
  void restCamera();

  CellConfig cell_;
  std::unique_ptr<Arm> arm_;
  std::unique_ptr<StereoCamera> camera_;
  PlaceDevices devices_;
};

}  // namespace ringhook

#include "sim/wired_sim_arm.h"

#include "sim/controller_port.h"

namespace ringhook {
namespace {

rx60::LinkSettings settings() {
  rx60::LinkSettings settings;
  const GripperOutput gripper;
  settings.gripper_module = gripper.module;
  settings.gripper_pin = gripper.pin;
  return settings;
}

}  // namespace

WiredSimArm::WiredSimArm(CellWorld& world, std::uint64_t seed)
    : plant_(world),
      controller_(plant_),
      arm_(std::make_unique<ControllerPort>(controller_, plant_, world.time(), seed), settings(),
           Rx60Arm::Runs::kInWaitState) {}

}  // namespace ringhook

#include "cycle/servo_loop.h"
#include "cycle/vision_side.h"

namespace ringhook {

VisionInTurn::VisionInTurn(StereoCamera& camera, VisionStep& vision, LoopObserver& observer)
    : camera_(camera), vision_(vision), observer_(observer) {}

void VisionInTurn::restart() {
  vision_.restart();
  camera_.setWindows(vision_.windows()[0], vision_.windows()[1]);
  camera_.setFrameRate(vision_.rateHz());
}

std::optional<HookFilterState> VisionInTurn::newest(const ArmState& state) {
  while (const std::optional<StereoFrame> frame = camera_.grab(0.0)) {
    const VisionReport report = vision_.process(*frame);
    camera_.setWindows(vision_.windows()[0], vision_.windows()[1]);
    camera_.setFrameRate(vision_.rateHz());
    observer_.onFrame(*frame, report, state.time - frame->time);
  }
  return vision_.estimate();
}

}  // namespace ringhook

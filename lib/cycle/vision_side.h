#pragma once

/// \file
/// The control side's view of vision: the newest estimate, whatever clocks the cameras. In virtual
/// time frames are taken in turn with the arm's states (VisionInTurn), so that every run is the
/// same; in real time they are taken on a thread of their own (VisionThread), since a frame takes
/// several of the arm's periods to understand.

#include <optional>

#include "camera/stereo_camera.h"
#include "core/joints.h"
#include "cycle/vision_step.h"

namespace ringhook {

class LoopObserver;

class VisionSide {
 public:
  VisionSide() = default;
  VisionSide(const VisionSide&) = delete;
  VisionSide& operator=(const VisionSide&) = delete;
  virtual ~VisionSide() = default;

  /// Forgets the hook and looks for the next one.
  virtual void restart() = 0;

  /// The newest estimate at the time of an arm state; nothing while no hook is tracked. Throws what
  /// a camera or a stage of vision threw.
  [[nodiscard]] virtual std::optional<HookFilterState> newest(const ArmState& state) = 0;
};

/// Takes every frame that has arrived whenever it is asked.
class VisionInTurn : public VisionSide {
 public:
  /// All must outlive it.
  VisionInTurn(StereoCamera& camera, VisionStep& vision, LoopObserver& observer);

  void restart() override;
  [[nodiscard]] std::optional<HookFilterState> newest(const ArmState& state) override;

 private:
  StereoCamera& camera_;
  VisionStep& vision_;
  LoopObserver& observer_;
};

}  // namespace ringhook

#pragma once

/// \file
/// Vision in real time, on a thread of its own: it waits for frames, works them off, sets the next
/// windows, and publishes what it believes. The control side takes the newest belief at once and
/// never waits. A failure of a camera or a stage ends the thread and comes out of newest(), where
/// the control side stops the arm. Of frames that came while it was at work the newest one is
/// taken; older ones would only delay what is acted upon.

#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "cycle/vision_side.h"

namespace ringhook {

class VisionThread : public VisionSide {
 public:
  /// Begins at once. All must outlive it; camera, vision and the observer's onFrame() belong to its
  /// thread from now on.
  VisionThread(StereoCamera& camera, VisionStep& vision, LoopObserver& observer);
  /// Waits for the frame that is being worked on.
  ~VisionThread() override;

  void restart() override;
  [[nodiscard]] std::optional<HookFilterState> newest(const ArmState& state) override;

  /// Frames that were passed over because a newer one had come.
  [[nodiscard]] std::int64_t passedOver() const;

 private:
  void run() noexcept;
  void work();
  std::optional<StereoFrame> newestFrame();
  bool goOn();

  StereoCamera& camera_;
  VisionStep& vision_;
  LoopObserver& observer_;

  mutable std::mutex mutex_;  ///< guards what follows
  bool ending_ = false;
  bool restart_ = false;
  Time now_;  ///< of the last arm state
  std::optional<HookFilterState> estimate_;
  std::exception_ptr failure_;
  std::int64_t passed_over_ = 0;
  std::thread thread_;
};

}  // namespace ringhook

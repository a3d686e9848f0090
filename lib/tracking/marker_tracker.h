#pragma once

/// \file
/// Sees the hook by the tag plate on its shank. Law: four corners a tag, in every view, in the
/// project's pixel convention (see tag_detector.h), with the corners' places in the hook frame.
/// A large image is searched at reduced size first; what is found is detected again at full size in
/// a window around it, so that the corners are as exact as in a small window (0.03 to 0.07 px per
/// axis on painted tags of 77 px; 0.09 to 0.13 px while the sides lie within about half a degree of
/// the pixel rows, where the detector's line fit follows the grid).

#include <memory>

#include "tracking/hook_tracker.h"
#include "tracking/tag_plate.h"

namespace ringhook {

struct MarkerTrackerOptions {
  double quad_decimate = 2.0;         ///< reduction for the first search of a large image
  double full_size_pixels = 400e3;    ///< images of up to this many pixels are searched as they are
  int threads = 1;                    ///< of the detector
  bool refine_edges = true;           ///< fit the square's sides to the gradient
  int max_hamming = 1;                ///< corrected bits that are still believed
  double min_decision_margin = 25.0;  ///< weaker decodings are not believed [grey levels]
  double corner_sigma_px = 0.06;      ///< standard deviation of a corner, per axis [px]
};

class MarkerTracker final : public HookTracker {
 public:
  /// Throws InputError for options out of range or an unknown family.
  explicit MarkerTracker(TagPlate plate, const MarkerTrackerOptions& options = {});
  ~MarkerTracker() override;

  /// Refuses with "no tag seen" or "tags contradict each other"; works without a prediction.
  [[nodiscard]] Outcome<HookView> track(const RectifiedFrame& frame,
                                        const std::optional<Pose>& c1Mo_predicted) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook

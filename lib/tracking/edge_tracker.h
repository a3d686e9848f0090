#pragma once

/// \file
/// Sees the hook by its edges, without any mark on it: ViSP's model-based tracker on one or two
/// cameras. Law: sites on the projected model lines look for the strongest matching edge along the
/// normal, and a robust virtual visual servoing moves the pose until lines and sites agree
/// (Comport, Marchand, Pressigout, Chaumette, "Real-time markerless tracking for augmented reality:
/// the virtual visual servoing framework", TVCG 2006). The sites that agree are then placed with
/// sub-pixel accuracy (edge_site.h) and handed on as EdgeFeatures; c1Mo_start is ViSP's own pose.
/// A model's cylinders and circles take part in that pose, but HookView carries lines only.

#include <filesystem>
#include <memory>
#include <vector>

#include "tracking/edge_settings.h"
#include "tracking/hook_tracker.h"

namespace ringhook {

/// How well the last frame agreed with the model.
struct EdgeQuality {
  int sites = 0;               ///< sites searched, all cameras
  int good_sites = 0;          ///< sites that became features
  double rms_px = 0.0;         ///< distance of the features from ViSP's pose [px]
  double spread_px = 0.0;      ///< robust standard deviation of all refined sites from it [px]
  double direction_deg = 0.0;  ///< mean angle between gradient and line normal [deg]
};

class EdgeTracker final : public HookTracker {
 public:
  /// Throws InputError naming a model file that is missing, malformed or has no face and no line,
  /// or an option out of range.
  explicit EdgeTracker(const std::filesystem::path& model, const EdgeTrackerOptions& options = {});
  EdgeTracker(std::vector<EdgeModelFile> models, const EdgeTrackerOptions& options);
  ~EdgeTracker() override;

  /// Starts from the prediction where it is further than `reset_px` from the last pose, from the
  /// last pose otherwise. Refuses "no start pose" without either; after any other refusal the last
  /// pose is forgotten.
  [[nodiscard]] Outcome<HookView> track(const RectifiedFrame& frame,
                                        const std::optional<Pose>& c1Mo_predicted) override;

  /// Of the last call of track() that searched the image.
  [[nodiscard]] const EdgeQuality& quality() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook

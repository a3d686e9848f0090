#include "tracking/edge_settings.h"

#include <visp3/mbt/vpMbGenericTracker.h>

#include <fstream>
#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

void require(bool good, const std::string& option, const std::string& expected) {
  if (!good) {
    throw InputError("edge tracker: " + option + " must be " + expected);
  }
}

EdgeTrackerOptions settingsOf(const vpMbGenericTracker& tracker) {
  const vpMe me = tracker.getMovingEdge();
  EdgeTrackerOptions o;
  o.mask_size = static_cast<int>(me.getMaskSize());
  o.mask_number = static_cast<int>(me.getMaskNumber());
  o.range_px = static_cast<int>(me.getRange());
  o.threshold = me.getThreshold();
  o.mu1 = me.getMu1();
  o.mu2 = me.getMu2();
  o.sample_step_px = me.getSampleStep();
  o.angle_appear = tracker.getAngleAppear();
  o.angle_disappear = tracker.getAngleDisappear();
  o.near_m = tracker.getNearClippingDistance();
  o.far_m = tracker.getFarClippingDistance();
  o.clip_to_image = (tracker.getClipping() & vpPolygon3D::FOV_CLIPPING) != 0;
  return o;
}

}  // namespace

EdgeTrackerOptions loadEdgeSettings(const std::filesystem::path& path) {
  if (!std::ifstream(path)) {
    throw InputError(path.string() + ": cannot read this file (ViSP tracker XML expected)");
  }
  vpMbGenericTracker tracker(1, vpMbGenericTracker::EDGE_TRACKER);
  const EdgeTrackerOptions defaults;
  tracker.setNearClippingDistance(defaults.near_m);
  tracker.setFarClippingDistance(defaults.far_m);
  try {
    tracker.loadConfigFile(path.string(), false);
  } catch (const std::exception& e) {
    throw InputError(path.string() + ": not a ViSP tracker XML: " + e.what());
  }
  const EdgeTrackerOptions options = settingsOf(tracker);
  try {
    checkEdgeSettings(options);
  } catch (const InputError& e) {
    throw InputError(path.string() + ": " + e.what());
  }
  return options;
}

void checkEdgeSettings(const EdgeTrackerOptions& o) {
  require(o.mask_size >= 3 && o.mask_size <= 15 && o.mask_size % 2 == 1, "mask_size",
          "odd, from 3 to 15");
  require(o.mask_number > 0 && o.mask_number <= 360, "mask_number", "from 1 to 360");
  require(o.range_px >= 1 && o.range_px <= 100, "range_px", "from 1 to 100");
  require(o.threshold >= 0.0, "threshold", "0 or more");
  require(o.mu1 >= 0.0 && o.mu1 <= 1.0, "mu1", "from 0 to 1");
  require(o.mu2 >= 0.0, "mu2", "0 or more");
  require(o.sample_step_px >= 1.0, "sample_step_px", "1 or more");
  require(o.angle_appear > 0.0 && o.angle_disappear >= o.angle_appear, "angle_disappear",
          "at least angle_appear, both positive");
  require(o.near_m > 0.0 && o.far_m > o.near_m, "far_m", "larger than near_m, both positive");
  require(o.reset_px >= 0.0, "reset_px", "0 or more");
  require(o.min_sites >= 6, "min_sites", "6 or more");
}

}  // namespace ringhook

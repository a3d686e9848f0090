#include "evaluation/evaluation_method.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "stereo/joint_pose.h"
#include "stereo/plate_pose.h"
#include "tracking/edge_tracker.h"
#include "tracking/marker_tracker.h"

namespace ringhook {
namespace {

/// A pose from a method that tells nothing about its uncertainty.
HookFix bareFix(const HookView& view, const Pose& c1Mo) {
  HookFix fix;
  fix.time = view.time;
  fix.c1Mo = c1Mo;
  fix.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  fix.rms_px = std::numeric_limits<double>::quiet_NaN();
  for (const auto& camera : view.cameras) {
    fix.features += static_cast<int>(camera.corners.size() + camera.edges.size());
  }
  return fix;
}

/// Reweighting converges linearly where many sites lie near the biweight's edge: on the photographs
/// of datasets/visp-cube one frame in twenty needs more than the default number of iterations.
Outcome<HookFix> jointFix(const HookView& view) {
  JointPoseOptions options;
  options.largest_iterations = 300;
  return fixFromView(view, options);
}

Outcome<HookFix> vispFix(const HookView& view) { return bareFix(view, view.c1Mo_start); }

Outcome<HookFix> midpointFix(const HookView& view) {
  const auto pose = platePoseFromPoints(view);
  if (!pose) {
    return Refusal{pose.reason()};
  }
  return bareFix(view, *pose);
}

Outcome<HookFix> leftFix(const HookView& view) { return singleViewFix(view, 0); }

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

}  // namespace

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> kNames = {"edges", "edges-visp", "marker-joint",
                                                  "marker-midpoint", "marker-single"};
  return kNames;
}

std::string defaultMethod(const std::filesystem::path& target) {
  if (target.extension() == ".cao") {
    return "edges";
  }
  if (target.extension() == ".yaml" || target.extension() == ".yml") {
    return "marker-joint";
  }
  throw InputError("target " + target.string() +
                   ": expected a tag plate (.yaml) or a model (.cao)");
}

EvaluationMethod makeMethod(const std::string& name, const std::filesystem::path& target,
                            const std::filesystem::path& settings, bool stereo) {
  const auto& names = methodNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError("--method " + name + ": expected one or more of " + listed(names));
  }
  const bool edges = name.starts_with("edges");
  if (edges != (defaultMethod(target) == "edges")) {
    throw InputError("--method " + name + " does not fit the target " + target.string() +
                     (edges ? ": expected a model (.cao)" : ": expected a tag plate (.yaml)"));
  }
  if (name == "marker-midpoint" && !stereo) {
    throw InputError("--method marker-midpoint needs two cameras, but the sequence has one");
  }
  EvaluationMethod method;
  method.name = name;
  if (edges) {
    const auto options = settings.empty() ? EdgeTrackerOptions{} : loadEdgeSettings(settings);
    method.tracker = std::make_unique<EdgeTracker>(target, options);
    method.fix = name == "edges" ? jointFix : vispFix;
    method.needs_start = true;
    return method;
  }
  method.tracker = std::make_unique<MarkerTracker>(loadTagPlate(target));
  method.left_only = name == "marker-single";
  method.fix = method.left_only ? leftFix : name == "marker-joint" ? jointFix : midpointFix;
  return method;
}

}  // namespace ringhook

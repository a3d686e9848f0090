#include <cstdio>
#include <nlohmann/json.hpp>

#include "calib/solve/verify.h"
#include "calib/wizard/board_pairs.h"
#include "calib/wizard/steps.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kPairs = 6;

/// New pairs of the board; of stored images those in check/, or none.
StereoViews newViews(WizardContext& context, const Coverage& before) {
  BoardPairsOptions pairs;
  pairs.part = "check";
  pairs.goal = kPairs;
  pairs.coverage = false;
  pairs.begin_from = before;
  return takeBoardPairs(context, pairs);
}

nlohmann::json json(const Verification& v) {
  return {{"verdict", toString(v.state)},
          {"reasons", v.reasons},
          {"views", v.views},
          {"vertical_disparity_px", {{"mean", v.rows.mean_px}, {"rms", v.rows.rms_px}}},
          {"expected_px", v.rows.expected_px},
          {"bar_known_mm", 1e3 * v.bar.known_m},
          {"bar_rms_mm", 1e3 * v.bar.rms_m}};
}

}  // namespace

void checkStep(WizardContext& context) {
  Console& console = context.console;
  console.say("\nStep 4 of 5: a check with pictures that the calibration has not seen.");
  if (!context.has("check")) {
    console.say("  Left out: there is no folder check/. Later: ringhook calibrate verify");
    context.session.report("check", nlohmann::json{{"left_out", true}}.dump());
    return;
  }
  Coverage before;
  before.pairs = 1;  // begins with other holds than the first step
  const StereoViews views = newViews(context, before);
  const StereoRig rig = context.session.rig("time").value();
  const Verification result = verifyRig(rig, views, context.board);
  char text[300];
  std::snprintf(
      text, sizeof(text),
      "  rows off by %.3f px RMS (%.3f expected); a length of %.0f mm measured to %.3f mm "
      "RMS in %d views",
      result.rows.rms_px, result.rows.expected_px, 1e3 * result.bar.known_m, 1e3 * result.bar.rms_m,
      result.bar.count);
  console.say(text);
  for (const std::string& reason : result.reasons) {
    console.say("  " + reason);
  }
  console.say("  verdict: " + toString(result.state));
  context.session.report("check", json(result).dump());
  if (result.state != RigState::kOk) {
    throw Error("the rig does not stand the check: --again stereo begins anew");
  }
}

}  // namespace ringhook

#include <cstdio>
#include <nlohmann/json.hpp>

#include "calib/solve/stereo_calibration.h"
#include "calib/wizard/board_pairs.h"
#include "calib/wizard/steps.h"
#include "core/error.h"

namespace ringhook {
namespace {

std::string figures(const StereoCalibration& c) {
  char text[400];
  std::snprintf(text, sizeof(text),
                "  pairs used %zu, rejected %zu\n"
                "  reprojection RMS %.3f px, held-out rows %.3f px\n"
                "  baseline %.2f mm%s",
                c.used.size(), c.rejected.size(), c.rms_px, c.heldout_vertical_disparity_px,
                1e3 * baseline(c.rig), c.uncertainty ? "" : ", not determined");
  return text;
}

std::string json(const StereoCalibration& c) {
  return nlohmann::json{{"rms_px", c.rms_px},
                        {"heldout_vertical_disparity_px", c.heldout_vertical_disparity_px},
                        {"baseline_m", baseline(c.rig)},
                        {"views_used", c.used.size()},
                        {"views_rejected", c.rejected.size()},
                        {"verdict", toString(c.verdict.grade)},
                        {"verdict_sentence", c.verdict.sentence}}
      .dump();
}

}  // namespace

void stereoStep(WizardContext& context) {
  Console& console = context.console;
  console.say("\nStep 1 of 5: the cameras. Board: " + toString(context.board) +
              ". Light and focus as they will be used, please.");
  BoardPairsOptions pairs;
  pairs.part = "board";
  while (true) {
    const StereoViews views = takeBoardPairs(context, pairs);
    const StereoCalibration result = calibrateStereo(views, context.board, StereoOptions{},
                                                     context.progress("calibrating the cameras"));
    for (const RejectedView& view : result.rejected) {
      console.say("  not used: " + view.left_name + ", " + view.reason);
    }
    console.say(figures(result) + "\n  verdict: " + toString(result.verdict.grade) + ": " +
                result.verdict.sentence);
    context.session.report("stereo", json(result));
    if (result.verdict.grade != Grade::kPoor) {
      context.session.keepRig("stereo", result.rig);
      return;
    }
    const bool more = !context.stored() && console.confirm("Take more pairs?", true);
    if (!more) {
      throw Error("the cameras are not calibrated well enough to go on");
    }
    pairs.goal = static_cast<int>(views.usable.size()) + 6;
  }
}

}  // namespace ringhook

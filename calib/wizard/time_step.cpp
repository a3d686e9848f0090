#include <cstdio>
#include <nlohmann/json.hpp>

#include "calib/wizard/place_delays.h"
#include "calib/wizard/place_plate.h"
#include "calib/wizard/steps.h"
#include "core/error.h"

namespace ringhook {
namespace {

std::string figure(const char* name, const std::optional<KnownDelay>& delay) {
  char text[120];
  if (delay) {
    std::snprintf(text, sizeof(text), "  %-8s %6.2f ms, standard deviation %.2f ms\n", name,
                  1e3 * delay->value_s, 1e3 * delay->sigma_s);
  } else {
    std::snprintf(text, sizeof(text), "  %-8s cannot be told here: it stays as it was\n", name);
  }
  return text;
}

nlohmann::json delayJson(const std::optional<KnownDelay>& delay) {
  return delay ? nlohmann::json(1e3 * delay->value_s) : nlohmann::json();
}

bool permitted(CalibrationPlace& place, Console& console) {
  if (!place.needsConfirmation()) {
    return true;
  }
  console.say("The arm goes to where it waits for hooks and wiggles there by about 15 mm for 8 s.");
  if (!console.confirm("May the arm move?", false)) {
    return false;
  }
  place.confirmMotion();
  return true;
}

}  // namespace

void timeStep(WizardContext& context) {
  Console& console = context.console;
  console.say("\nStep 3 of 5: the delays. The arm wiggles, the cameras watch its plate.");
  StereoRig rig = context.session.rig("robot").value();
  if (context.stored() || !permitted(context.place("arm"), console)) {
    console.say(
        "  Left out: the delays stay as they were. A recorded wiggle does it later:\n"
        "  ringhook calibrate time --sequence DIR");
    rig.robot_delay_s = context.rough.robot_delay_s;
    rig.camera_delay_s = context.rough.camera_delay_s;
    context.session.report("time", nlohmann::json{{"left_out", true}}.dump());
    context.session.keepRig("time", rig);
    return;
  }
  const TagPlate plate = plateInItsOwnFrame(loadTagPlate(context.cell.arm.gripper_plate));
  const auto record = recordWiggle(context.place("arm"), context.cell, rig, plate, WiggleOptions{},
                                   context.progress("wiggling"));
  if (!record) {
    throw Error("the delays cannot be measured: " + record.reason());
  }
  const auto delays = delaysOf(*record, rig);
  if (!delays) {
    throw Error("the delays cannot be measured: " + delays.reason());
  }
  console.say(figure("arm", delays->robot) + figure("cameras", delays->camera) + "  verdict: " +
              (delays->grade == DelayGrade::ok ? "ok" : "bad") + ": " + delays->sentence);
  context.session.report("time",
                         nlohmann::json{{"robot_delay_ms", delayJson(delays->robot)},
                                        {"camera_delay_ms", delayJson(delays->camera)},
                                        {"offset_ms", 1e3 * delays->offset.offset_s},
                                        {"offset_sigma_ms", 1e3 * delays->offset.sigma_s},
                                        {"verdict", delays->grade == DelayGrade::ok ? "ok" : "bad"},
                                        {"verdict_sentence", delays->sentence}}
                             .dump());
  if (delays->grade != DelayGrade::ok) {
    throw Error("the delays are not known well enough to go on");
  }
  context.session.keepRig("time", withDelays(rig, *delays));
}

}  // namespace ringhook

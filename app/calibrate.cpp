#include "app/calibrate.h"

#include "app/calibrate_exchange.h"
#include "app/calibrate_plan.h"
#include "app/calibrate_robot.h"
#include "app/calibrate_stereo.h"
#include "app/calibrate_time.h"
#include "app/calibrate_verify.h"
#include "app/calibrate_wizard.h"
#include "app/options.h"

namespace ringhook {

void addCalibrateCommand(CLI::App& app) {
  CLI::App& calibrate = addCommand(app, "calibrate", "Set up a cell and judge the result.",
                                   "Example: ringhook calibrate stereo --help");
  calibrate.require_subcommand(1);
  addCalibrateWizard(calibrate);
  addCalibrateStereo(calibrate);
  addCalibrateRobot(calibrate);
  addCalibrateTime(calibrate);
  addCalibrateVerify(calibrate);
  addCalibratePlan(calibrate);
  addCalibrateExchange(calibrate);
}

}  // namespace ringhook

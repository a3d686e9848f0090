#include "app/calibrate_wizard.h"

#include <memory>
#include <string>

#include "app/calibrate_job.h"
#include "app/dialogue.h"
#include "app/options.h"
#include "calib/wizard/wizard.h"

namespace ringhook {
namespace {

struct WizardArguments {
  std::string session = "out/wizard";
  std::string cell;
  std::string images;
  std::string board;
  std::optional<std::uint64_t> seed;
  std::string again;
  std::string until;
  std::string rigs = RINGHOOK_SOURCE_DIR "/calib/rigs";
  bool no_window = false;
};

template <class T>
std::optional<T> unlessEmpty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<T>(text);
}

void runCommand(const WizardArguments& arguments) {
  WizardOptions options;
  options.session = arguments.session;
  options.cell = unlessEmpty<std::filesystem::path>(arguments.cell);
  options.images = unlessEmpty<std::filesystem::path>(arguments.images);
  options.board = unlessEmpty<std::string>(arguments.board);
  options.seed = arguments.seed;
  options.again = unlessEmpty<std::string>(arguments.again);
  options.until = unlessEmpty<std::string>(arguments.until);
  options.window = !arguments.no_window;
  options.default_cell = RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml";
  options.accepted_rigs = arguments.rigs;
  options.date = utcDate();
  options.version = RINGHOOK_VERSION;
  Console console = terminal();
  runWizard(options, console, progressOf, leaveIfAsked);
}

}  // namespace

void addCalibrateWizard(CLI::App& calibrate) {
  auto arguments = std::make_shared<WizardArguments>();
  CLI::App& wizard = addCommand(
      calibrate, "wizard", "Set up a cell step by step: cameras, robot, delays, check, cell file.",
      "Example: ringhook calibrate wizard --cell app/config/cell-sim.yaml --session out/my-cell\n"
      "What is not said here is asked. Ctrl-C leaves; the same command goes on from there.");
  wizard.add_option("--session", arguments->session, "folder of the session")
      ->capture_default_str();
  wizard.add_option("--cell", arguments->cell, "cell file with devices, hook, belt and arm");
  wizard.add_option("--images", arguments->images,
                    "stored images instead of the cell's cameras: board/ and arm/, each with left/ "
                    "and right/, arm/ with robot.csv; optional check/");
  wizard.add_option("--board", arguments->board, "the board, as for calibrate stereo");
  wizard.add_option("--seed", arguments->seed, "of a simulated cell (1)")
      ->check(CLI::NonNegativeNumber);
  wizard
      .add_option("--again", arguments->again,
                  "do this step anew, with new pictures, and all after it")
      ->check(CLI::IsMember(wizardSteps()));
  wizard.add_option("--until", arguments->until, "stop after this step")
      ->check(CLI::IsMember(wizardSteps()));
  wizard.add_option("--rigs", arguments->rigs, "where the accepted rig is kept with its evidence")
      ->type_name("DIR");
  wizard.add_flag("--no-window", arguments->no_window, "no window, even with a display");
  wizard.callback([arguments] { runCommand(*arguments); });
}

}  // namespace ringhook

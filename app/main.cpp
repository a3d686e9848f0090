// ringhook: one program, git-like subcommands. Exit codes: 0 success, 1 the job failed, 2 wrong
// use or bad input. This is the one place that prints an error.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "app/arm.h"
#include "app/calibrate.h"
#include "app/evaluate.h"
#include "app/interrupt.h"
#include "app/model.h"
#include "app/record.h"
#include "app/servo.h"
#include "app/simulate.h"
#include "core/error.h"

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Puts rings on hooks that travel and swing, guided by two cameras."};
  app.name("ringhook");
  app.set_version_flag("--version", RINGHOOK_VERSION);
  app.require_subcommand(0, 1);  // checked below: this way an unknown word is named
  app.footer("Example: ringhook servo --cycles 3 --tracker edges --out out/servo");
  ringhook::addServoCommand(app);
  ringhook::addArmCommand(app);
  ringhook::addCalibrateCommand(app);
  ringhook::addEvaluateCommand(app);
  ringhook::addModelCommand(app);
  ringhook::addRecordCommand(app);
  ringhook::addSimulateCommand(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : 2;
  }
  if (app.get_subcommands().empty()) {
    std::fprintf(
        stderr,
        "ringhook: a command is required: servo, arm, calibrate, evaluate, model, record or "
        "simulate\n"
        "Run with --help for more information.\n");
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ringhook::catchInterrupts();
  try {
    return run(argc, argv);
  } catch (const ringhook::Error& e) {
    std::fprintf(stderr, "ringhook: %s\n", e.what());
    return e.exitCode();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "ringhook: unexpected failure: %s\n", e.what());
    return 1;
  }
}

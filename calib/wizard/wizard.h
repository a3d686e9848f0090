#pragma once

/// \file
/// `ringhook calibrate wizard`: from two cameras and an arm to a cell file with evidence, one
/// question at a time. Five steps (steps.h): the cameras; the cameras and the robot; the delays; a
/// check with new pictures; the cell file.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/solve/stereo_images.h"
#include "calib/wizard/context.h"

namespace ringhook {

struct WizardOptions {
  std::filesystem::path session;  ///< folder; a session in it is taken up again
  // What the command line says already; the rest is asked.
  std::optional<std::filesystem::path> cell;
  std::optional<std::filesystem::path> images;
  std::optional<std::string> board;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> again;     ///< step to do anew, pictures included, and all after it
  std::optional<std::string> until;     ///< last step to do
  bool window = true;                   ///< show pictures in a window where there is a display
  std::filesystem::path default_cell;   ///< proposed
  std::filesystem::path accepted_rigs;  ///< where accepted results are kept
  std::string date;                     ///< of the result, ISO 8601
  std::string version;                  ///< of the program
};

/// Names of the steps that --again and --until take: stereo, robot, time, check.
const std::vector<std::string>& wizardSteps();

/// The pictures of the first step alone: pairs of a board from the cell's cameras, taken as the
/// wizard takes them and kept in `options.session`, which the wizard can go on with. Throws as
/// runWizard does.
StereoViews takeBoardPairs(const WizardOptions& options, Console& console,
                           const HookMaker& progress, const std::function<void()>& check);

/// Throws InputError for bad answers on the command line, Interrupted when the integrator leaves,
/// Error if a step cannot be brought to a good end, DeviceError.
void runWizard(const WizardOptions& options, Console& console, const HookMaker& progress,
               const std::function<void()>& check);

}  // namespace ringhook

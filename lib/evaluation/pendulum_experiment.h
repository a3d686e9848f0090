#pragma once

/// \file
/// The 2007 report's pendulum simulation (Jeyabalan, Fork project, section 5.2.2), repeated: 1 m,
/// 1 kg, steps of 0.05 s, released at 1 rad, D = 0 and D = 0.5. Its linear map stands beside the
/// exact solution and beside the physics of the simulated cell, and so does the cell's own hook,
/// hung in a vacuum without friction. The report's figures are lost; what it states is a period of
/// "indeed 2 sec" and no loss of energy without damping.

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "sim/pendulum_world.h"

namespace ringhook {

/// One way to know a pendulum; NaN where it has nothing to say.
struct PendulumRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string name;
  double period = kNone;         ///< [s]
  double energy_change = kNone;  ///< in the last minute, as a fraction of the energy at the start
  double angle_error = kNone;    ///< largest distance from the exact angle in the first 10 s [rad]
};

struct PendulumCase {
  std::string name;
  std::string key;            ///< of its table in the JSON
  double small_period = 0.0;  ///< of small undamped swings [s]
  double exact_period = 0.0;  ///< at this amplitude, undamped [s]
  std::vector<PendulumRow> rows;
};

struct PendulumExperiment {
  std::vector<PendulumCase> cases;
  /// Angle and rate 0.05 s apart for 20 s: [D = 0, D = 0.5][exact, simulated, report's map].
  std::vector<std::vector<std::vector<PendulumSample>>> traces;
};

/// Two minutes of the cell's time: about a quarter of a minute of work.
PendulumExperiment runPendulumExperiment();

/// What to print.
std::string pendulumTable(const PendulumExperiment& experiment);
/// Keys with units; absent where a row has nothing to say.
std::string pendulumJson(const PendulumExperiment& experiment);
/// summary.json, trajectories.csv and report.html. Throws InputError if the folder is no good.
void writePendulumOutputs(const std::filesystem::path& folder,
                          const PendulumExperiment& experiment);

}  // namespace ringhook

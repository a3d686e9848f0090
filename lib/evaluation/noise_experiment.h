#pragma once

/// \file
/// The 2007 report's third question to its filter (Jeyabalan, Fork project, section 6.3.3), which
/// it left to trial: what do the noise values do? Its motion is repeated: 21 positions along
/// y, 29.34 mm apart, one second each, measured with a standard deviation of 0.785 mm per axis (its
/// table 6.2), through its constant-acceleration filter (5.5), and each position is predicted one
/// step before. The filter is linear, so only the ratio of process to measurement noise acts, and
/// errors are proportional to the measurement noise: one curve tells all. Two kinds of process
/// noise: the report's diagonal, the same deviation for position [m], velocity [m/s] and
/// acceleration [m/s^2] in every step; and white jerk (Bar-Shalom, Li, Kirubarajan, 2001,
/// section 6.2.3), whose deviation is the square root of its density [m/s^2.5].
///
/// Without process noise the end is known in closed form: after n samples the prediction is the
/// least-squares parabola through all of them, one step on. With much of it the filter follows each
/// measurement and hardly averages.

#include <filesystem>
#include <string>
#include <vector>

namespace ringhook {

/// How the filter does with one ratio. Errors of the position against the truth, per axis, in units
/// of the measurement noise; over all seeds and axes.
struct NoiseRow {
  double ratio = 0.0;        ///< deviation of the process noise over that of the measurement
  double mean = 0.0;         ///< of the size of the one-step error, from the fourth position on
  double settled_rms = 0.0;  ///< root mean square of it over the last five positions
  int settled_after = 0;     ///< positions until it stays below 1.2 times that; 21: never before
  double nis = 0.0;          ///< mean per degree of freedom; 1 if the filter knows its noise
};

struct NoiseExperiment {
  std::vector<NoiseRow> diagonal;  ///< the report's noise
  std::vector<NoiseRow> jerk;      ///< white jerk
};

/// Deviation of one-step predictions by the parabola through the last `samples` >= 3 positions, in
/// units of the measurement noise.
[[nodiscard]] double parabolaDeviation(int samples);

/// 300 seeds a ratio: about a second of work.
[[nodiscard]] NoiseExperiment runNoiseExperiment();

/// What to print, in millimetres at the report's measurement noise.
[[nodiscard]] std::string noiseTable(const NoiseExperiment& experiment);
/// summary.json.
[[nodiscard]] std::string noiseJson(const NoiseExperiment& experiment);
/// summary.json, noise.csv and report.html. Throws InputError if the folder is no good.
void writeNoiseOutputs(const std::filesystem::path& folder, const NoiseExperiment& experiment);

}  // namespace ringhook

#pragma once

/// \file
/// How noisy the samples of a trajectory are, judged by themselves. The k-th difference of a smooth
/// motion vanishes with the time step to the power k, that of white noise of standard deviation s
/// has the variance s^2 binomial(2k, k) (von Neumann et al., "The mean square successive
/// difference", Annals of Mathematical Statistics 12, 1941, for k = 1). The least of the orders
/// 2 to 6 is taken: above it the noise alone is left. The median of the absolute values stands for
/// the deviation, so that single jumps do not count.

#include "evaluation/trajectory_file.h"

namespace ringhook {

/// Standard deviation of a number in a sample, root mean square over all that are measured [rad or
/// m]; samples are taken as evenly spaced. Where most differences are zero, because the file was
/// written with few digits, it is the rounding's. Never below 1e-9.
[[nodiscard]] double estimateSampleNoise(const Trajectory& trajectory);

}  // namespace ringhook

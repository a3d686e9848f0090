// The longer physics step of a cell in real time, held to the bounds of the usual one.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/angle.h"
#include "evaluation/hanging_hook.h"
#include "evaluation/pendulum_theory.h"
#include "sim/cell_server.h"
#include "sim/hook_body.h"

namespace ringhook {
namespace {

constexpr double kPi = std::numbers::pi;

CellOptions liveCell(double about_x, double about_y) {
  CellOptions options = hangingHookCell(about_x, about_y);
  options.physics_step = kLivePhysicsStep;
  return options;
}

TEST(LiveStep, AHookThatSwingsInBothPlanesKeepsItsEnergyForAMinute) {
  const double swing = 15.0 * kDegree;
  const HangingHookRun run = runHangingHook(liveCell(swing, swing), 60.0);
  const auto [least, most] = std::minmax_element(run.energy.begin(), run.energy.end());
  std::printf("energy within %.2e and %.2e of its start over 60 s\n",
              *least / run.energy.front() - 1.0, *most / run.energy.front() - 1.0);
  EXPECT_GT(*least, 0.9999 * run.energy.front());
  EXPECT_LT(*most, 1.0001 * run.energy.front());
}

TEST(LiveStep, AHookHasTheExactPeriodOfACompoundPendulum) {
  const HangingHookRun run = runHangingHook(liveCell(0.25, 0.0), 12.0);
  const double amplitude = turningPoints(run.about_x).front();
  const double exact = exactPeriod(2.0 * kPi / swingFrequency(0.450, 0), amplitude);
  std::printf("period %.2e from the exact one\n", measuredPeriod(run.about_x) / exact - 1.0);
  EXPECT_NEAR(measuredPeriod(run.about_x), exact, 2e-6 * exact);
}

}  // namespace
}  // namespace ringhook

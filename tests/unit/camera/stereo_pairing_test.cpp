#include "camera/stereo_pairing.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "camera/restart_spans.h"

namespace ringhook {
namespace {

MonoFrame frameAt(double time_s) {
  return {Time::fromSeconds(time_s), {0, 0, 2, 1}, GrayImage(2, 1)};
}

TEST(StereoPairing, PairsWhatWasExposedTogether) {
  StereoPairing pairing(0.005);
  pairing.add(0, frameAt(1.000));
  EXPECT_FALSE(pairing.take());
  pairing.add(1, frameAt(1.001));
  const auto pair = pairing.take();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->first.time, Time::fromSeconds(1.000));
  EXPECT_EQ(pair->second.time, Time::fromSeconds(1.001));
  EXPECT_FALSE(pairing.take());
}

TEST(StereoPairing, NeverPairsTwoExposures) {
  StereoPairing pairing(0.005);
  pairing.add(0, frameAt(1.00));  // its partner is lost
  pairing.add(0, frameAt(1.02));
  pairing.add(1, frameAt(1.02));
  const auto pair = pairing.take();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->first.time, pair->second.time);
  EXPECT_EQ(pairing.unpaired(0), 1);
  EXPECT_EQ(pairing.unpaired(1), 0);
}

TEST(StereoPairing, WaitsForALateImageAsLongAsItMayCome) {
  StereoPairing pairing(0.005);
  for (int i = 0; i < 5; ++i) {
    pairing.add(0, frameAt(0.02 * i));
    EXPECT_FALSE(pairing.take());
  }
  for (int i = 0; i < 5; ++i) {
    pairing.add(1, frameAt(0.02 * i));
    ASSERT_TRUE(pairing.take()) << i;
  }
  EXPECT_EQ(pairing.unpaired(0), 0);
}

TEST(StereoPairing, ASilentCameraDoesNotFillTheMemory) {
  StereoPairing pairing(0.005);
  for (int i = 0; i < 1000; ++i) {
    pairing.add(1, frameAt(0.02 * i));
  }
  EXPECT_EQ(pairing.unpaired(1), 1000 - 64);
}

TEST(StereoPairing, WhatStaysAloneDuringARestartIsNoLoss) {
  RestartSpans restarts;
  StereoPairing pairing(0.005, [&restarts](Time t) { return restarts.covers(t); });
  restarts.begin(Time::fromSeconds(2.00));
  restarts.end(Time::fromSeconds(2.04));
  restarts.begin(Time::fromSeconds(4.00));  // the end is not known yet
  for (const double alone_s : {1.99, 2.00, 2.02, 2.04, 3.99, 4.00}) {
    pairing.add(0, frameAt(alone_s));
  }
  pairing.add(1, frameAt(5.0));
  EXPECT_FALSE(pairing.take());
  EXPECT_EQ(pairing.unpaired(0), 3);
  EXPECT_EQ(pairing.excused(), 3);
}

TEST(StereoPairing, LossesOnBothSidesLeaveEveryCompletePair) {
  std::mt19937 random(7);
  std::bernoulli_distribution lost(0.2);
  StereoPairing pairing(0.005);
  int complete = 0;
  int alone[2] = {0, 0};
  std::vector<double> taken;
  std::vector<double> expected;
  for (int i = 0; i < 2000; ++i) {
    const bool has[2] = {!lost(random), !lost(random)};
    for (int side = 0; side < 2; ++side) {
      if (has[side]) {
        pairing.add(side, frameAt(0.02 * i + 0.001 * side));
        alone[side] += has[1 - side] ? 0 : 1;
      }
    }
    if (has[0] && has[1]) {
      ++complete;
      expected.push_back(0.02 * i);
    }
    while (const auto pair = pairing.take()) {
      taken.push_back(pair->first.time.seconds());
      EXPECT_NEAR(pair->second.time - pair->first.time, 0.001, 1e-9);
    }
  }
  ASSERT_EQ(taken.size(), expected.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    EXPECT_NEAR(taken[i], expected[i], 1e-9);
  }
  // Those after the last pair are still waiting.
  EXPECT_NEAR(static_cast<double>(pairing.unpaired(0)), alone[0], 5);
  EXPECT_NEAR(static_cast<double>(pairing.unpaired(1)), alone[1], 5);
}

}  // namespace
}  // namespace ringhook

// A short run of the fault campaign (tests/bench/rx60_fault_campaign.cpp is the long one).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/arm_mishaps.h"

namespace ringhook::test {
namespace {

TEST(Rx60Mishaps, NoneMovesTheArmWithoutARearmOrBreaksALimit) {
  MishapResult result;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    runMishaps(seed, 5, result);
  }
  EXPECT_THAT(result.violations, ::testing::IsEmpty());
  EXPECT_EQ(result.tallies.size(), static_cast<std::size_t>(Mishap::kCount)) << "all were dealt";
  EXPECT_GT(result.rearms, 100);
}

TEST(Rx60Mishaps, TheSameSeedTellsTheSameStory) {
  MishapResult one;
  MishapResult two;
  runMishaps(7, 10, one);
  runMishaps(7, 10, two);
  EXPECT_EQ(one.commands, two.commands);
  EXPECT_EQ(one.virtual_s, two.virtual_s);
}

}  // namespace
}  // namespace ringhook::test

#include "sim/line_faults.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ringhook {
namespace {

using Bytes = std::vector<std::byte>;

Time at(double seconds) { return Time::fromSeconds(seconds); }

/// `count` bytes beginning with `first`, each one more than the last.
Bytes numbered(int first, int count) {
  Bytes bytes;
  for (int i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::byte>(first + i));
  }
  return bytes;
}

/// Everything that ever arrives, and when.
struct Arrivals {
  Bytes bytes;
  std::vector<double> times;       ///< of each delivery [s]
  std::vector<std::size_t> sizes;  ///< of each delivery [bytes]
};

Arrivals drain(FaultyLine& line) {
  Arrivals all;
  while (const std::optional<Time> next = line.nextDelivery()) {
    const Bytes bytes = line.pop(*next);
    EXPECT_FALSE(bytes.empty()) << "nextDelivery() keeps its word";
    if (bytes.empty()) {
      break;
    }
    all.bytes.insert(all.bytes.end(), bytes.begin(), bytes.end());
    all.times.push_back(next->seconds());
    all.sizes.push_back(bytes.size());
  }
  return all;
}

/// 50 messages of 4 bytes, 4 ms apart, the bytes numbered through.
void pushMessages(FaultyLine& line) {
  for (int i = 0; i < 50; ++i) {
    line.push(numbered(4 * i, 4), at(0.004 * i));
  }
}

TEST(FaultyLine, WithoutFaultsDeliversAtOnce) {
  FaultyLine line;
  line.push(numbered(0, 4), at(1.0));
  EXPECT_EQ(line.nextDelivery(), at(1.0));
  EXPECT_EQ(line.pop(at(1.0)), numbered(0, 4));
  EXPECT_FALSE(line.nextDelivery());
  EXPECT_TRUE(line.pop(at(2.0)).empty());
}

TEST(FaultyLine, DelayIsTheSameForAll) {
  FaultyLine line;
  line.setFaults({.delay = 0.02});
  pushMessages(line);
  EXPECT_TRUE(line.pop(at(0.0199)).empty());
  const Arrivals all = drain(line);
  ASSERT_EQ(all.times.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(all.times[i], 0.004 * static_cast<double>(i) + 0.02, 1e-9);
  }
}

TEST(FaultyLine, JitterStaysInItsRangeAndKeepsTheOrder) {
  FaultyLine line(3);
  line.setFaults({.delay = 0.01, .jitter = 0.02});
  pushMessages(line);
  const Arrivals all = drain(line);
  EXPECT_EQ(all.bytes, numbered(0, 200));
  EXPECT_GE(all.times.front(), 0.01);
  EXPECT_LE(all.times.back(), 49 * 0.004 + 0.03);
  EXPECT_TRUE(std::is_sorted(all.times.begin(), all.times.end()));
  EXPECT_LT(all.times.size(), 50U) << "late ones are caught up with";
}

TEST(FaultyLine, SameSeedSameFate) {
  FaultyLine a(5);
  FaultyLine b(5);
  FaultyLine other(6);
  for (FaultyLine* line : {&a, &b, &other}) {
    line->setFaults({.jitter = 0.02, .loss = 0.2, .split_gap = 0.001});
    pushMessages(*line);
  }
  const Arrivals first = drain(a);
  const Arrivals second = drain(b);
  EXPECT_EQ(first.times, second.times);
  EXPECT_EQ(first.bytes, second.bytes);
  EXPECT_NE(first.times, drain(other).times);
}

TEST(FaultyLine, LossTakesWholeMessagesInItsShare) {
  FaultyLine line(1);
  line.setFaults({.loss = 0.3});
  int arrived = 0;
  for (int i = 0; i < 2000; ++i) {
    line.push(numbered(i, 4), at(0.004 * i));
    const Bytes bytes = line.pop(at(0.004 * i));
    ASSERT_TRUE(bytes.empty() || bytes == numbered(i, 4));
    arrived += bytes.empty() ? 0 : 1;
  }
  EXPECT_NEAR(arrived, 1400, 3 * 20.5) << "three standard deviations of the binomial";
}

TEST(FaultyLine, SplitMessagesComeInPiecesAndWhole) {
  FaultyLine line(2);
  line.setFaults({.split_gap = 0.0005});
  pushMessages(line);
  const Arrivals all = drain(line);
  EXPECT_EQ(all.bytes, numbered(0, 200));
  EXPECT_GE(all.times.size(), 100U) << "at least two pieces each";
  EXPECT_LE(all.times.size(), 200U);
}

TEST(FaultyLine, MergedMessagesArriveTogether) {
  FaultyLine line;
  line.setFaults({.merge = 0.02});
  pushMessages(line);
  const Arrivals all = drain(line);
  EXPECT_EQ(all.bytes, numbered(0, 200));
  ASSERT_EQ(all.times.size(), 11U);
  EXPECT_EQ(all.sizes[1], 20U) << "five messages";
  EXPECT_NEAR(all.times[1], 0.02, 1e-9);
}

TEST(FaultyLine, StallHoldsBackAndThenDeliversAll) {
  FaultyLine line;
  line.stall(at(0.05), 0.1);
  pushMessages(line);
  EXPECT_EQ(line.pop(at(0.149)), numbered(0, 4 * 13)) << "what came before 0.05 s";
  EXPECT_EQ(line.nextDelivery(), at(0.15));
  EXPECT_EQ(line.pop(at(0.15)), numbered(4 * 13, 4 * 25));
  EXPECT_EQ(drain(line).bytes, numbered(4 * 38, 4 * 12));
}

TEST(FaultyLine, HalfOpenSwallowsEverything) {
  FaultyLine line;
  line.setFaults({.delay = 0.01});
  line.push(numbered(0, 4), at(0.0));
  line.setFaults({.half_open = true});
  pushMessages(line);
  EXPECT_FALSE(line.nextDelivery());
  EXPECT_TRUE(line.pop(at(100.0)).empty());
}

TEST(FaultyLine, ClearForgetsWhatIsUnderWay) {
  FaultyLine line;
  line.setFaults({.delay = 1.0});
  line.push(numbered(0, 4), at(0.0));
  line.clear();
  line.setFaults({});
  line.push(numbered(8, 4), at(0.5));
  EXPECT_EQ(line.pop(at(0.5)), numbered(8, 4)) << "nor does its lateness remain";
}

}  // namespace
}  // namespace ringhook

// The link allocates nothing in the steady state. A program of its own, since it replaces the
// global operator new by one that counts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "robot/rx60/link.h"

namespace {
std::size_t allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace ringhook::rx60 {
namespace {

class SteadyLink {
 public:
  SteadyLink() {
    feedback_.valid_fields = 7;
    link_.opened(now_);
    cycle();
    give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, good_});
    for (int k = 0; k < 50; ++k) {
      cycle();
    }
  }
  /// One period: target, feedback, now and then a status, command, reply.
  void cycle() {
    now_ = now_ + 0.004;
    if (link_.armed()) {
      link_.setTarget(JointVector::Constant(0.05), now_);
    }
    feedback_.position[0] += 0.0002F;
    give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, feedback_});
    if (++cycles_ % 20 == 0) {
      give(Channel::kState, {CommType::kTopic, ReplyCode::kNone, good_});
    }
    link_.pass(now_);
    while (const auto out = link_.takeOutgoing()) {
      Message reply = decode(out->frame.bytes()).value();
      reply.comm = CommType::kReply;
      reply.reply = ReplyCode::kSuccess;
      give(out->channel, reply);
    }
  }
  [[nodiscard]] const Link& link() const { return link_; }

 private:
  void give(Channel channel, const Message& message) {
    const Frame frame = encode(message);
    std::copy(frame.bytes().begin(), frame.bytes().end(), link_.room(channel).begin());
    link_.received(channel, frame.bytes().size(), now_);
  }

  Link link_{LinkSettings()};
  Time now_ = Time::fromSeconds(1.0);
  JointFeedback feedback_;
  RobotStatus good_{1, 0, 0, 0, 0, PendantMode::kAutomatic, 1};
  int cycles_ = 0;
};

TEST(Rx60Link, AllocatesNothingInTheSteadyState) {
  SteadyLink steady;
  ASSERT_EQ(steady.link().state(), LinkState::kServoing);
  const std::int64_t sent = steady.link().report().commands;
  const std::size_t before = allocations;
  for (int k = 0; k < 5000; ++k) {
    steady.cycle();
  }
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_EQ(steady.link().report().commands - sent, 5000);
}

}  // namespace
}  // namespace ringhook::rx60

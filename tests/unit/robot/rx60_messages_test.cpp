// The wire against bytes written down by hand from the protocol's tables (ROS-Industrial
// simple_message; staubli_val3_driver's message definitions).

#include "robot/rx60/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "robot/rx60/frame_reader.h"

namespace ringhook::rx60 {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes bytesOf(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int value : values) {
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

/// Little-endian words, as a page of the protocol would list them.
Bytes wordsOf(std::initializer_list<std::uint32_t> words) {
  Bytes bytes;
  for (const std::uint32_t word : words) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<std::byte>((word >> shift) & 0xFFU));
    }
  }
  return bytes;
}

Bytes encoded(const Message& message) {
  const Frame frame = encode(message);
  return {frame.bytes().begin(), frame.bytes().end()};
}

/// One message of each kind with no field left at zero.
std::vector<Message> oneOfEach() {
  const WireJoints joints = {0.5F, -1.0F, 1.5F, -2.0F, 2.5F, -3.0F, 7.0F, 8.0F, 9.0F, 10.0F};
  const std::array<float, 6> six = {1.0F, -2.0F, 3.0F, -4.0F, 5.0F, -6.0F};
  return {
      {CommType::kTopic, ReplyCode::kNone, JointPosition{3, joints}},
      {CommType::kRequest, ReplyCode::kNone, JointTrajPt{4, joints, 0.25F, 2.0F}},
      {CommType::kTopic, ReplyCode::kNone, RobotStatus{1, 1, 23, 1, 1, PendantMode::kManual, 1}},
      {CommType::kTopic, ReplyCode::kNone, JointFeedback{1, 7, 0.5F, joints, joints, joints}},
      {CommType::kRequest, ReplyCode::kNone, SetDrivePower{1}},
      {CommType::kReply, ReplyCode::kFailure, WriteSingleIo{2, 5, 1}},
      {CommType::kReply, ReplyCode::kSuccess,
       VelocityCfg{VelocityKind::kToolFrame, six, six, 0.5F, 0.75F, 1.8F, 3.0F}},
      {CommType::kRequest, ReplyCode::kNone, VelocityCmd{-4, six, VelocityKind::kBaseFrame}}};
}

TEST(Rx60Messages, AVelocityCommandHasTheBytesOfTheProtocol) {
  VelocityCmd command;
  command.sequence = 7;
  command.velocity = {1.0F, -1.0F, 0.5F, 0.0F, 2.0F, -0.25F};
  EXPECT_EQ(encoded({CommType::kRequest, ReplyCode::kNone, command}),
            wordsOf({44, 1641, 2, 0, 7, 0x3F800000, 0xBF800000, 0x3F000000, 0, 0x40000000,
                     0xBE800000, 1}));
}

TEST(Rx60Messages, AnOutputIsWrittenWithASingleByteOfState) {
  Bytes expected = wordsOf({21, 1621, 2, 0, 0x01020304, 0xFFFFFFFF});
  expected.push_back(std::byte{1});
  EXPECT_EQ(encoded({CommType::kRequest, ReplyCode::kNone, WriteSingleIo{0x01020304, -1, 1}}),
            expected);
}

TEST(Rx60Messages, BodiesHaveTheSizesOfTheProtocol) {
  const std::vector<std::size_t> sizes = {44, 52, 28, 132, 1, 9, 68, 32};
  const std::vector<Message> messages = oneOfEach();
  for (std::size_t k = 0; k < messages.size(); ++k) {
    EXPECT_EQ(encoded(messages[k]).size(), 16 + sizes[k]) << nameOf(typeOf(messages[k].body));
  }
}

TEST(Rx60Messages, EveryMessageComesBackAsItWas) {
  for (const Message& message : oneOfEach()) {
    const Outcome<Message> back = decode(encode(message).bytes());
    ASSERT_TRUE(back) << back.reason();
    EXPECT_EQ(*back, message);
  }
}

TEST(Rx60Messages, AStatusIsReadFromItsBytes) {
  const Outcome<Message> status = decode(wordsOf({40, 13, 1, 0, 1, 0, 0, 0, 1, 2, 1}));
  ASSERT_TRUE(status);
  EXPECT_EQ(std::get<RobotStatus>(status->body),
            (RobotStatus{1, 0, 0, 0, 1, PendantMode::kAutomatic, 1}));
}

TEST(Rx60Messages, AnUnknownPendantModeCountsAsUnknown) {
  const Outcome<Message> status = decode(wordsOf({40, 13, 1, 0, 1, 0, 0, 0, 1, 9, 1}));
  ASSERT_TRUE(status);
  EXPECT_EQ(std::get<RobotStatus>(status->body).mode, PendantMode::kUnknown);
}

TEST(Rx60Messages, WhatIsNotUnderstoodIsRefusedWithWhatCame) {
  const std::vector<std::pair<Bytes, std::string>> cases = {
      {wordsOf({12, 1, 1, 0}), "unknown type 1 and length 12"},
      {wordsOf({148, 14, 2, 0}), "unknown type 14 and length 148"},
      {wordsOf({40, 1641, 2, 0}), "VELOCITY_CMD of length 40 instead of 44"},
      {wordsOf({0xFFFFFFFF, 13, 1, 0}), "STATUS of length -1 instead of 40"},
      {wordsOf({40, 13, 0, 0}), "STATUS with unknown comm type 0"},
      {wordsOf({40, 13, 3, 3}), "STATUS with unknown reply code 3"},
      {bytesOf({1, 2, 3}), "3 bytes, too short"},
      {wordsOf({40, 13, 1, 0, 1}), "20 bytes that announces 44"}};
  for (const auto& [bytes, words] : cases) {
    const Outcome<Message> message = decode(bytes);
    ASSERT_FALSE(message) << words;
    EXPECT_THAT(message.reason(), HasSubstr(words));
  }
}

TEST(Rx60Messages, JointsKeepTheirOrderAndSixSlots) {
  const JointVector q{{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
  const WireJoints wire = toWire(q);
  EXPECT_EQ(wire[0], 0.1F);
  EXPECT_EQ(wire[5], 0.6F);
  EXPECT_EQ(wire[6], 0.0F);
  EXPECT_LT((fromWire(wire) - q).cwiseAbs().maxCoeff(), 1e-7);
}

/// Feeds a stream in pieces of random size; the messages that came out.
std::vector<Message> throughReader(const Bytes& stream, std::uint32_t seed) {
  FrameReader reader;
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> piece(1, 200);
  std::vector<Message> out;
  for (std::size_t at = 0; at < stream.size();) {
    const std::span<std::byte> room = reader.room();
    const std::size_t count = std::min({piece(random), room.size(), stream.size() - at});
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(at), count, room.begin());
    reader.commit(count);
    at += count;
    for (auto next = reader.next(); next && *next; next = reader.next()) {
      out.push_back(**next);
    }
  }
  return out;
}

TEST(FrameReader, FindsEveryMessageWhereverTheStreamIsCut) {
  Bytes stream;
  std::vector<Message> sent;
  for (int round = 0; round < 40; ++round) {
    for (const Message& message : oneOfEach()) {
      const Bytes frame = encoded(message);
      stream.insert(stream.end(), frame.begin(), frame.end());
      sent.push_back(message);
    }
  }
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(throughReader(stream, seed), sent) << "seed " << seed;
  }
}

TEST(FrameReader, NeverRunsOutOfRoomWhileItsMessagesAreTaken) {
  FrameReader reader;
  const Bytes frame = encoded(oneOfEach()[3]);
  for (int k = 0; k < 1000; ++k) {
    const std::span<std::byte> room = reader.room();
    ASSERT_GE(room.size(), 2 * frame.size());
    std::copy(frame.begin(), frame.end(), room.begin());
    reader.commit(frame.size());
    const auto message = reader.next();
    ASSERT_TRUE(message && *message);
  }
}

TEST(FrameReader, RefusesAStreamThatLostItsFraming) {
  FrameReader reader;
  const Bytes noise(64, std::byte{0x5A});
  std::copy(noise.begin(), noise.end(), reader.room().begin());
  reader.commit(noise.size());
  EXPECT_FALSE(reader.next());
  reader.clear();
  const auto empty = reader.next();
  ASSERT_TRUE(empty);
  EXPECT_FALSE(empty->has_value());
}

TEST(FrameReader, RefusesALengthBeforeItWaitsForIt) {
  FrameReader reader;
  const Bytes huge = wordsOf({0x7FFFFFFF, 13, 1, 0});
  std::copy(huge.begin(), huge.end(), reader.room().begin());
  reader.commit(huge.size());
  EXPECT_FALSE(reader.next());
}

}  // namespace
}  // namespace ringhook::rx60

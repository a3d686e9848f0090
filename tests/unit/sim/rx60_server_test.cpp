// The simulated controller on real sockets of this host. What a test waits for it waits for on a
// socket, never for a time.

#include "sim/rx60_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "core/error.h"
#include "robot/rx60/tcp_port.h"
#include "rx60_bytes.h"

namespace ringhook {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// A raw client connection.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(rx60::connectTo("127.0.0.1", port, 5.0)) {}

  void send(const Bytes& bytes) const {
    EXPECT_EQ(::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  /// Waits for `count` bytes; fewer if the server closes.
  [[nodiscard]] Bytes receive(std::size_t count) const {
    Bytes bytes;
    while (bytes.size() < count) {
      pollfd waiting{socket_.get(), POLLIN, 0};
      ::poll(&waiting, 1, -1);
      Bytes room(count - bytes.size());
      const ssize_t got = ::recv(socket_.get(), room.data(), room.size(), 0);
      if (got <= 0) {
        break;
      }
      bytes.insert(bytes.end(), room.begin(), room.begin() + got);
    }
    return bytes;
  }

 private:
  FileDescriptor socket_;
};

/// A server on free ports, run by a thread of its own.
class Rx60Tcp : public ::testing::Test {
 protected:
  void start() {
    thread_ = std::thread([this] { server.run(stop_); });
  }
  void finish() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  void TearDown() override { finish(); }
  [[nodiscard]] std::uint16_t port(Rx60Socket socket) const { return server.port(socket); }

  KinematicPlant plant;
  Rx60Controller controller{plant};
  Rx60Server server{controller, {.ports = {0, 0, 0, 0}}};
  std::vector<std::string> events;  ///< to be read after finish()

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TEST_F(Rx60Tcp, StreamsStateToWhoeverConnects) {
  start();
  const Client state(port(Rx60Socket::kState));
  const std::vector<Sent> frames = split(state.receive(21 * 148 + 44));
  ASSERT_EQ(frames.size(), 22U);
  EXPECT_EQ(frames.front().type, 15);
  EXPECT_EQ(frames.back().type, 13);
}

TEST_F(Rx60Tcp, AnswersRequestsOnEveryPort) {
  start();
  const Client state(port(Rx60Socket::kState));
  const Client motion(port(Rx60Socket::kMotion));
  const Client system(port(Rx60Socket::kSystem));
  const Client io(port(Rx60Socket::kIo));
  static_cast<void>(state.receive(21 * 148 + 44));  // motion is possible by the wire
  motion.send(velocityCfg());
  system.send(drivePower(true));
  io.send(singleIo(2, 0, true));
  EXPECT_EQ(split(motion.receive(84)).front().reply, 1);
  EXPECT_EQ(split(system.receive(17)).front().type, 1610);
  EXPECT_EQ(split(io.receive(25)).front().reply, 1);
  finish();
  EXPECT_TRUE(plant.output(2, 0));
}

TEST_F(Rx60Tcp, AnsweringEachFeedbackMovesTheArm) {
  start();
  const Client state(port(Rx60Socket::kState));
  const Client motion(port(Rx60Socket::kMotion));
  static_cast<void>(state.receive(21 * 148 + 44));
  motion.send(velocityCfg());
  Bytes last;
  for (int i = 0; i < 100; ++i) {
    last = state.receive(148);
    if (i % 20 == 19) {
      static_cast<void>(state.receive(44));
    }
    motion.send(velocityCmd(i, {0.1}));
  }
  EXPECT_GT(split(last).front().f32(12), 0.0);
}

TEST_F(Rx60Tcp, SecondClientIsTurnedAway) {
  server.onEvent([this](Time, const std::string& what) { events.push_back(what); });
  start();
  const Client first(port(Rx60Socket::kIo));
  const Client second(port(Rx60Socket::kIo));
  EXPECT_TRUE(second.receive(1).empty()) << "closed";
  first.send(singleIo(2, 0, true));
  EXPECT_EQ(first.receive(25).size(), 25U) << "the first one is served";
  finish();
  EXPECT_THAT(events, ::testing::ElementsAre(HasSubstr("io: client connected from 127.0.0.1:"),
                                             HasSubstr("turned away"), HasSubstr("closed")));
}

TEST_F(Rx60Tcp, NextClientStartsAnew) {
  start();
  {
    const Client state(port(Rx60Socket::kState));
    EXPECT_EQ(state.receive(148).size(), 148U);
  }
  // Until the server has seen the first one go, it may turn the next away.
  Bytes bytes;
  while (bytes.empty()) {
    const Client state(port(Rx60Socket::kState));
    bytes = state.receive(148);
  }
  EXPECT_EQ(split(bytes).front().type, 15);
}

TEST_F(Rx60Tcp, CutClosesTheConnection) {
  server.onTick([this](Time) { server.cut(Rx60Socket::kMotion); });
  start();
  const Client motion(port(Rx60Socket::kMotion));
  EXPECT_TRUE(motion.receive(1).empty());
}

TEST_F(Rx60Tcp, FaultsOfItsLinesAreFelt) {
  server.toClient(Rx60Socket::kState).setFaults({.split_gap = 0.0002, .merge = 0.02});
  server.toController(Rx60Socket::kIo).setFaults({.delay = 0.01});
  start();
  const Client state(port(Rx60Socket::kState));
  const Client io(port(Rx60Socket::kIo));
  io.send(singleIo(2, 0, true));
  EXPECT_EQ(split(io.receive(25)).front().reply, 1);
  EXPECT_EQ(split(state.receive(21 * 148 + 44)).size(), 22U) << "the stream itself is the same";
}

TEST_F(Rx60Tcp, EndsByItselfAfterItsSeconds) {
  const std::atomic<bool> never{false};
  server.run(never, 0.05);
  EXPECT_GT(controller.counts().ticks, 0);
  EXPECT_LE(controller.counts().ticks + server.lateTicks(), 13) << "never two ticks for one";
}

TEST_F(Rx60Tcp, WorkAheadIsDoneAfterEachTickAndKnowsTheNextOne) {
  const std::atomic<bool> never{false};
  std::vector<Time> instants;
  std::vector<Time> next_ones;
  server.onTick([&](Time now) { instants.push_back(now); });
  server.afterTick([&](Time next) {
    EXPECT_EQ(next_ones.size() + 1, instants.size());
    EXPECT_EQ(controller.counts().ticks, static_cast<std::int64_t>(instants.size()));
    next_ones.push_back(next);
  });
  server.run(never, 0.05);
  ASSERT_EQ(next_ones.size(), instants.size());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    EXPECT_EQ(next_ones[i], instants[i] + Rx60Controller::kTick);
  }
}

TEST_F(Rx60Tcp, WorkThatTakesAllTheTimeCostsTicksAndThePriority) {
  server.onEvent([this](Time, const std::string& what) { events.push_back(what); });
  const std::atomic<bool> never{false};
  bool was_real_time = false;
  std::size_t turns = 0;
  server.afterTick([&](Time) {
    was_real_time = was_real_time || server.priority() == ThreadPriority::kRealTime;
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(10)) {
      ++turns;
    }
  });
  server.run(never, 0.5);
  EXPECT_GT(turns, 0U);
  EXPECT_GT(server.lateTicks(), controller.counts().ticks);
  EXPECT_NE(server.priority(), ThreadPriority::kRealTime);
  if (was_real_time) {
    EXPECT_THAT(events, ::testing::Contains(HasSubstr("real-time priority given back")));
  }
}

TEST(Rx60Server, PortInUseIsNamed) {
  KinematicPlant plant;
  Rx60Controller controller(plant);
  const Rx60Server first(controller, {.ports = {0, 0, 0, 0}});
  const std::uint16_t taken = first.port(Rx60Socket::kState);
  try {
    const Rx60Server second(controller, {.ports = {0, 0, taken, 0}});
    FAIL() << "two servers on one port";
  } catch (const DeviceError& e) {
    EXPECT_THAT(e.what(), HasSubstr("127.0.0.1"));
    EXPECT_THAT(e.what(), HasSubstr(std::to_string(taken)));
    EXPECT_THAT(e.what(), HasSubstr("in use"));
  }
}

TEST(Rx60Server, AddressThatIsNoneIsNamed) {
  KinematicPlant plant;
  Rx60Controller controller(plant);
  for (const char* address : {"localhost", "300.0.0.1", "", "192.0.2.1"}) {
    EXPECT_THROW(Rx60Server(controller, {.address = address, .ports = {0, 0, 0, 0}}), DeviceError)
        << address;
  }
}

}  // namespace
}  // namespace ringhook

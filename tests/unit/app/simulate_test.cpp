// `ringhook simulate` as a client on the network and a script meet it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../../support/scratch_folder.h"
#include "program.h"
#include "robot/rx60/tcp_port.h"

namespace ringhook {
namespace {

using test::Program;
using test::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kNetworkCell = RINGHOOK_SOURCE_DIR "/app/config/cell-network.yaml";

class Simulate : public ::testing::Test {
 protected:
  /// On free ports, with these arguments added.
  [[nodiscard]] static std::vector<std::string> onFreePorts(std::vector<std::string> more) {
    std::vector<std::string> all = {"simulate",      "--arm-only", "--motion-port", "0",
                                    "--system-port", "0",          "--state-port",  "0",
                                    "--io-port",     "0"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
    return test::runProgram(scratch_.path(), arguments);
  }
  void expectRefused(const std::vector<std::string>& arguments, const std::string& culprit) const {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(culprit));
    EXPECT_THAT(result.out, IsEmpty());
  }

  ScratchFolder scratch_;
};

TEST_F(Simulate, TellsWhereItListensAndWhatItSaw) {
  const ProgramResult result = run(onFreePorts({"--seconds", "0.1", "--json", "seen.json"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("listens on 127.0.0.1, ports motion "));
  EXPECT_THAT(result.out, HasSubstr("controller ticks of 4 ms"));
  const auto seen = nlohmann::json::parse(std::ifstream(scratch_.path() / "seen.json"));
  EXPECT_GT(seen.at("ticks"), 0);
  EXPECT_EQ(seen.at("travel_rad"), 0.0);
  EXPECT_TRUE(seen.at("received").empty());
}

TEST_F(Simulate, FaultsHappenOnTheirTime) {
  const ProgramResult result =
      run(onFreePorts({"--seconds", "0.1", "--fault", "e-stop@0.02:0.04", "--fault", "cut@0.04"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("e-stop begins"));
  EXPECT_THAT(result.err, HasSubstr("e-stop ends"));
  EXPECT_THAT(result.err, HasSubstr("cut begins"));
}

TEST_F(Simulate, ServesAClientUntilInterrupted) {
  Program program(scratch_.path(), onFreePorts({"--plant", "cell"}));
  ASSERT_TRUE(program.waitUntilItSays("\n"));
  const std::string said = program.saidSoFar();
  const std::uint16_t port =
      static_cast<std::uint16_t>(std::stoi(said.substr(said.find(", state ") + 8)));
  const int socket = rx60::connectTo("127.0.0.1", port, 5.0);
  ASSERT_TRUE(program.waitUntilItSays("state: client connected"));
  std::array<std::byte, 16> room{};
  pollfd waiting{socket, POLLIN, 0};
  ::poll(&waiting, 1, -1);
  ASSERT_EQ(::recv(socket, room.data(), room.size(), 0), 16);
  EXPECT_EQ(room[4], std::byte{15}) << "JOINT_FEEDBACK";
  program.signal(SIGINT);
  const ProgramResult result = program.wait();
  ::close(socket);
  EXPECT_EQ(result.exit_code, 0) << "the ordinary end";
  EXPECT_THAT(result.out, HasSubstr("controller ticks"));
}

TEST_F(Simulate, NeitherCellNorArmOnlyIsRefusedInOneSentence) {
  const ProgramResult result = run({"simulate"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--arm-only"));
  EXPECT_THAT(result.err, HasSubstr("--cell"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  expectRefused({"simulate", "--arm-only", "--cell", kNetworkCell}, "either --cell");
}

TEST_F(Simulate, ACellThatCannotBeServedIsNamed) {
  expectRefused({"simulate", "--cell", "nowhere.yaml"}, "nowhere.yaml");
  scratch_.write("empty.yaml", "");
  expectRefused({"simulate", "--cell", "empty.yaml"}, "empty.yaml");
  expectRefused({"simulate", "--cell", RINGHOOK_SOURCE_DIR "/app/config/cell-sim.yaml"},
                "expected network");
  expectRefused({"simulate", "--cell", kNetworkCell, "--scenario", "earthquake"}, "earthquake");
  expectRefused({"simulate", "--cell", kNetworkCell, "--lost-packets", "1.5"}, "--lost-packets");
  expectRefused({"simulate", "--cell", kNetworkCell, "--hooks", "0"}, "--hooks");
}

TEST_F(Simulate, WrongUseIsNamed) {
  expectRefused({"simulate", "--arm-only", "--fault", "earthquake@1"}, "earthquake");
  expectRefused({"simulate", "--arm-only", "--fault", "delay@soon"}, "delay@soon");
  expectRefused({"simulate", "--arm-only", "--state-port", "70000"}, "--state-port");
  expectRefused({"simulate", "--arm-only", "--state-port", "-1"}, "--state-port");
  expectRefused({"simulate", "--arm-only", "--address", "somewhere"}, "--address");
  expectRefused({"simulate", "--arm-only", "--plant", "rubber"}, "--plant");
  expectRefused({"simulate", "--arm-only", "--seconds", "0"}, "--seconds");
  scratch_.write("occupied", "a file\n");
  expectRefused({"simulate", "--arm-only", "--json", "occupied/seen.json"}, "occupied/seen.json");
}

TEST_F(Simulate, PortInUseIsNamed) {
  Program first(scratch_.path(), onFreePorts({}));
  ASSERT_TRUE(first.waitUntilItSays("\n"));
  const std::string said = first.saidSoFar();
  const std::string port = std::to_string(std::stoi(said.substr(said.find(", io ") + 5)));
  ScratchFolder other;
  const ProgramResult second =
      test::runProgram(other.path(), {"simulate", "--arm-only", "--motion-port", port});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("127.0.0.1"));
  EXPECT_THAT(second.err, HasSubstr(port));
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait().exit_code, 0);
}

}  // namespace
}  // namespace ringhook

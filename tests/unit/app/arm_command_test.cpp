// `ringhook arm` as the person who brings a cell into service meets it, against `ringhook simulate`
// as a process of its own. Motion itself is tested in virtual time (tests/contract).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <optional>

#include "../../support/scratch_folder.h"
#include "program.h"

namespace ringhook {
namespace {

using test::Program;
using test::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Words = std::vector<std::string>;

class ArmCommand : public ::testing::Test {
 protected:
  [[nodiscard]] ProgramResult run(const Words& arguments) const {
    return test::runProgram(scratch_.path(), arguments);
  }
  /// `arm STEP` at a served controller, with these arguments added.
  ProgramResult atController(const std::string& step, const Words& more, const Words& faults = {}) {
    serve(faults);
    Words all = {"arm", step};
    all.insert(all.end(), ports_.begin(), ports_.end());
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  /// What the controller saw, once it is told to end.
  std::string seen() {
    controller_->signal(SIGINT);
    return controller_->wait().out;
  }

 private:
  void serve(const Words& faults) {
    Words arguments = {"simulate"};
    for (const char* name : {"--motion-port", "--system-port", "--state-port", "--io-port"}) {
      arguments.insert(arguments.end(), {name, "0"});
    }
    arguments.emplace_back("--arm-only");
    arguments.insert(arguments.end(), faults.begin(), faults.end());
    controller_.emplace(scratch_.path(), arguments);
    ASSERT_TRUE(controller_->waitUntilItSays("io "));
    ASSERT_TRUE(controller_->waitUntilItSays("\n"));
    const std::string said = controller_->saidSoFar();
    for (const std::string name : {"motion", "system", "state", "io"}) {
      const std::size_t at = said.find(name + " ", said.find("ports")) + name.size() + 1;
      ports_.push_back("--" + name + "-port");
      ports_.push_back(std::to_string(std::stoi(said.substr(at))));
    }
  }

  ScratchFolder scratch_;
  std::optional<Program> controller_;
  Words ports_;
};

TEST_F(ArmCommand, WatchTellsStateJointsAndHealth) {
  const ProgramResult result = atController("watch", {"--seconds", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("idle"));
  EXPECT_THAT(result.out, HasSubstr("deg/s"));
  EXPECT_THAT(result.out, HasSubstr("jitter"));
}

TEST_F(ArmCommand, WatchTellsAFaultInWords) {
  const ProgramResult result = atController("watch", {"--seconds", "1"}, {"--fault", "e-stop@0.1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("last fault: the emergency stop is pressed"));
}

TEST_F(ArmCommand, WhatIsNotConfirmedDoesNotMove) {
  const ProgramResult result = atController("jog", {"--joint", "6"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("nothing was moved"));
  EXPECT_THAT(seen(), ::testing::ContainsRegex("way of the joint that moved most +0\\.0000 rad"));
}

TEST_F(ArmCommand, TheGripperIsAnOutput) {
  const ProgramResult result = atController("gripper", {"close"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("gripper closed"));
  EXPECT_THAT(seen(), ::testing::ContainsRegex("received WRITE_SINGLE_IO +1"));
}

TEST_F(ArmCommand, PowerIsARequestOnTheSystemPort) {
  const ProgramResult result = atController("power", {"off"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(seen(), ::testing::ContainsRegex("received SET_DRIVE_POWER +1"));
}

TEST_F(ArmCommand, AControllerWithoutVelocityControlIsRefused) {
  const ProgramResult result = atController("watch", {}, {"--no-velocity-addon"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("velocity extension"));
}

TEST_F(ArmCommand, AnglesOutsideTheRangesAreRefusedBeforeConnecting) {
  const ProgramResult result = run({"arm", "move", "--to-deg", "0,0,200,0,0,0"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, StartsWith("ringhook: arm move: --to-deg: "));
  EXPECT_THAT(result.err, HasSubstr("J3"));
  EXPECT_THAT(result.out, IsEmpty());
}

TEST_F(ArmCommand, NobodyThereIsNamed) {
  const ProgramResult result = run({"arm", "watch", "--state-port", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("127.0.0.1, port 1: Connection refused"));
}

TEST_F(ArmCommand, AStepIsRequired) {
  const ProgramResult result = run({"arm"});
  EXPECT_EQ(result.exit_code, 2);
}

}  // namespace
}  // namespace ringhook

#include "arm_contract.h"
#include "sim/sim_arm.h"

namespace ringhook {
namespace {

class SimArmUnderTest : public ArmUnderTest {
 public:
  Arm& arm() override { return arm_; }
  [[nodiscard]] int periodsToWakeUp() const override { return 1; }
  [[nodiscard]] int periodsToFollow() const override { return 1; }
  [[nodiscard]] int periodsToRest() const override { return 3; }

 private:
  CellWorld world_{CellOptions{}};
  SimArm arm_{world_};
};

std::unique_ptr<ArmUnderTest> makeSimArm() { return std::make_unique<SimArmUnderTest>(); }

INSTANTIATE_TEST_SUITE_P(Simulated, ArmContract, ::testing::Values(&makeSimArm));

}  // namespace
}  // namespace ringhook

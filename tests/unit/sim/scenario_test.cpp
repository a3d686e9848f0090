#include "sim/scenario.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"

namespace ringhook {
namespace {

std::filesystem::path written(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto path = std::filesystem::path(::testing::TempDir()) /
                    (std::string("scenario_").append(test->name()) + ".yaml");
  std::ofstream(path) << text;
  return path;
}

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(loadScenario(written(text)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Scenario, TheEasyOneIsTheDefaultCell) {
  const Scenario easy =
      loadScenario(std::filesystem::path(RINGHOOK_SOURCE_DIR) / "app/config/scenarios/easy.yaml");
  EXPECT_EQ(easy.name, "easy");
  EXPECT_DOUBLE_EQ(easy.cell.belt.speed, 0.05);
  EXPECT_NEAR(easy.cell.hook.swing_about_x, 0.0523599, 1e-6);
  EXPECT_EQ(easy.cell.hook.count, 3);
  EXPECT_DOUBLE_EQ(easy.cell.ring.clearance, 0.013);
}

TEST(Scenario, ConvertsDegreesAndKeepsDefaults) {
  const Scenario s = loadScenario(written("name: x\nhook: {swing_about_y_deg: 15}\n"));
  EXPECT_NEAR(s.cell.hook.swing_about_y, 0.2617994, 1e-7);
  EXPECT_DOUBLE_EQ(s.cell.belt.speed, CellOptions{}.belt.speed);
}

TEST(Scenario, NamesLineAndFieldOfAnUnknownKey) {
  const std::string what = complaint("name: x\nbelt:\n  speed_mm_s: 50\n");
  EXPECT_NE(what.find("line 3"), std::string::npos) << what;
  EXPECT_NE(what.find("belt.speed_mm_s"), std::string::npos) << what;
  EXPECT_NE(complaint("name: x\nbelts: {}\n").find("belts"), std::string::npos);
}

TEST(Scenario, RefusesValuesOutOfRangeOrOfTheWrongKind) {
  EXPECT_NE(complaint("name: x\nbelt: {speed_m_s: fast}\n").find("belt.speed_m_s"),
            std::string::npos);
  EXPECT_NE(complaint("name: x\nbelt: {speed_m_s: .nan}\n").find("0 to 1"), std::string::npos);
  EXPECT_NE(complaint("name: x\nhook: {count: 2.5}\n").find("whole"), std::string::npos);
  EXPECT_NE(complaint("name: x\nring: 3\n").find("ring"), std::string::npos);
}

TEST(Scenario, RefusesFilesThatAreNoScenario) {
  EXPECT_THROW(static_cast<void>(loadScenario("/nowhere/x.yaml")), InputError);
  EXPECT_NE(complaint("name: [").find("line"), std::string::npos);
  EXPECT_NE(complaint("belt: {speed_m_s: 0.1}\n").find("name"), std::string::npos);
  EXPECT_NE(complaint("").find("name"), std::string::npos);
}

}  // namespace
}  // namespace ringhook

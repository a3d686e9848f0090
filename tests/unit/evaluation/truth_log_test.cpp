#include "evaluation/truth_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "rig/stereo_rig.h"
#include "sim/cell_world.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// A table's rows, each a map from column name to text.
std::vector<std::map<std::string, std::string>> rowsOf(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    std::map<std::string, std::string> row;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (rows.empty() && names.size() == column && row.empty() && line.starts_with("time_s")) {
        names.push_back(cell);
      } else {
        row[names.at(column)] = cell;
      }
    }
    if (!row.empty()) {
      EXPECT_EQ(row.size(), names.size()) << file << ": " << line;
      rows.push_back(row);
    }
  }
  return rows;
}

/// Takes a ring, drops it, lets it fall to the floor and lie there; sampled every 10 ms.
void dropRing(const fs::path& folder, double until_s, const CellOptions& options = {}) {
  CellWorld world(options);
  TruthLog log(folder, world, disturbedRig(nominalRig(), options.seed));
  world.every(0.01, 0.0, [&](Time) { log.sample(); });
  world.setGripper(true);
  world.setJointVelocity(JointVector::Constant(0.1), 0.2);
  world.advanceTo(Time::fromSeconds(0.3));
  world.setGripper(false);
  world.advanceTo(Time::fromSeconds(until_s));
  log.commit();
}

TEST(TruthLog, TablesSayWhatTheWorldSaid) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "truth";
  CellWorld world{CellOptions{}};
  {
    TruthLog log(folder, world, nominalRig());
    world.setGripper(true);
    world.advanceTo(Time::fromSeconds(0.25));
    log.sample();
    log.commit();
  }
  const CellTruth now = truth(world);
  const auto hooks = rowsOf(folder / "hooks.csv");
  ASSERT_EQ(hooks.size(), now.hooks.size());
  EXPECT_EQ(hooks[1].at("time_s"), "0.250000000");
  EXPECT_EQ(hooks[1].at("hook"), "1");
  EXPECT_EQ(std::stod(hooks[0].at("x_m")), now.hooks[0].fMo.translation().x());
  EXPECT_EQ(std::stod(hooks[0].at("wx_rad_s")), now.hooks[0].twist_f[3]);
  EXPECT_EQ(std::stod(hooks[0].at("swing_about_y_rad")), now.hooks[0].swing_about_y);
  EXPECT_EQ(std::stod(hooks[2].at("pivot_y_m")), now.hooks[2].fMp.translation().y());
  const auto arm = rowsOf(folder / "arm.csv");
  ASSERT_EQ(arm.size(), 1U);
  EXPECT_EQ(std::stod(arm[0].at("j3_reported_rad")), world.jointReading()[2]);
  EXPECT_NE(arm[0].at("j3_true_rad"), arm[0].at("j3_reported_rad"));
  EXPECT_EQ(std::stod(arm[0].at("z_m")), now.fMe.translation().z());
  EXPECT_EQ(arm[0].at("gripper_closed"), "1");
  const auto rings = rowsOf(folder / "rings.csv");
  ASSERT_EQ(rings.size(), 1U) << "rings in the magazine are left out";
  EXPECT_EQ(rings[0].at("held"), "1");
}

TEST(TruthLog, CamerasStandInARigFileOfTheirOwn) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "truth";
  const StereoRig rig = disturbedRig(nominalRig(), 7);
  {
    const CellWorld world{CellOptions{}};
    TruthLog log(folder, world, rig);
    log.commit();
  }
  const StereoRig read = loadRig(folder / "cameras.yaml");
  EXPECT_TRUE(read.fMc1->isApprox(*rig.fMc1, 1e-12));
  EXPECT_TRUE(read.c2Mc1.isApprox(rig.c2Mc1, 1e-12));
}

TEST(TruthLog, AFallenRingLiesOnTheFloorWithItsWeight) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "truth";
  dropRing(folder, 3.0);
  const double wire = 0.003;
  const double radius = 0.013 + 0.0067 + wire;
  const double pi = 3.14159265358979;
  const double mass = 7850.0 * pi * wire * wire * 2.0 * pi * radius;
  double sum = 0.0;
  for (const auto& row : rowsOf(folder / "contacts.csv")) {
    if (std::stod(row.at("time_s")) > 2.001) {
      EXPECT_EQ(row.at("body_a"), "world");
      EXPECT_EQ(row.at("body_b"), "ring0");
      EXPECT_NEAR(std::stod(row.at("normal_z")), 1.0, 1e-9);
      EXPECT_NEAR(std::stod(row.at("z_m")), 0.0, 2e-3);
      sum += std::stod(row.at("normal_force_N"));
    }
  }
  EXPECT_NEAR(sum / 100.0, mass * 9.81, 0.02 * mass * 9.81);
}

/// A belt with ripple that starts and stops within the second, everything else as shipped.
CellOptions hurriedStopAndGo(std::uint64_t seed) {
  CellOptions options = loadScenario(std::filesystem::path(RINGHOOK_SOURCE_DIR) /
                                     "app/config/scenarios/stop-and-go.yaml")
                            .cell;
  options.seed = seed;
  options.belt.start_s = 0.05;
  options.belt.run_s = options.belt.stand_s = {0.5, 0.6};
  return options;
}

TEST(TruthLog, SameSeedWritesTheSameBytesAndAnotherOneOthers) {
  const ScratchFolder scratch;
  const fs::path first = scratch.path() / "first";
  const fs::path second = scratch.path() / "second";
  const fs::path other = scratch.path() / "other";
  dropRing(first, 1.2, hurriedStopAndGo(5));
  dropRing(second, 1.2, hurriedStopAndGo(5));
  dropRing(other, 1.2, hurriedStopAndGo(6));
  for (const char* name : {"hooks.csv", "rings.csv", "arm.csv", "contacts.csv", "cameras.yaml"}) {
    EXPECT_FALSE(textOf(first / name).empty()) << name;
    EXPECT_EQ(textOf(first / name), textOf(second / name)) << name;
    EXPECT_NE(textOf(first / name), textOf(other / name)) << name;
  }
}

TEST(TruthLog, WhatWasSampledBeforeAnExceptionIsKept) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "truth";
  try {
    CellWorld world{CellOptions{}};
    TruthLog log(folder, world, nominalRig());
    log.sample();
    log.sample();  // the same instant once more: no second row
    EXPECT_FALSE(fs::exists(folder / "arm.csv")) << "not under its name before the end";
    throw Error("the power failed");
  } catch (const Error&) {
    EXPECT_EQ(rowsOf(folder / "arm.csv").size(), 1U);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5);
}

TEST(TruthLog, RefusesAFolderThatCannotBeMade) {
  const CellWorld world{CellOptions{}};
  EXPECT_THROW(TruthLog("/proc/truth", world, nominalRig()), InputError);
}

}  // namespace
}  // namespace ringhook

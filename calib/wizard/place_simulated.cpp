#include <random>

#include "calib/wizard/place_devices.h"
#include "core/error.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "sim/sim_arm.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {
namespace {

/// The scenario's cell, made for pictures of things that stand still.
CellOptions stillCell(const CellConfig& cell, const Scenario& scenario,
                      const SimulatedPlaceOptions& chosen) {
  CellOptions options = scenario.cell;
  options.seed = chosen.seed;
  parkBelt(options);
  options.scene.board = {chosen.board.columns, chosen.board.rows, chosen.board.square_m,
                         Pose::Identity()};
  options.arm.initial_joints = cell.arm.standby_rad;
  return options;
}

/// The same value with every standard library.
double between(std::mt19937_64& bits, double low, double high) {
  return low + (high - low) * static_cast<double>(bits() >> 11U) * 0x1p-53;
}

struct Delays {
  double camera_s = 0.0;
  double arm_s = 0.0;
};

Delays drawDelays(const SimulatedPlaceOptions& chosen) {
  std::mt19937_64 bits(chosen.seed * 0x9e3779b97f4a7c15ULL + 5);
  const double camera_s = between(bits, 0.006, 0.014);
  const double arm_s = between(bits, 0.001, 0.007);
  return {chosen.camera_delay_s.value_or(camera_s), chosen.arm_delay_s.value_or(arm_s)};
}

Scenario scenarioOf(const CellConfig& cell) {
  if (cell.devices.kind != DeviceKind::kSimulated) {
    throw InputError(cell.file.string() +
                     ": field devices.kind: expected simulated for a simulated place");
  }
  return loadScenario(cell.devices.scenario);
}

/// The world, which has to outlive the devices in it.
struct StillWorld {
  StillWorld(const CellConfig& cell, const SimulatedPlaceOptions& options)
      : scenario(scenarioOf(cell)),
        delays(drawDelays(options)),
        world(stillCell(cell, scenario, options)) {
    world.holdBoard(std::nullopt);
  }

  [[nodiscard]] std::unique_ptr<SimStereoCamera> camera(std::uint64_t seed) {
    SimCameraOptions options = scenario.camera;
    options.transport_delay_s = delays.camera_s;
    return std::make_unique<SimStereoCamera>(
        world, disturbedRig(nominalRig(), seed, scenario.calibration), options);
  }

  Scenario scenario;
  Delays delays;
  CellWorld world;
};

class SimulatedPlace final : private StillWorld, public DevicePlace {
 public:
  SimulatedPlace(const CellConfig& cell, const SimulatedPlaceOptions& options)
      : StillWorld(cell, options),
        DevicePlace(cell, std::make_unique<SimArm>(world, delays.arm_s), camera(options.seed),
                    true),
        seed_(options.seed) {
    tellLateness([this] { return std::optional(delays.camera_s); });
  }

  [[nodiscard]] std::string name() const override {
    return "simulated cell, scenario " + scenario.name + ", seed " + std::to_string(seed_);
  }
  [[nodiscard]] bool canHoldBoard() const override { return true; }
  void holdBoard(const std::optional<Pose>& fMt) override { world.holdBoard(fMt); }

 private:
  std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<CalibrationPlace> openSimulatedPlace(const CellConfig& cell,
                                                     const SimulatedPlaceOptions& options) {
  if (options.board.columns < 2 || options.board.rows < 2 || !(options.board.square_m > 0.0)) {
    throw InputError("the simulated board: expected at least 2 x 2 inner corners and a square");
  }
  return std::make_unique<SimulatedPlace>(cell, options);
}

}  // namespace ringhook

#include "cell_views.h"

#include <array>
#include <cmath>
#include <random>

#include "calib/solve/board_grid.h"
#include "core/error.h"
#include "sim/cell_world.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"
#include "tests/support/measured_by_rig.h"

namespace ringhook {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr double kBar_m = 0.2;

// Facing the cameras, turned about an axis in its plane by `tilt` [rad] and rolled a little.
Pose heldAt(const Board& board, const Eigen::Vector3d& middle_f, double direction, double tilt) {
  Eigen::Matrix3d facing;
  facing << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  const Eigen::Vector3d axis(std::cos(direction), std::sin(direction), 0.0);
  Pose fMt = Pose::Identity();
  fMt.linear() = facing * Eigen::AngleAxisd(tilt, axis).toRotationMatrix() *
                 Eigen::AngleAxisd(0.3 * std::sin(direction), Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d middle_t(0.5 * board.pitch_m * (board.columns - 1),
                                 0.5 * board.pitch_m * (board.rows - 1), 0.0);
  fMt.translation() = middle_f - fMt.linear() * middle_t;
  return fMt;
}

}  // namespace

Board barBoard() { return parseBoard("chessboard:9x7:25mm"); }

Board workspaceBoard() { return parseBoard("chessboard:14x10:30mm"); }

StereoRig trueCellRig(std::uint64_t seed) { return disturbedRig(nominalRig(), seed); }

void renderViews(const Board& board, int count, std::uint64_t seed, std::uint64_t places_seed,
                 const std::function<void(int, const StereoFrame&)>& take) {
  CellOptions options;
  options.seed = seed;
  options.belt.speed = 0.0;
  options.scene.board = {board.columns, board.rows, board.pitch_m,
                         heldAt(board, {0.6, 0.0, 0.7}, 0.0, 0.0)};
  CellWorld world(options);
  SimCameraOptions camera_options;
  camera_options.rate_hz = 1.0 / kPeriod_s;
  SimStereoCamera camera(world, trueCellRig(seed), camera_options);
  std::mt19937_64 random(places_seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d middle(0.65 + 0.15 * uniform(random), 0.24 * uniform(random),
                                 0.7 + 0.26 * uniform(random));
    const double tilt = 0.35 + 0.35 * std::abs(uniform(random));
    world.holdBoard(heldAt(board, middle, 2.4 * i, tilt));
    while (camera.grab(0.0)) {
    }
    world.advanceTo(world.time() + 1.2 * kPeriod_s);
    const auto frame = camera.grab(0.0);
    if (!frame) {
      throw Error("the simulated camera delivers no frame");
    }
    take(i, *frame);
  }
}

std::vector<double> renderedBarErrors(const StereoRig& rig, int count, std::uint64_t seed) {
  const Board board = barBoard();
  std::vector<double> errors;
  renderViews(board, count, seed, seed + 1000, [&](int /*i*/, const StereoFrame& frame) {
    const auto left = findBoard(frame.left, board);
    const auto right = findBoard(frame.right, board);
    if (!left || !right || left->ids.size() != board.size() || right->ids.size() != board.size()) {
      return;
    }
    const BoardSighting ordered = orderedLike(*left, *right, board);
    for (int row = 0; row < board.rows; ++row) {
      std::array<Eigen::Vector3d, 2> ends;
      for (const int end : {0, 1}) {
        const std::size_t k = gridIndex(board, row, end * (board.columns - 1));
        ends[static_cast<std::size_t>(end)] =
            test::triangulatedBy(rig, left->pixels[k], ordered.pixels[k]);
      }
      errors.push_back((ends[1] - ends[0]).norm() - kBar_m);
    }
  });
  return errors;
}

double barError(const StereoRig& rig, const StereoRig& truth, double sigma_px, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  const Pose c1Mf = truth.fMc1->inverse();
  const Pose c2Mf = truth.c2Mc1 * c1Mf;
  double sum = 0.0;
  constexpr int kBars = 500;
  for (int i = 0; i < kBars; ++i) {
    const Eigen::Vector3d middle(0.42 + 0.1 * uniform(random), 0.3 * uniform(random),
                                 0.8 + 0.2 * uniform(random));
    const Eigen::Vector3d along =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    std::array<Eigen::Vector3d, 2> ends;
    for (std::size_t k = 0; k < 2; ++k) {
      const Eigen::Vector3d end = middle + (k == 0 ? -0.5 : 0.5) * kBar_m * along;
      const auto noise = [&]() -> Eigen::Vector2d {
        return sigma_px * Eigen::Vector2d(normal(random), normal(random));
      };
      const Eigen::Vector2d left = test::imageOf(truth.left, c1Mf * end) + noise();
      const Eigen::Vector2d right = test::imageOf(*truth.right, c2Mf * end) + noise();
      ends[k] = test::triangulatedBy(rig, left, right);
    }
    sum += std::pow((ends[1] - ends[0]).norm() - kBar_m, 2);
  }
  return std::sqrt(sum / kBars);
}

}  // namespace ringhook

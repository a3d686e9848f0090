// Robot-camera calibration from a small tag in one camera, made up so that arm, corners and camera
// model err as told: how often pairs left out change the weights, and what that does to the error
// of the result. Simulated; the corners are projected, not rendered.
//   hand_eye_weights --sets 100

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "calib/solve/plate_views.h"
#include "core/angle.h"
#include "core/error.h"
#include "tracking/plate_pose.h"

namespace ringhook {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Dice = std::mt19937_64;

constexpr double kSide = 0.048;  // of the tag as the calibration is told [m]
constexpr int kChecked = 40;     // places where the result is judged

struct Kind {
  const char* name;
  int views;
  double arm_m;      // error of the arm per axis
  double arm_deg;    // likewise
  double corner_px;  // noise per axis
  double focal;      // true over told, standard deviation from 1
  double centre_px;  // true minus told principal point, per axis
  double k1;         // true; told is 0
  double side;       // true over told, standard deviation from 1
  double one_m;      // the first view's arm is off by so much more
};

constexpr std::array kKinds{
    Kind{"8 views, arm 0.3 mm 0.1 deg", 8, 3e-4, 0.1, 0.1, 0, 0, 0, 0, 0},
    Kind{"8 views, arm 1 mm 0.3 deg", 8, 1e-3, 0.3, 0.1, 0, 0, 0, 0, 0},
    Kind{"8 views, corners 0.3 px", 8, 1e-3, 0.05, 0.3, 0, 0, 0, 0, 0},
    Kind{"8 views, arm 0.1 mm 0.02 deg", 8, 1e-4, 0.02, 0.1, 0, 0, 0, 0, 0},
    Kind{"20 views, arm 0.1 mm 0.02 deg", 20, 1e-4, 0.02, 0.1, 0, 0, 0, 0, 0},
    Kind{"20 views, arm 1 mm 0.3 deg", 20, 1e-3, 0.3, 0.1, 0, 0, 0, 0, 0},
    Kind{"8 views, wrong lens, arm 0.3 mm", 8, 3e-4, 0.1, 0.1, 0.005, 5, 0.05, 0, 0},
    Kind{"8 views, wrong lens, arm 1 mm", 8, 1e-3, 0.3, 0.1, 0.005, 5, 0.05, 0, 0},
    Kind{"20 views, wrong lens, arm 0.3 mm", 20, 3e-4, 0.1, 0.1, 0.005, 5, 0.05, 0, 0},
    Kind{"20 views, wrong lens, arm 1 mm", 20, 1e-3, 0.3, 0.1, 0.005, 5, 0.05, 0, 0},
    Kind{"8 views, tag off by 2 %", 8, 3e-4, 0.1, 0.1, 0, 0, 0, 0.02, 0},
    Kind{"8 views, one moved by 3 mm", 8, 1e-3, 0.3, 0.1, 0, 0, 0, 0, 3e-3},
    Kind{"8 views, lens and one moved", 8, 7e-4, 0.1, 0.1, 0.005, 5, 0.05, 0, 3e-3}};

Vector3d uniform(Dice& dice) {
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  const double x = draw(dice);
  const double y = draw(dice);
  return {x, y, draw(dice)};
}

double normal(Dice& dice) { return std::normal_distribution<double>()(dice); }

Twist armError(const Kind& kind, Dice& dice) {
  Twist d;
  for (int i = 0; i < 6; ++i) {
    d[i] = (i < 3 ? kind.arm_m : kind.arm_deg * kDegree) * normal(dice);
  }
  return d;
}

// One set: the truth that the calibration has to find, and the camera that it is not told.
struct Cell {
  const Kind& kind;
  Pose fMc1 = makePoseThetaU({0.95, -0.05, 0.48}, {-1.10, -1.11, 1.29});
  Pose eMt = Pose::Identity();
  PinholeView told{600, 600, 319.5, 239.5, 640, 480, Pose::Identity()};
  PinholeView camera = told;
  double k1 = 0.0;
  double side = kSide;

  Cell(const Kind& of, Dice& dice) : kind(of) {
    eMt = makePoseThetaU({0.02, 0.03, 0.05}, 0.5 * uniform(dice));
    camera.fx = camera.fy = told.fx * (1.0 + kind.focal * normal(dice));
    camera.cx += kind.centre_px * normal(dice);
    camera.cy += kind.centre_px * normal(dice);
    k1 = kind.k1 * normal(dice);
    side *= 1.0 + kind.side * normal(dice);
  }

  [[nodiscard]] Vector2d seen(const Vector3d& point_c) const {
    const Vector2d ray = point_c.head<2>() / point_c.z();
    const Vector2d bent = ray * (1.0 + k1 * ray.squaredNorm());
    return {camera.fx * bent.x() + camera.cx, camera.fy * bent.y() + camera.cy};
  }

  // The tag as the camera sees it at c1Mt, as far as it is in the image.
  [[nodiscard]] std::optional<CameraFeatures> features(const Pose& c1Mt, double noise_px,
                                                       Dice& dice) const {
    CameraFeatures features;
    features.camera = told;
    for (const auto& [x, y] : {std::pair{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}) {
      const Vector3d corner(x, y, 0.0);
      const Vector2d pixel = seen(c1Mt * (side * corner));
      if ((pixel.array() < 5.0).any() || pixel.x() > 634.0 || pixel.y() > 474.0) {
        return std::nullopt;
      }
      const Vector2d noise(normal(dice), normal(dice));
      features.corners.push_back({kSide * corner, pixel + noise_px * noise, 0.1});
    }
    return features;
  }
};

struct Shot {
  Pose c1Mt;  // where the arm believes the tag to be
  CameraFeatures seen;
};

Shot shoot(const Cell& cell, double more_m, bool noisy, Dice& dice) {
  for (;;) {
    const double z = 0.19 + 0.06 * uniform(dice).x();
    const Vector3d place = uniform(dice).cwiseProduct(Vector3d(0.25 * z, 0.2 * z, 0.0));
    const Vector3d turn = uniform(dice).cwiseProduct(Vector3d(0.45, 0.45, 1.2));
    Shot shot;
    shot.c1Mt = makePoseThetaU(place + Vector3d(0, 0, z), {M_PI, 0, 0}) *
                makePoseThetaU(Vector3d::Zero(), turn);
    Twist d = Twist::Zero();
    if (noisy) {
      d = armError(cell.kind, dice);
      d[0] += more_m;
    }
    if (auto seen = cell.features(shot.c1Mt * expSe3(d), noisy ? cell.kind.corner_px : 0.0, dice)) {
      shot.seen = *seen;
      return shot;
    }
  }
}

struct Errors {
  double rotation2 = 0.0;   // of the camera [rad^2]
  double workspace2 = 0.0;  // of tags that are seen, brought to the robot's reference [m^2]
};

// Sums over sets: each way to weigh, and the one that was taken.
struct Tally {
  std::array<Errors, 4> errors{};
  std::array<int, 3> taken{};
  int sets = 0;
};

void add(const Cell& cell, const Pose& fMc1, const std::vector<std::pair<Pose, Pose>>& checks,
         Errors& errors) {
  const double angle = thetaU(fMc1.linear().transpose() * cell.fMc1.linear()).norm();
  errors.rotation2 += angle * angle;
  for (const auto& [truth, seen] : checks) {
    errors.workspace2 +=
        (fMc1 * seen.translation() - cell.fMc1 * truth.translation()).squaredNorm() /
        static_cast<double>(checks.size());
  }
}

void runOne(const Kind& kind, unsigned seed, Tally& tally) {
  Dice dice(seed);
  const Cell cell(kind, dice);
  std::vector<PlateView> views;
  for (int i = 0; i < kind.views; ++i) {
    const Shot shot = shoot(cell, i == 0 ? kind.one_m : 0.0, true, dice);
    PlateView view{std::to_string(i), cell.fMc1 * shot.c1Mt * cell.eMt.inverse(), {}};
    view.seen.cameras = {shot.seen};
    view.seen.c1Mo_start = shot.c1Mt;
    views.push_back(view);
  }
  std::vector<std::pair<Pose, Pose>> checks;
  for (int i = 0; i < kChecked; ++i) {
    const Shot shot = shoot(cell, 0.0, false, dice);
    checks.emplace_back(shot.c1Mt, refineOnCorners({shot.seen}, shot.c1Mt));
  }
  const HandEyeResult result = calibrateFromViews(views, EyeSetup::kEyeToHand, ZeroChoice::kKeep,
                                                  [](double, const std::string&) {})
                                   .result;
  if (result.weighings.size() != tally.taken.size()) {
    std::printf("%s, seed %u: not compared (%s)\n", kind.name, seed,
                result.verdict.sentence.c_str());
    return;
  }
  ++tally.sets;
  ++tally.taken[static_cast<std::size_t>(result.weights)];
  for (std::size_t i = 0; i < tally.taken.size(); ++i) {
    add(cell, result.weighings[i].pose.camera, checks, tally.errors[i]);
  }
  add(cell, result.pose.camera, checks, tally.errors[3]);
}

int campaign(unsigned sets) {
  std::printf("%-34s %5s %17s   %s\n%-34s %5s %5s %5s %5s   %15s %15s %15s %15s\n", "", "", "taken",
              "camera's rotation off by [deg] and seen tags in f by [mm], RMS", "kind", "sets",
              "views", "pairs", "rot.", "views", "pairs", "rot. first", "taken");
  for (const Kind& kind : kKinds) {
    Tally tally;
    for (unsigned seed = 0; seed < sets; ++seed) {
      runOne(kind, seed, tally);
    }
    std::printf("%-34s %5d %5d %5d %5d  ", kind.name, tally.sets, tally.taken[0], tally.taken[1],
                tally.taken[2]);
    for (const Errors& e : tally.errors) {
      std::printf("  %6.4f %7.4f", std::sqrt(e.rotation2 / tally.sets) / kDegree,
                  1e3 * std::sqrt(e.workspace2 / tally.sets));
    }
    std::printf("\n");
  }
  return 0;
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("Weights of robot-camera calibration, on made-up sets");
  unsigned sets = 100;
  app.add_option("--sets", sets, "of each kind")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return ringhook::campaign(sets);
  } catch (const ringhook::Error& e) {
    std::fprintf(stderr, "hand_eye_weights: %s\n", e.what());
    return 1;
  }
}

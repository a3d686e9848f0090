// How small a change `calibrate verify` finds, and how often it cries wolf: seeded views of rigs
// that were disturbed by a known amount. Use: verify_campaign [TRIALS]

#include <cstdio>
#include <cstdlib>
#include <string>

#include "calib/solve/verify.h"
#include "calib_check/verify_scene.h"
#include "core/angle.h"

namespace {

using namespace ringhook;

struct Row {
  std::string what;
  StereoRig rig;
};

void print(const Row& row, int trials) {
  for (const int views : {5, 10, 20}) {
    int ok = 0, moved = 0, recalibrate = 0;
    double cost = 0.0;
    for (int i = 0; i < trials; ++i) {
      const Verification v =
          verifyRig(acceptedRig(),
                    viewsBy(row.rig, views, 0.05, static_cast<std::uint64_t>(1000 * views + i)));
      ok += v.state == RigState::kOk;
      moved += v.state == RigState::kMoved;
      recalibrate += v.state == RigState::kRecalibrate;
      cost += v.moved.cost_m / trials;
    }
    std::printf("%-28s %5d %8d %8d %12d %9.3f\n", row.what.c_str(), views, ok, moved, recalibrate,
                1e3 * cost);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int trials = argc > 1 ? std::atoi(argv[1]) : 100;
  std::printf("%-28s %5s %8s %8s %12s %9s\n", "change of the right camera", "views", "ok", "moved",
              "recalibrate", "cost_mm");
  print({"none", acceptedRig()}, trials);
  for (const double degrees : {0.005, 0.01, 0.02, 0.05}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d turn = degrees * kDegree * Eigen::Vector3d::Unit(axis);
      print({std::to_string(degrees).substr(0, 5) + " deg about " + "xyz"[axis],
             movedRig(turn, {0, 0, 0})},
            trials);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    print({std::string("0.2 mm along ") + "xyz"[axis],
           movedRig({0, 0, 0}, 0.2e-3 * Eigen::Vector3d::Unit(axis))},
          trials);
  }
  for (const double share : {0.0005, 0.002}) {
    StereoRig rig = acceptedRig();
    rig.right->K.topLeftCorner<2, 2>() *= 1.0 + share;
    print({"focal length +" + std::to_string(100 * share).substr(0, 4) + " %", rig}, trials);
  }
  return 0;
}

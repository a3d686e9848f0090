#include "rendered_cell.h"

#include "core/error.h"
#include "rig/rectifier.h"
#include "robot/rx60/kinematics.h"
#include "sim/arm_visuals.h"
#include "sim/cell_draw.h"
#include "sim/nominal_rig.h"
#include "sim/scenario.h"
#include "stereo/triangulation.h"
#include "tests/support/measured_by_rig.h"
#include "tracking/marker_tracker.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

const char* const kSource = RINGHOOK_SOURCE_DIR;

CellConfig easyCell() { return loadCellConfig(std::string(kSource) + "/app/config/cell-sim.yaml"); }

}  // namespace

RenderedCell::RenderedCell(std::uint64_t seed) : seed_(seed), told_(nominalRig()) {
  SimulatedPlaceOptions options;
  options.seed = seed;
  place_ = openSimulatedPlace(easyCell(), options);
}

Pose RenderedCell::facing(const Vector3d& position_f, const Vector3d& turn_e) {
  Eigen::Matrix3d fRe;  // z_e along x_f, x_e down
  fRe << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  Pose fMe = Pose::Identity();
  fMe.linear() = fRe * makePoseThetaU(Vector3d::Zero(), turn_e).linear();
  fMe.translation() = position_f;
  return fMe;
}

std::optional<PlateView> RenderedCell::look(const Pose& fMe) {
  const Outcome<Pose> reached = place_->moveFlange(fMe);
  if (!reached) {
    return std::nullopt;
  }
  const auto frame = place_->takePair();
  if (!frame) {
    return std::nullopt;
  }
  static const Rectifier rectifier(nominalRig());
  MarkerTracker tracker(
      loadTagPlate(std::string(kSource) + "/datasets/models/gripper/marker.yaml"));
  const auto seen = tracker.track(rectifier.rectify(*frame), std::nullopt);
  if (!seen || seen->cameras.size() != 2) {
    return std::nullopt;
  }
  return PlateView{"pose", *reached, *seen};
}

std::vector<PlateView> RenderedCell::cube(double side_m) {
  std::vector<PlateView> views;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                        (corner & 4) != 0 ? 0.5 : -0.5);
    auto view = look(facing(Vector3d(0.30, 0.0, 0.62) + side_m * sign, Vector3d::Zero()));
    if (!view) {
      throw Error("corner " + std::to_string(corner) + " of the cube is out of reach or sight");
    }
    view->name = "corner " + std::to_string(corner);
    views.push_back(*view);
  }
  return views;
}

std::vector<PlateView> RenderedCell::around(int count, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  const auto draw = [&dice](double most) {
    return most * (2.0 * static_cast<double>(dice() >> 11U) * 0x1p-53 - 1.0);
  };
  std::vector<PlateView> views;
  for (int tries = 0; tries < 20 * count && static_cast<int>(views.size()) < count; ++tries) {
    const Vector3d place(0.30 + draw(0.10), draw(0.18), 0.62 + draw(0.12));
    const Vector3d turn(draw(0.6), draw(0.6), draw(0.6));
    if (auto view = look(facing(place, turn))) {
      view->name = "pose " + std::to_string(views.size());
      view->joints = place_->armState()->position;
      views.push_back(*view);
    }
  }
  return views;
}

std::vector<PointPair> RenderedCell::pointsOf(const std::vector<PlateView>& views) {
  std::vector<PointPair> points;
  for (const PlateView& view : views) {
    const CameraFeatures& left = view.seen.cameras[0];
    const CameraFeatures& right = view.seen.cameras[1];
    Vector3d middle = Vector3d::Zero();
    Vector3d model = Vector3d::Zero();
    double n = 0.0;
    for (const CornerFeature& a : left.corners) {
      for (const CornerFeature& b : right.corners) {
        if (a.point_o == b.point_o) {
          const auto point =
              triangulateOptimal(left.camera, right.camera, a.pixel, b.pixel, a.sigma_px);
          if (!point) {
            throw Error(view.name + ": " + point.reason());
          }
          middle += point->point_c1;
          model += a.point_o;
          n += 1.0;
        }
      }
    }
    points.push_back({view.name, view.fMe * (eMg() * (model / n)), middle / n});
  }
  return points;
}

StereoRig RenderedCell::trueRig() const {
  const CellConfig cell = easyCell();
  return disturbedRig(told_, seed_, loadScenario(cell.devices.scenario).calibration);
}

Pose RenderedCell::trueCamera() const { return *trueRig().fMc1; }

Pose RenderedCell::trueTarget() { return eMg(); }

JointVector RenderedCell::trueZeros() const {
  CellOptions options = loadScenario(easyCell().devices.scenario).cell;
  options.seed = seed_;
  return drawCell(options).zero_error;
}

double RenderedCell::ringError(const Pose& fMc1, const JointVector& zeros_rad) const {
  constexpr int kPlaces = 200;
  const CellConfig cell = easyCell();
  const StereoRig true_rig = trueRig();
  const Pose c1Mf = trueCamera().inverse();
  rx60::Geometry real = rx60::rx60();
  rx60::Geometry found = rx60::rx60();
  real.zero = trueZeros();
  found.zero = zeros_rad;
  const Pose standby = rx60::forward(rx60::rx60(), cell.arm.standby_rad);
  std::mt19937_64 dice(seed_);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double sum = 0.0;
  for (int places = 0; places < kPlaces;) {
    Pose fMe = standby;  // travel along the belt, height, swing
    fMe.translation() += Vector3d(0.05 * unit(dice), 0.3 * unit(dice), 0.1 * unit(dice));
    fMe.linear() *= makePoseThetaU(Vector3d::Zero(), {0.15 * unit(dice), 0, 0}).linear();
    const auto q = rx60::nearestInverse(rx60::rx60(), rx60::limits(), fMe, cell.arm.standby_rad);
    if (!q) {
      continue;  // beyond the arm's reach
    }
    const Vector3d said = (rx60::forward(found, *q) * cell.arm.eMr).translation();
    const Vector3d is = (rx60::forward(real, *q) * cell.arm.eMr).translation();
    sum += (fMc1 * test::measuredBy(told_, true_rig, c1Mf * is) - said).squaredNorm();
    ++places;
  }
  return std::sqrt(sum / kPlaces);
}

}  // namespace ringhook

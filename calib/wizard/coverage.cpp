#include "calib/wizard/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/hook_values.h"
#include "rig/camera_model.h"
#include "stereo/plate_pose.h"

namespace ringhook {
namespace {

constexpr double kFlatWithin = std::numbers::pi / 15.0;  // [rad]
constexpr double kHeldTilt = std::numbers::pi / 6.0;     // [rad]
constexpr int kFewestPairs = 12;
constexpr int kFewestThirds = 8;
constexpr double kLeastSpread = 1.35;  // largest over smallest
// Before the belt and what hangs from it, which would hide the board.
constexpr std::array<double, kDistances> kShareOfWorkingDistance = {0.6, 0.72, 0.85};
constexpr double kMarginPx = 25.0;  // to the image's border
constexpr std::array<int, kImageThirds> kOrder = {4, 0, 8, 2, 6, 1, 7, 3, 5};

int thirdOf(const Eigen::Vector2d& pixel, int width, int height) {
  const auto part = [](double at, int size) {
    return std::clamp(static_cast<int>(3.0 * at / size), 0, 2);
  };
  return 3 * part(pixel.y(), height) + part(pixel.x(), width);
}

/// Tilt from the print's normal in the camera; z_t looks away from it.
Tilt tiltOf(const Eigen::Vector3d& normal) {
  if (std::acos(std::clamp(normal.z(), -1.0, 1.0)) < kFlatWithin) {
    return Tilt::kFlat;
  }
  // The normal's x > 0: going right along the board leads towards the camera.
  if (std::abs(normal.x()) > std::abs(normal.y())) {
    return normal.x() > 0.0 ? Tilt::kLeftAway : Tilt::kRightAway;
  }
  return normal.y() > 0.0 ? Tilt::kTopAway : Tilt::kBottomAway;
}

/// z_t in the direction of sight's frame: 0, 0, 1 for a board seen straight on.
Eigen::Vector3d normalTowardsSight(const StereoView& view, const Board& board, double focal_px) {
  CameraFeatures features;
  features.camera = {focal_px,          focal_px,   0.5 * view.width,
                     0.5 * view.height, view.width, view.height};
  const auto points = board.points();
  for (std::size_t i = 0; i < view.left.ids.size(); ++i) {
    features.corners.push_back(
        {points[static_cast<std::size_t>(view.left.ids[i])], view.left.pixels[i], 0.1});
  }
  const auto pose = planarStartPose({features});
  if (!pose) {
    return Eigen::Vector3d::UnitZ();
  }
  Eigen::Vector3d normal = pose->linear().col(2);
  if (normal.z() < 0.0) {
    normal = -normal;  // boards whose rows count upwards
  }
  const Eigen::Quaterniond to_axis =
      Eigen::Quaterniond::FromTwoVectors(pose->translation(), Eigen::Vector3d::UnitZ());
  return to_axis * normal;
}

std::string tiltWords(Tilt tilt) {
  switch (tilt) {
    case Tilt::kFlat:
      return "facing the cameras";
    case Tilt::kLeftAway:
      return "its left edge tilted away by about 30 degrees";
    case Tilt::kRightAway:
      return "its right edge tilted away by about 30 degrees";
    case Tilt::kTopAway:
      return "its top edge tilted away by about 30 degrees";
    case Tilt::kBottomAway:
      return "its bottom edge tilted away by about 30 degrees";
  }
  return {};
}

std::string thirdWords(int third) {
  constexpr std::array<const char*, kImageThirds> kWords = {"upper left", "top",    "upper right",
                                                            "left side",  "middle", "right side",
                                                            "lower left", "bottom", "lower right"};
  return kWords.at(static_cast<std::size_t>(third));
}

template <std::size_t N>
int leastOf(const std::array<int, N>& counts, int after) {
  int best = after % static_cast<int>(N);
  for (std::size_t i = 0; i < N; ++i) {
    const auto at = static_cast<int>((static_cast<std::size_t>(after) + i) % N);
    if (counts.at(static_cast<std::size_t>(at)) < counts.at(static_cast<std::size_t>(best))) {
      best = at;
    }
  }
  return best;
}

Eigen::Matrix3d turnOf(Tilt tilt) {
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  switch (tilt) {
    case Tilt::kFlat:
      return Eigen::Matrix3d::Identity();
    case Tilt::kLeftAway:
      return about(kHeldTilt, Eigen::Vector3d::UnitY());
    case Tilt::kRightAway:
      return about(-kHeldTilt, Eigen::Vector3d::UnitY());
    case Tilt::kTopAway:
      return about(-kHeldTilt, Eigen::Vector3d::UnitX());
    case Tilt::kBottomAway:
      return about(kHeldTilt, Eigen::Vector3d::UnitX());
  }
  return Eigen::Matrix3d::Identity();
}

/// Distance from the left camera at which both optical axes come nearest [m].
double vergenceDistance(const StereoRig& rig) {
  const Eigen::Vector3d right_axis = rig.c2Mc1.linear().transpose().col(2);
  const Eigen::Vector3d right_centre = rig.c2Mc1.inverse().translation();
  const double along = right_axis.z();
  const double across = 1.0 - along * along;
  const double baseline = right_centre.norm();
  if (across < 1e-4) {
    return 4.0 * baseline;  // parallel axes: where most rigs work
  }
  const double d = (right_centre.z() - along * right_centre.dot(right_axis)) / across;
  return std::clamp(d, baseline, 20.0 * baseline);
}

bool bothShowAll(const Pose& c1Mt, const StereoRig& rig, const Board& board) {
  for (const Eigen::Vector3d& point : board.points()) {
    for (const double dx : {-board.pitch_m, board.pitch_m}) {
      for (const double dy : {-board.pitch_m, board.pitch_m}) {
        const Eigen::Vector3d p1 = c1Mt * (point + Eigen::Vector3d(dx, dy, 0.0));
        const Eigen::Vector3d p2 = rig.c2Mc1 * p1;
        const auto shows = [](const CameraModel& camera, const Eigen::Vector3d& p) {
          if (p.z() <= 0.0) {
            return false;
          }
          const Eigen::Vector2d px = projectNormalised(camera, p.hnormalized());
          return px.x() > kMarginPx && px.y() > kMarginPx && px.x() < camera.width - kMarginPx &&
                 px.y() < camera.height - kMarginPx;
        };
        if (!shows(rig.left, p1) || !shows(*rig.right, p2)) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace

Appearance appearanceOf(const StereoView& view, const Board& board, double focal_px) {
  Appearance seen;
  const std::array<const BoardSighting*, 2> sides = {&view.left, &view.right};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    for (const Eigen::Vector2d& pixel : sides.at(side)->pixels) {
      seen.thirds.at(side).at(static_cast<std::size_t>(thirdOf(pixel, view.width, view.height))) =
          true;
    }
  }
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  const auto count = static_cast<double>(view.left.pixels.size());
  for (const Eigen::Vector2d& pixel : view.left.pixels) {
    centre += pixel / count;
  }
  for (const Eigen::Vector2d& pixel : view.left.pixels) {
    spread += (pixel - centre) * (pixel - centre).transpose() / count;
  }
  seen.centre_third = thirdOf(centre, view.width, view.height);
  // A filled rectangle has a variance of a twelfth of its side squared.
  seen.size = std::sqrt(12.0 * std::sqrt(std::max(0.0, spread.determinant()))) / view.width;
  seen.tilt = tiltOf(normalTowardsSight(view, board, focal_px));
  return seen;
}

void Coverage::add(const Appearance& seen) {
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t third = 0; third < kImageThirds; ++third) {
      thirds.at(side).at(third) += seen.thirds.at(side).at(third) ? 1 : 0;
    }
  }
  ++centres.at(static_cast<std::size_t>(seen.centre_third));
  ++tilts.at(static_cast<std::size_t>(seen.tilt));
  smallest = pairs == 0 ? seen.size : std::min(smallest, seen.size);
  largest = std::max(largest, seen.size);
  ++pairs;
}

std::string Coverage::lacking() const {
  if (pairs < kFewestPairs) {
    return std::to_string(kFewestPairs - pairs) + " more pairs at least";
  }
  for (std::size_t side = 0; side < 2; ++side) {
    const auto seen =
        std::count_if(thirds.at(side).begin(), thirds.at(side).end(), [](int n) { return n > 0; });
    if (seen < kFewestThirds) {
      return std::string("the board in more parts of the ") + (side == 0 ? "left" : "right") +
             " image";
    }
  }
  for (std::size_t tilt = 1; tilt < kTilts; ++tilt) {
    if (tilts.at(tilt) == 0) {
      return "the board with " + tiltWords(static_cast<Tilt>(tilt));
    }
  }
  if (largest < kLeastSpread * smallest) {
    return "the board nearer and farther away";
  }
  return {};
}

std::string Coverage::drawing() const {
  std::string text = "  left image       right image\n";
  char line[80];
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& l = thirds[0];
    const auto& r = thirds[1];
    std::snprintf(line, sizeof(line), "  |%3d|%3d|%3d|    |%3d|%3d|%3d|\n", l.at(3 * row),
                  l.at(3 * row + 1), l.at(3 * row + 2), r.at(3 * row), r.at(3 * row + 1),
                  r.at(3 * row + 2));
    text += line;
  }
  std::snprintf(line, sizeof(line), "  tilts: flat %d, left %d, right %d, top %d, bottom %d",
                tilts[0], tilts[1], tilts[2], tilts[3], tilts[4]);
  return text + line;
}

Hold nextHold(const Coverage& coverage) {
  Hold hold;
  int least = coverage.centres.at(static_cast<std::size_t>(kOrder[0]));
  hold.third = kOrder[0];
  for (const int third : kOrder) {
    if (coverage.centres.at(static_cast<std::size_t>(third)) < least) {
      least = coverage.centres.at(static_cast<std::size_t>(third));
      hold.third = third;
    }
  }
  hold.tilt = static_cast<Tilt>(leastOf(coverage.tilts, coverage.pairs + 1));
  hold.distance = static_cast<Distance>((coverage.pairs + 1) % kDistances);
  return hold;
}

std::string words(const Hold& hold) {
  constexpr std::array<const char*, kDistances> kFar = {
      "at six tenths of the working distance", "at seven tenths of the working distance",
      "a little before the place where the hooks pass"};
  return thirdWords(hold.third) + " of the left picture, " + tiltWords(hold.tilt) + ", " +
         kFar.at(static_cast<std::size_t>(hold.distance));
}

Pose heldPose(const Hold& hold, const StereoRig& rough, const Board& board) {
  const double far =
      vergenceDistance(rough) * kShareOfWorkingDistance.at(static_cast<std::size_t>(hold.distance));
  const auto points = board.points();
  Eigen::Vector3d centre_t = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    centre_t += point / static_cast<double>(points.size());
  }
  const Eigen::Vector2d middle(0.5 * rough.left.width, 0.5 * rough.left.height);
  const Eigen::Vector2d wanted((hold.third % 3 + 0.5) / 3.0 * rough.left.width,
                               (std::floor(hold.third / 3.0) + 0.5) / 3.0 * rough.left.height);
  const Eigen::Vector3d between = 0.5 * rough.c2Mc1.inverse().translation();
  Pose c1Mt = Pose::Identity();
  for (double share = 1.3; share > 0.0; share -= 0.05) {
    const Eigen::Vector2d pixel = middle + share * (wanted - middle);
    const Eigen::Vector3d ray = (rough.left.K.inverse() * pixel.homogeneous()).normalized();
    const Eigen::Vector3d centre = far * ray;
    const Eigen::Quaterniond facing =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), centre - between);
    c1Mt.linear() = facing.toRotationMatrix() * turnOf(hold.tilt);
    c1Mt.translation() = centre - c1Mt.linear() * centre_t;
    if (bothShowAll(c1Mt, rough, board)) {
      break;
    }
  }
  return c1Mt;
}

}  // namespace ringhook

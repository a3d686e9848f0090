#include "calib/solve/verify.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "calib/solve/verify_judge.h"
#include "core/error.h"
#include "rig/camera_model.h"

namespace ringhook {
namespace {

constexpr std::size_t kFewestSightedViews = 3;
constexpr int kFewestPoints = 30;
// Evidence of a rig that tells none: an ordinary good calibration.
constexpr double kUsualRms_px = 0.28;
constexpr double kUsualRows_px = 0.28;

void requireViews(const StereoRig& rig, const std::vector<SightedView>& views) {
  if (!rig.right) {
    throw InputError("the rig has one camera, expected two (keys K2 D2 R T)");
  }
  std::size_t points = 0;
  for (const SightedView& view : views) {
    points += view.points_t.size();
    if (view.points_t.size() < 4) {
      throw InputError(view.name + ": shows fewer than four points of the target");
    }
  }
  if (views.size() < kFewestSightedViews || points < kFewestPoints) {
    throw InputError("both cameras see the target in " + std::to_string(views.size()) +
                     " views with " + std::to_string(points) +
                     " points, expected at least 3 views and 30 points");
  }
}

/// Row differences with the place in the left image, -1 to 1, of each.
void measureRows(const StereoRig& rig, const std::vector<SightedView>& views, RowDrift& rows) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int count = 0;
  for (const SightedView& view : views) {
    StereoView pair;
    pair.left.ids.resize(view.left_px.size());
    std::iota(pair.left.ids.begin(), pair.left.ids.end(), 0);
    pair.right.ids = pair.left.ids;
    pair.left.pixels = view.left_px;
    pair.right.pixels = view.right_px;
    const std::vector<double> differences = rowDifferences(rig, pair);
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const Eigen::Vector3d place(1.0, 2.0 * view.left_px[i].x() / rig.left.width - 1.0,
                                  2.0 * view.left_px[i].y() / rig.left.height - 1.0);
      H += place * place.transpose();
      g += place * differences[i];
      squares += differences[i] * differences[i];
      ++count;
    }
  }
  const Eigen::Vector3d plane = (H + 1e-9 * Eigen::Matrix3d::Identity()).ldlt().solve(g);
  rows.mean_px = g[0] / count;
  rows.rms_px = std::sqrt(squares / count);
  rows.offset_px = plane[0];
  rows.along_x_px = plane[1];
  rows.along_y_px = plane[2];
}

/// Mean position of those points of a group that a view shows; nothing unless it shows all.
std::optional<Eigen::Vector3d> middleOf(const std::vector<Eigen::Vector3d>& group_t,
                                        const SightedView& view,
                                        const std::vector<Eigen::Vector3d>& points_c1) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& wanted : group_t) {
    const auto at = std::find_if(view.points_t.begin(), view.points_t.end(),
                                 [&](const auto& p) { return (p - wanted).norm() < 1e-9; });
    if (at == view.points_t.end()) {
      return std::nullopt;
    }
    sum += points_c1[static_cast<std::size_t>(at - view.points_t.begin())];
  }
  return sum / static_cast<double>(group_t.size());
}

/// The two points of a view farthest apart on the target.
BarEnds longestBar(const SightedView& view) {
  BarEnds bar;
  for (std::size_t i = 0; i < view.points_t.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double length = (view.points_t[i] - view.points_t[j]).norm();
      if (length > bar.known_m) {
        bar = {{view.points_t[i]}, {view.points_t[j]}, length};
      }
    }
  }
  return bar;
}

BarLengths measureBar(const StereoRig& rig, const std::vector<SightedView>& views,
                      const std::optional<BarEnds>& asked) {
  BarLengths lengths;
  double squares = 0.0;
  for (const SightedView& view : views) {
    const BarEnds bar = asked ? *asked : longestBar(view);
    const std::vector<Eigen::Vector3d> points_c1 = locatePoints(rig, view);
    const auto a = middleOf(bar.a_t, view, points_c1);
    const auto b = middleOf(bar.b_t, view, points_c1);
    if (!a || !b) {
      continue;
    }
    const double error = (*a - *b).norm() - bar.known_m;
    ++lengths.count;
    lengths.known_m += bar.known_m;
    lengths.mean_m += error;
    squares += error * error;
    lengths.worst_m = std::max(lengths.worst_m, std::abs(error));
  }
  if (lengths.count > 0) {
    lengths.known_m /= lengths.count;
    lengths.mean_m /= lengths.count;
    lengths.rms_m = std::sqrt(squares / lengths.count);
  }
  return lengths;
}

/// RMS distance between where `used` and `fitted` locate the same pixels, at the points seen.
double costOf(const StereoRig& used, const RigFit& fitted, const std::vector<SightedView>& views) {
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    SightedView ideal = views[i];
    for (std::size_t j = 0; j < ideal.points_t.size(); ++j) {
      const Eigen::Vector3d p1 = fitted.c1Mt[i] * ideal.points_t[j];
      ideal.left_px[j] = projectNormalised(fitted.rig.left, p1.hnormalized());
      ideal.right_px[j] =
          projectNormalised(*fitted.rig.right, (fitted.rig.c2Mc1 * p1).hnormalized());
    }
    const std::vector<Eigen::Vector3d> located = locatePoints(used, ideal);
    for (std::size_t j = 0; j < located.size(); ++j) {
      squares += (located[j] - fitted.c1Mt[i] * ideal.points_t[j]).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

}  // namespace

std::string toString(RigState state) {
  switch (state) {
    case RigState::kOk:
      return "ok";
    case RigState::kMoved:
      return "moved camera";
    case RigState::kRecalibrate:
      break;
  }
  return "recalibrate";
}

Verification verifyRig(const StereoRig& rig, const std::vector<SightedView>& views,
                       const VerifyOptions& options) {
  requireViews(rig, views);
  const RigFit start = startFit(rig, views);
  RigFits fits;
  fits.held = fitRig(start, views, {});
  fits.moved = fitRig(fits.held, views, {true, false});
  fits.refocused = fitRig(fits.held, views, {false, true});
  fits.both = fitRig(fits.moved, views, {true, true});
  Verification result;
  result.views = static_cast<int>(views.size());
  result.points = start.residuals / 4;
  result.rows.expected_px = rig.heldout_vertical_disparity_px.value_or(kUsualRows_px);
  result.expected_sigma_px = rig.rms_px.value_or(kUsualRms_px) / std::sqrt(2.0);
  measureRows(rig, views, result.rows);
  RowDrift after;
  measureRows(fits.moved.rig, views, after);
  result.bar = measureBar(rig, views, options.bar);
  if (options.bar && result.bar.count == 0) {
    throw InputError("--bar: no view shows both of its ends, expected tags that are seen together");
  }
  result.moved.cost_m = costOf(rig, fits.moved, views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    result.distance_m +=
        (fits.held.c1Mt[i] * views[i].points_t.front()).norm() / static_cast<double>(views.size());
  }
  judgeRig(rig, fits, after, options.tolerance_m, result);
  return result;
}

Verification verifyRig(const StereoRig& rig, const StereoViews& views, const Board& board,
                       const VerifyOptions& options) {
  const std::vector<Eigen::Vector3d> points_t = board.points();
  std::vector<SightedView> sighted;
  for (const StereoView& pair : views.usable) {
    SightedView view{pair.left_name, {}, {}, {}};
    for (std::size_t i = 0; i < pair.left.ids.size(); ++i) {
      const auto at = std::find(pair.right.ids.begin(), pair.right.ids.end(), pair.left.ids[i]);
      if (at != pair.right.ids.end()) {
        view.points_t.push_back(points_t[static_cast<std::size_t>(pair.left.ids[i])]);
        view.left_px.push_back(pair.left.pixels[i]);
        view.right_px.push_back(
            pair.right.pixels[static_cast<std::size_t>(at - pair.right.ids.begin())]);
      }
    }
    if (view.points_t.size() >= 4) {
      sighted.push_back(view);
    }
  }
  return verifyRig(rig, sighted, options);
}

}  // namespace ringhook

#include "calib/solve/stereo_calibration.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "calib/solve/circle_grid.h"
#include "calib/solve/small_statistics.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kCircleRounds = 3;  // the bias of a circle's centre changes by 1e-3 of itself a round

void requireViews(const StereoViews& found, const Board& board) {
  if (found.usable.size() < static_cast<std::size_t>(kFewestViews)) {
    std::string sentence =
        fmt::format("only {} of {} pairs show the board in both images, expected at least {}",
                    found.usable.size(), found.usable.size() + found.rejected.size(), kFewestViews);
    if (!found.rejected.empty()) {
      sentence += " (first: " + found.rejected.front().reason + ")";
    }
    throw InputError(sentence);
  }
  for (const StereoView& view : found.usable) {
    for (const BoardSighting* sighting : {&view.left, &view.right}) {
      if (sighting->ids.size() != sighting->pixels.size() || sighting->ids.empty() ||
          sighting->ids.front() < 0 ||
          static_cast<std::size_t>(sighting->ids.back()) >= board.size()) {
        throw InputError(view.left_name + ": the points seen are not those of " + toString(board));
      }
    }
  }
}

bool hasCircles(const Board& board) {
  return board.kind == BoardKind::kCircles || board.kind == BoardKind::kAsymmetricCircles;
}

// Takes the bias that `solution` predicts off the measured centroids (circle_grid.h).
std::vector<StereoView> withCircleCentres(std::vector<StereoView> views, const Board& board,
                                          const StereoSolution& solution) {
  const std::vector<Eigen::Vector3d> points = board.points();
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Pose c2Mt = solution.rig.c2Mc1 * solution.c1Mt[i];
    const auto correct = [&](const CameraModel& camera, const Pose& cMt, BoardSighting& sighting) {
      for (std::size_t j = 0; j < sighting.ids.size(); ++j) {
        sighting.pixels[j] -= circleBias(
            camera, cMt, points[static_cast<std::size_t>(sighting.ids[j])], board.marker_m);
      }
    };
    correct(solution.rig.left, solution.c1Mt[i], views[i].left);
    correct(*solution.rig.right, c2Mt, views[i].right);
  }
  return views;
}

// The whole fit. Of circles, `views` are given as measured and come back as images of centres.
StereoSolution solve(std::vector<StereoView>& views, const Board& board, const FitOptions& fit) {
  FitOptions printed = fit;
  printed.board_shape = false;
  StereoSolution solution =
      refineSolution(startSolution(views, board, fit.terms), views, board, printed);
  if (hasCircles(board)) {
    const std::vector<StereoView> measured = views;
    for (int round = 0; round < kCircleRounds; ++round) {
      views = withCircleCentres(measured, board, solution);
      solution = refineSolution(solution, views, board, printed);
    }
  }
  return fit.board_shape ? refineSolution(solution, views, board, fit) : solution;
}

// Fits, and takes out the worst contradicting view until none is left.
StereoSolution solveConsistent(std::vector<StereoView>& views, std::vector<RejectedView>& rejected,
                               const Board& board, const FitOptions& fit, const StepHook& hook) {
  const std::size_t most = std::max<std::size_t>(1, views.size() / 4);
  std::vector<StereoView> measured = views;
  for (std::size_t taken = 0;; ++taken) {
    hook(0.02, fmt::format("fitting {} views", measured.size()));
    views = measured;
    StereoSolution solution = solve(views, board, fit);
    const std::vector<ViewError> errors = viewErrors(solution, views, board);
    const double limit = outlierLimit(errors);
    const auto worst = std::max_element(
        errors.begin(), errors.end(),
        [](const ViewError& a, const ViewError& b) { return a.both_px < b.both_px; });
    if (worst->both_px <= limit) {
      return solution;
    }
    const auto view = measured.begin() + (worst - errors.begin());
    if (taken == most || measured.size() <= static_cast<std::size_t>(kFewestViews)) {
      throw Error(
          fmt::format("too many views contradict each other ({} taken out, and {} still has "
                      "{:.2f} px where the others allow {:.2f} px): check that left and right "
                      "images are pairs of one instant",
                      taken, view->left_name, worst->both_px, limit));
    }
    rejected.push_back({view->left_name, view->right_name,
                        fmt::format("contradicts the other views: {:.2f} px RMS, limit {:.2f} px",
                                    worst->both_px, limit)});
    measured.erase(view);
  }
}

// Noise per axis [px] from the squares that are left and the degrees of freedom that left them.
double cornerSigma(const std::vector<ViewError>& errors, int degrees_of_freedom) {
  double squares = 0.0;
  for (const ViewError& e : errors) {
    squares += e.both_px * e.both_px * e.points;
  }
  return std::sqrt(squares / std::max(1, degrees_of_freedom));
}

void fillHeldOut(StereoCalibration& result, const std::vector<StereoView>& views,
                 const std::vector<ViewError>& errors,
                 const std::vector<std::vector<double>>& rows) {
  std::vector<double> all;
  for (std::size_t i = 0; i < views.size(); ++i) {
    result.used.push_back(
        {views[i].left_name, views[i].right_name, errors[i], rootMeanSquare(rows[i])});
    all.insert(all.end(), rows[i].begin(), rows[i].end());
  }
  if (all.empty()) {
    throw InputError(
        "no view shows the same point of the board in both images: bring the board where both "
        "cameras see it");
  }
  result.heldout_vertical_disparity_px = rootMeanSquare(all);
  if (!std::isfinite(result.heldout_vertical_disparity_px)) {
    throw Error(
        "the lens model folds back inside the image when a view is left out: use fewer distortion "
        "coefficients, or add views with the board near the image corners");
  }
}

void fillEvidence(StereoCalibration& result, const Board& board) {
  result.rig.rms_px = result.rms_px;
  result.rig.heldout_vertical_disparity_px = result.heldout_vertical_disparity_px;
  result.rig.board = toString(board);
  result.rig.views = static_cast<int>(result.used.size());
}

// A part of the whole job's progress.
StepHook partOf(const StepHook& hook, double from, double to) {
  return [&hook, from, to](double fraction, const std::string& note) {
    hook(from + (to - from) * fraction, note);
  };
}

}  // namespace

double outlierLimit(const std::vector<ViewError>& errors) {
  std::vector<double> values;
  values.reserve(errors.size());
  for (const ViewError& e : errors) {
    values.push_back(e.both_px);
  }
  const double middle = median(values);
  for (double& v : values) {
    v = std::abs(v - middle);
  }
  return std::max({middle + 5.0 * 1.4826 * median(values), 2.0 * middle, 0.1});
}

StereoCalibration calibrateStereo(const StereoViews& found, const Board& board,
                                  const StereoOptions& options, const StepHook& hook) {
  requireViews(found, board);
  if (options.board_shape && board.ambiguous()) {
    throw InputError("--board-shape: " + toString(board) +
                     " looks the same turned by half, so its points cannot be told apart; expected "
                     "a chessboard with an odd and an even count, ChArUco, AprilTags, or an "
                     "asymmetric grid with an odd number of rows");
  }
  StereoCalibration result;
  result.rejected = found.rejected;
  std::vector<StereoView> views = found.usable;
  FitOptions fit{options.terms.value_or(LensTerms::kFive), options.board_shape, options.threads};
  StereoSolution solution = solveConsistent(views, result.rejected, board, fit, hook);
  if (!options.terms) {
    result.lenses = compareLenses(solution, views, board, fit, partOf(hook, 0.05, 0.7));
    for (const LensCandidate& candidate : result.lenses) {
      fit.terms = candidate.chosen ? candidate.terms : fit.terms;
    }
    solution = refineSolution(withTerms(solution, fit.terms), views, board, fit);
  }
  const std::vector<ViewError> errors = viewErrors(solution, views, board);
  result.terms = fit.terms;
  result.rig = solution.rig;
  result.board_points = solution.board_points;
  result.rms_px = rms(errors);
  result.corner_sigma_px = cornerSigma(errors, redundancy(views, fit));
  if (const auto covariance = rigCovariance(solution, views, board, fit)) {
    result.uncertainty = uncertaintyOf(solution.rig, *covariance, result.corner_sigma_px);
  }
  result.folds = static_cast<int>(foldsFor(views.size()));
  fillHeldOut(result, views, errors,
              heldOutRows(solution, views, board, fit, partOf(hook, 0.7, 1.0)));
  fillEvidence(result, board);
  result.verdict = judge(result);
  hook(1.0, "done");
  return result;
}

}  // namespace ringhook

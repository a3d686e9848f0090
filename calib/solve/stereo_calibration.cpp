#include "calib/solve/stereo_calibration.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::size_t kLargestLeaveOneOut = 20;
constexpr std::size_t kFolds = 10;

// Limits of judge(); doc/calibration.md gives the reasons.
constexpr double kGood_px = 0.3;
constexpr double kUsable_px = 0.6;
constexpr double kGoodRelativeUncertainty = 2e-3;
constexpr double kUsableRelativeUncertainty = 1e-2;
constexpr double kOverfit = 1.5;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) {
    sum += v * v;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void requireViews(const StereoViews& found) {
  if (found.usable.size() >= static_cast<std::size_t>(kFewestViews)) {
    return;
  }
  std::string sentence =
      fmt::format("only {} of {} pairs show the board in both images, expected at least {}",
                  found.usable.size(), found.usable.size() + found.rejected.size(), kFewestViews);
  if (!found.rejected.empty()) {
    sentence += " (first: " + found.rejected.front().reason + ")";
  }
  throw InputError(sentence);
}

StereoSolution solve(const std::vector<StereoView>& views, const Board& board, LensTerms terms) {
  return refineSolution(startSolution(views, board, terms), views, board, terms);
}

// Fits, and takes out the worst contradicting view until none is left.
StereoSolution solveConsistent(std::vector<StereoView>& views, std::vector<RejectedView>& rejected,
                               const Board& board, LensTerms terms, const StepHook& hook) {
  const std::size_t most = std::max<std::size_t>(1, views.size() / 4);
  for (std::size_t taken = 0;; ++taken) {
    hook(0.1, fmt::format("fitting {} views", views.size()));
    StereoSolution solution = solve(views, board, terms);
    const std::vector<ViewError> errors = viewErrors(solution, views, board);
    const double limit = outlierLimit(errors);
    const auto worst = std::max_element(
        errors.begin(), errors.end(),
        [](const ViewError& a, const ViewError& b) { return a.both_px < b.both_px; });
    if (worst->both_px <= limit) {
      return solution;
    }
    const auto view = views.begin() + (worst - errors.begin());
    if (taken == most || views.size() <= static_cast<std::size_t>(kFewestViews)) {
      throw Error(
          fmt::format("too many views contradict each other ({} taken out, and {} still has "
                      "{:.2f} px where the others allow {:.2f} px): check that left and right "
                      "images are pairs of one instant",
                      taken, view->left_name, worst->both_px, limit));
    }
    rejected.push_back({view->left_name, view->right_name,
                        fmt::format("contradicts the other views: {:.2f} px RMS, limit {:.2f} px",
                                    worst->both_px, limit)});
    views.erase(view);
  }
}

// Row differences of every view with a fit that left it out; `solution` only starts each fit.
std::vector<std::vector<double>> heldOutRows(const StereoSolution& solution,
                                             const std::vector<StereoView>& views,
                                             const Board& board, LensTerms terms, std::size_t folds,
                                             const StepHook& hook) {
  std::vector<std::vector<double>> rows(views.size());
  for (std::size_t fold = 0; fold < folds; ++fold) {
    hook(0.2 + 0.8 * static_cast<double>(fold) / static_cast<double>(folds),
         fmt::format("cross validation, fold {} of {}", fold + 1, folds));
    StereoSolution start = solution;
    start.c1Mt.clear();
    std::vector<StereoView> training;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (i % folds != fold) {
        training.push_back(views[i]);
        start.c1Mt.push_back(solution.c1Mt[i]);
      }
    }
    const StereoSolution fit = refineSolution(start, training, board, terms);
    for (std::size_t i = fold; i < views.size(); i += folds) {
      rows[i] = rowDifferences(fit.rig, views[i]);
    }
  }
  return rows;
}

void fillEvidence(StereoCalibration& result, const Board& board) {
  result.rig.rms_px = result.rms_px;
  result.rig.heldout_vertical_disparity_px = result.heldout_vertical_disparity_px;
  result.rig.board = toString(board);
  result.rig.views = static_cast<int>(result.used.size());
}

// Noise per axis [px] from the squares that are left and the degrees of freedom that left them.
double cornerSigma(const std::vector<ViewError>& errors, int degrees_of_freedom) {
  double squares = 0.0;
  for (const ViewError& e : errors) {
    squares += e.both_px * e.both_px * e.points;
  }
  return std::sqrt(squares / degrees_of_freedom);
}

double relativeUncertainty(const StereoCalibration& c) {
  const CameraModel& left = c.rig.left;
  const CameraModel& right = c.rig.right.value();
  const double focal = std::min({left.K(0, 0), left.K(1, 1), right.K(0, 0), right.K(1, 1)});
  return std::max(c.uncertainty->focal_px / focal, c.uncertainty->baseline_m / baseline(c.rig));
}

}  // namespace

std::string toString(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "good";
    case Grade::kUsable:
      return "usable";
    case Grade::kPoor:
      break;
  }
  return "poor";
}

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
  requireViews(found);
  const LensTerms terms = options.terms.value_or(LensTerms::kFive);
  StereoCalibration result;
  result.terms = terms;
  result.rejected = found.rejected;
  std::vector<StereoView> views = found.usable;
  const StereoSolution solution = solveConsistent(views, result.rejected, board, terms, hook);
  const std::vector<ViewError> errors = viewErrors(solution, views, board);
  result.rig = solution.rig;
  result.rms_px = rms(errors);
  result.corner_sigma_px = cornerSigma(errors, redundancy(views, terms));
  result.uncertainty = uncertainty(solution, views, board, terms, result.corner_sigma_px);
  result.folds = static_cast<int>(views.size() <= kLargestLeaveOneOut ? views.size() : kFolds);
  const auto rows =
      heldOutRows(solution, views, board, terms, static_cast<std::size_t>(result.folds), hook);
  std::vector<double> all;
  for (std::size_t i = 0; i < views.size(); ++i) {
    result.used.push_back(
        {views[i].left_name, views[i].right_name, errors[i], rootMeanSquare(rows[i])});
    all.insert(all.end(), rows[i].begin(), rows[i].end());
  }
  result.heldout_vertical_disparity_px = rootMeanSquare(all);
  if (!std::isfinite(result.heldout_vertical_disparity_px)) {
    throw Error(
        "the lens model folds back inside the image when a view is left out: use fewer distortion "
        "coefficients, or add views with the board near the image corners");
  }
  fillEvidence(result, board);
  result.verdict = judge(result);
  hook(1.0, "done");
  return result;
}

Verdict judge(const StereoCalibration& c) {
  if (!c.uncertainty) {
    return {Grade::kPoor,
            "the views leave a parameter undetermined: tilt the board in different directions"};
  }
  const double rows = c.heldout_vertical_disparity_px;
  const double worst = std::max(c.rms_px, rows);
  const double relative = relativeUncertainty(c);
  const std::string figures =
      fmt::format("reprojection {:.3f} px and held-out rows {:.3f} px", c.rms_px, rows);
  if (!(worst <= kUsable_px)) {
    return {Grade::kPoor,
            figures + fmt::format(", where at most {:.1f} px can be used: look for blur, a "
                                  "bent board, or images that are not pairs",
                                  kUsable_px)};
  }
  if (relative > kUsableRelativeUncertainty) {
    return {Grade::kPoor,
            fmt::format("focal length or baseline is known to {:.2f} % only: tilt the board "
                        "more and bring it closer",
                        100.0 * relative)};
  }
  if (rows > kOverfit * std::sqrt(2.0) * c.corner_sigma_px) {
    return {Grade::kUsable, figures +
                                ": unseen views fit worse than the ones used, so the views "
                                "are too few or too much alike"};
  }
  if (worst > kGood_px) {
    return {Grade::kUsable,
            figures + fmt::format(", where {:.1f} px is good: sharper or more evenly lit "
                                  "pictures and a flatter board help",
                                  kGood_px)};
  }
  if (relative > kGoodRelativeUncertainty) {
    return {Grade::kUsable,
            figures + fmt::format(", but focal length or baseline is known to {:.2f} % "
                                  "only: tilt the board more",
                                  100.0 * relative)};
  }
  return {Grade::kGood, figures + ", both as expected of sharp pictures and a flat board"};
}

}  // namespace ringhook

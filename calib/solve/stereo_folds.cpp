#include "calib/solve/stereo_folds.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::size_t kLargestLeaveOneOut = 20;
constexpr std::size_t kFolds = 10;
constexpr double kSmallGain = 0.02;  // of the mean square: one hundredth of the RMS

using Rows = std::vector<std::vector<double>>;

// The rows of one fold's views, with a fit to the others.
Rows foldRows(const StereoSolution& solution, const std::vector<StereoView>& views,
              const Board& board, FitOptions fit, std::size_t fold, std::size_t folds) {
  fit.threads = 1;
  StereoSolution start = solution;
  start.c1Mt.clear();
  std::vector<StereoView> training;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i % folds != fold) {
      training.push_back(views[i]);
      start.c1Mt.push_back(solution.c1Mt[i]);
    }
  }
  const StereoSolution fitted = refineSolution(start, training, board, fit);
  Rows rows;
  for (std::size_t i = fold; i < views.size(); i += folds) {
    rows.push_back(rowDifferences(fitted.rig, views[i]));
  }
  return rows;
}

std::vector<double> joined(const Rows& rows) {
  std::vector<double> all;
  for (const std::vector<double>& row : rows) {
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

// One candidate, and each view's mean square row difference.
std::vector<double> tryLens(const StereoSolution& solution, const std::vector<StereoView>& views,
                            const Board& board, const FitOptions& fit, const StepHook& hook,
                            LensCandidate& candidate) {
  std::vector<double> squares(views.size(), std::numeric_limits<double>::infinity());
  candidate.rms_px = candidate.heldout_px = std::numeric_limits<double>::infinity();
  try {
    const StereoSolution fitted = refineSolution(withTerms(solution, fit.terms), views, board, fit);
    candidate.rms_px = rms(viewErrors(fitted, views, board));
    const Rows rows = heldOutRows(fitted, views, board, fit, hook);
    candidate.heldout_px = rootMeanSquare(joined(rows));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      squares[i] = std::pow(rootMeanSquare(rows[i]), 2);
    }
  } catch (const Interrupted&) {
    throw;
  } catch (const Error&) {
    return squares;  // this model does not fit; infinity says so
  }
  return squares;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double rootMeanSquare(const std::vector<double>& values) {
  if (values.empty()) {
    return 0.0;
  }
  double sum = 0.0;
  for (const double v : values) {
    sum += v * v;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::size_t foldsFor(std::size_t views) { return views <= kLargestLeaveOneOut ? views : kFolds; }

StereoSolution withTerms(StereoSolution solution, LensTerms terms) {
  for (CameraModel* camera : {&solution.rig.left, &*solution.rig.right}) {
    Eigen::VectorXd distortion = Eigen::VectorXd::Zero(static_cast<int>(terms));
    const auto kept = std::min(distortion.size(), camera->distortion.size());
    distortion.head(kept) = camera->distortion.head(kept);
    camera->distortion = distortion;
  }
  return solution;
}

Rows heldOutRows(const StereoSolution& solution, const std::vector<StereoView>& views,
                 const Board& board, const FitOptions& fit, const StepHook& hook) {
  const std::size_t folds = foldsFor(views.size());
  const auto at_once = static_cast<std::size_t>(std::max(1, fit.threads));
  Rows rows(views.size());
  for (std::size_t first = 0; first < folds; first += at_once) {
    hook(static_cast<double>(first) / static_cast<double>(folds),
         "cross validation, fold " + std::to_string(first + 1) + " of " + std::to_string(folds));
    std::vector<std::future<Rows>> running;
    for (std::size_t fold = first; fold < std::min(folds, first + at_once); ++fold) {
      running.push_back(std::async(std::launch::async, [&, fold] {
        return foldRows(solution, views, board, fit, fold, folds);
      }));
    }
    for (std::size_t k = 0; k < running.size(); ++k) {
      Rows done = running[k].get();
      for (std::size_t n = 0; n < done.size(); ++n) {
        rows[first + k + n * folds] = std::move(done[n]);
      }
    }
  }
  return rows;
}

std::size_t chooseByOneStandardError(const std::vector<std::vector<double>>& squares) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < squares.size(); ++i) {
    if (mean(squares[i]) < mean(squares[best])) {
      best = i;
    }
  }
  for (std::size_t i = 0; i < best; ++i) {
    std::vector<double> excess;
    for (std::size_t v = 0; v < squares[i].size(); ++v) {
      excess.push_back(squares[i][v] - squares[best][v]);
    }
    const double average = mean(excess);
    double scatter = 0.0;
    for (const double e : excess) {
      scatter += (e - average) * (e - average);
    }
    const auto n = static_cast<double>(excess.size());
    const double standard_error = std::sqrt(scatter / (n * std::max(1.0, n - 1.0)));
    if (average <= std::max(standard_error, kSmallGain * mean(squares[best]))) {
      return i;
    }
  }
  return best;
}

std::vector<LensCandidate> compareLenses(const StereoSolution& solution,
                                         const std::vector<StereoView>& views, const Board& board,
                                         const FitOptions& fit, const StepHook& hook) {
  std::vector<LensCandidate> candidates;
  std::vector<std::vector<double>> squares;
  for (const LensTerms terms : {LensTerms::kNone, LensTerms::kFive, LensTerms::kEight}) {
    const auto part = static_cast<double>(candidates.size()) / 3.0;
    const StepHook step = [&](double fraction, const std::string& note) {
      hook(part + fraction / 3.0,
           std::to_string(static_cast<int>(terms)) + " distortion terms, " + note);
    };
    candidates.push_back({terms, 0.0, 0.0, false});
    squares.push_back(
        tryLens(solution, views, board, {terms, false, fit.threads}, step, candidates.back()));
  }
  candidates[chooseByOneStandardError(squares)].chosen = true;
  return candidates;
}

}  // namespace ringhook

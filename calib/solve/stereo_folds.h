#pragma once

/// \file
/// Judging by views that were not fitted (cross validation; Stone, J. Royal Statistical Society B
/// 36, 1974): the figure that counts, and the choice of the lens model by it.
///
/// Choice: the candidate with the least held-out square error is best; but a simpler one is taken
/// if its excess over the best, averaged over the views, is within one standard error of that
/// average, or below two hundredths of the best (the one-standard-error rule: Breiman et al.,
/// "Classification and Regression Trees", 1984, section 3.4.3; Hastie, Tibshirani, Friedman, "The
/// Elements of Statistical Learning", 2009, section 7.10; here with the differences of the same
/// views, which share their noise).

#include <cstddef>
#include <vector>

#include "calib/solve/stereo_problem.h"

namespace ringhook {

/// One lens model that was tried, with the board as printed.
struct LensCandidate {
  LensTerms terms = LensTerms::kFive;
  double rms_px = 0.0;      ///< of the fit to all views [px]; infinity: no fit
  double heldout_px = 0.0;  ///< RMS row difference of held-out views [px]; infinity: lens folds
  bool chosen = false;
};

/// Folds: leave one view out up to 20 views, ten folds beyond.
std::size_t foldsFor(std::size_t views);

/// Row differences [px] of every view with a fit that left it out, board shape included; `solution`
/// only starts each fit. Folds run on fit.threads threads, `hook` on the caller's.
std::vector<std::vector<double>> heldOutRows(const StereoSolution& solution,
                                             const std::vector<StereoView>& views,
                                             const Board& board, const FitOptions& fit,
                                             const StepHook& hook);

/// Tries 0, 5 and 8 distortion terms. \param solution of `views` with five terms.
std::vector<LensCandidate> compareLenses(const StereoSolution& solution,
                                         const std::vector<StereoView>& views, const Board& board,
                                         const FitOptions& fit, const StepHook& hook);

/// Index of the candidate that the rule above takes. \param squares for each candidate, simplest
/// first, the mean square row difference of every view [px^2].
std::size_t chooseByOneStandardError(const std::vector<std::vector<double>>& squares);

/// `solution` as the start of a fit with other terms: those it lacks are zero.
StereoSolution withTerms(StereoSolution solution, LensTerms terms);

/// Root mean square; 0 for none.
double rootMeanSquare(const std::vector<double>& values);

}  // namespace ringhook

#pragma once

/// \file
/// Stereo calibration from board views, without prompts: joint refinement, views that contradict
/// the others taken out, and a judgement that does not rest on the fit's own residuals alone.
///
/// Two figures judge a rig. `rms_px` is how well the model fits the corners it was fitted to; it
/// falls with every parameter that is added. `heldout_vertical_disparity_px` is the RMS row
/// difference, after rectification, of corners in views that the calibration did not see (cross
/// validation; Stone, J. Royal Statistical Society B 36, 1974): the error that stereo matching and
/// triangulation will meet. With noise of sigma per axis both approach sigma * sqrt(2).

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/stereo_folds.h"
#include "calib/solve/stereo_images.h"
#include "calib/solve/stereo_uncertainty.h"

namespace ringhook {

/// Zhang's closed form needs two tilted views per camera and three to average; one more is held
/// out for judging.
constexpr int kFewestViews = 4;

struct StereoOptions {
  std::optional<LensTerms> terms;  ///< absent: chosen by held-out error
  bool board_shape = false;        ///< the board's own points are unknown, too
  int threads = 2;                 ///< at most that many
};

struct UsedView {
  std::string left_name;
  std::string right_name;
  ViewError error;               ///< in the final fit
  double heldout_rows_px = 0.0;  ///< RMS row difference with a fit that left this view out [px]
};

enum class Grade { kGood, kUsable, kPoor };

struct Verdict {
  Grade grade = Grade::kPoor;
  std::string sentence;  ///< why, and what to do about it
};

struct StereoCalibration {
  LensTerms terms = LensTerms::kFive;  ///< given or chosen
  StereoRig rig;                       ///< with rms_px, held-out figure, board and views filled
  std::vector<LensCandidate> lenses;   ///< tried; empty if the terms were given
  std::vector<Eigen::Vector3d> board_points;  ///< the board's own shape in t [m]; empty: as printed
  std::vector<UsedView> used;
  std::vector<RejectedView> rejected;
  double rms_px = 0.0;                         ///< see rms()
  double corner_sigma_px = 0.0;                ///< per axis, from the residuals' redundancy [px]
  double heldout_vertical_disparity_px = 0.0;  ///< RMS over all corners of all held-out views [px]
  int folds = 0;                               ///< of the cross validation
  std::optional<Uncertainty> uncertainty;      ///< absent: the views leave something undetermined
  Verdict verdict;
};

/// "good", "usable" or "poor".
std::string toString(Grade grade);

/// RMS [px] above which a view contradicts the others:
///   max(median + 5 * 1.4826 * MAD, 2 * median, 0.1 px)
/// over the views' both_px. 1.4826 MAD is the standard deviation for normal errors; twice the
/// median guards small sets, whose MAD is itself uncertain, and 0.1 px perfect ones.
double outlierLimit(const std::vector<ViewError>& errors);

/// The whole job. `found.rejected` is carried into the result. Views above outlierLimit are taken
/// out one by one, worst first, each with its reason. Held-out figures: stereo_folds.h.
/// Throws InputError below kFewestViews views, Error if more than a quarter of them
/// contradict the others or nothing converges, and whatever `hook` throws.
StereoCalibration calibrateStereo(const StereoViews& found, const Board& board,
                                  const StereoOptions& options, const StepHook& hook);

/// Judges the figures of a finished calibration.
Verdict judge(const StereoCalibration& calibration);

}  // namespace ringhook

#pragma once

/// \file
/// The least-squares problem of a stereo calibration: all parameters of both lenses, the pose
/// between the cameras and the board's pose in every view, refined together so that the projected
/// board corners meet the corners seen (bundle adjustment; Triggs et al., "Bundle Adjustment, a
/// Modern Synthesis", 2000; closed-form start after Zhang, PAMI 2000).
///   minimise  sum over views i, corners j of
///     |p1_ij - project(left, c1Mt_i X_j)|^2 + |p2_ij - project(right, c2Mc1 c1Mt_i X_j)|^2
/// Focal lengths, aspect and principal points of the two cameras are all free and not shared.
///
/// Optionally the board's points X_j are unknown, too (a print is never quite flat nor to scale;
/// Strobl and Hirzinger, "More accurate pinhole camera calibration with imperfect planar target",
/// ICCV Workshops 2011). A rigid motion and the size of all X_j together would be free then; a weak
/// prior, X_j as printed with a standard deviation of 0.5 % of the pitch in the print and 2 % out
/// of it, fixes them where the mean of the points is as printed, and weighs nothing else.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calib/solve/board.h"
#include "core/pose.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// One pair of images in which both cameras saw the board, of coded boards perhaps different parts.
struct StereoView {
  std::string left_name;   ///< for messages, a file name
  std::string right_name;  ///< for messages, a file name
  int width = 0;           ///< of both images [px]
  int height = 0;          ///< of both images [px]
  BoardSighting left;
  BoardSighting right;
};

/// One pair of images that is not used, and why.
struct RejectedView {
  std::string left_name;
  std::string right_name;
  std::string reason;  ///< a phrase for a table
};

/// Called between steps with the part done (0 to 1) and a short state; may throw to stop the job.
using StepHook = std::function<void(double fraction, const std::string& note)>;

/// Number of distortion coefficients that are estimated per camera.
enum class LensTerms {
  kNone = 0,   ///< pinhole
  kFive = 5,   ///< k1 k2 p1 p2 k3
  kEight = 8,  ///< k1 k2 p1 p2 k3 k4 k5 k6, OpenCV's rational model
};

/// What is unknown, and how many threads look for it.
struct FitOptions {
  LensTerms terms = LensTerms::kFive;
  bool board_shape = false;  ///< the board's points as well
  int threads = 1;
};

struct StereoSolution {
  StereoRig rig;                              ///< cameras and c2Mc1; evidence fields stay empty
  std::vector<Pose> c1Mt;                     ///< board in the left camera, one per view
  std::vector<Eigen::Vector3d> board_points;  ///< in t [m]; empty: as printed
};

/// Root mean square length of the residual vectors of one view [px].
struct ViewError {
  double left_px = 0.0;
  double right_px = 0.0;
  double both_px = 0.0;  ///< over the points of both images
  int points = 0;        ///< seen in both images together
};

/// Covariance for noise of one pixel per axis of the rig's parameters: of the left lens, then the
/// right one fx fy cx cy [px] k1 k2 p1 p2 k3 k4 k5 k6, then of c2Mc1 the rotation vector [rad] and
/// the translation [m]. Parameters that were not fitted have zeros.
using RigCovariance = Eigen::Matrix<double, 30, 30>;

/// Each camera alone (Zhang), then the pose between them as the median view tells it. Throws Error
/// if OpenCV finds no start, as for views that show the board in one orientation only.
StereoSolution startSolution(const std::vector<StereoView>& views, const Board& board,
                             LensTerms terms);

/// Refines everything from `start`, which has one c1Mt per view, to the minimum. With eight
/// terms k4 k5 k6 carry a weak prior (see the source). Throws Error if the minimum is not reached.
StereoSolution refineSolution(const StereoSolution& start, const std::vector<StereoView>& views,
                              const Board& board, const FitOptions& options);

/// First-order covariance at the minimum, everything else being estimated along; nothing if the
/// views leave a parameter undetermined.
std::optional<RigCovariance> rigCovariance(const StereoSolution& solution,
                                           const std::vector<StereoView>& views, const Board& board,
                                           const FitOptions& options);

/// Residuals of every view under `solution`.
std::vector<ViewError> viewErrors(const StereoSolution& solution,
                                  const std::vector<StereoView>& views, const Board& board);

/// OpenCV's figure for stereoCalibrate: sqrt(sum of squared residual lengths / number of corners
/// seen), both images counted [px]. Noise of sigma per axis gives sigma * sqrt(2) less the share
/// that the fitted parameters absorb.
double rms(const std::vector<ViewError>& errors);

/// Degrees of freedom left: scalar residuals minus parameters.
int redundancy(const std::vector<StereoView>& views, const FitOptions& options);

/// Row differences [px] of each point that both images show, in the order of ids, after
/// rectification by `rig`, scaled to the mean of the four focal lengths: left minus right. Corners
/// beyond the lens model give infinity.
std::vector<double> rowDifferences(const StereoRig& rig, const StereoView& view);

}  // namespace ringhook

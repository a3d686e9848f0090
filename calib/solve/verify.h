#pragma once

/// \file
/// Does an accepted rig still hold? A new set of views is compared with it, and the answer is one
/// of three, with reasons in words:
/// - ok: rows correspond and lengths are right as far as the rig's own evidence promises;
/// - moved: one camera has turned or shifted against the other, which explains what is seen;
/// - recalibrate: what is seen is worse than promised and no motion explains it (focal length,
///   focus, lens, a wrong board).
/// A change is told only if it is both significant and of consequence: the likelihood ratio of
/// verify_fit.h beyond chi-square at a false-alarm rate of 0.1 %, the accepted rig's own doubt
/// allowed for; and either rows that drift by more than half the rig's held-out figure, or points
/// at the distance of the views that move by more than a tolerance.

#include <optional>
#include <string>
#include <vector>

#include "calib/solve/stereo_images.h"
#include "calib/solve/verify_fit.h"

namespace ringhook {

/// A length on the target between two points, or the middles of two groups of points.
struct BarEnds {
  std::vector<Eigen::Vector3d> a_t;  ///< points of the target [m], as in SightedView
  std::vector<Eigen::Vector3d> b_t;  ///< likewise [m]
  double known_m = 0.0;              ///< [m]
};

struct VerifyOptions {
  double tolerance_m = 0.3e-3;  ///< largest harmless shift of points at the views' distance [m]
  std::optional<BarEnds> bar;   ///< absent: in each view the two points farthest apart
};

/// Row differences after rectification, left minus right, at the mean focal length.
struct RowDrift {
  double mean_px = 0.0;      ///< [px]
  double rms_px = 0.0;       ///< [px]
  double expected_px = 0.0;  ///< RMS that the rig's evidence promises [px]
  // The best plane through them over the left image, by which camera errors are told apart:
  double offset_px = 0.0;   ///< in the middle: pitch, or a shifted principal point
  double along_x_px = 0.0;  ///< growth from the middle to the right border: roll
  double along_y_px = 0.0;  ///< growth from the middle to the lower border: focal length
};

struct BarLengths {
  int count = 0;         ///< views that show it
  double known_m = 0.0;  ///< mean of the known lengths [m]
  double mean_m = 0.0;   ///< mean error [m]
  double rms_m = 0.0;    ///< RMS error [m]
  double worst_m = 0.0;  ///< largest error [m]
};

/// The right camera's motion against the left one, at and in the accepted right camera's frame.
struct CameraMove {
  Eigen::Vector3d rotation_rad{0, 0, 0};  ///< about x, y, z of c2 [rad]
  Eigen::Vector3d rotation_sigma_rad{0, 0, 0};
  Eigen::Vector3d translation_m{0, 0, 0};  ///< along x, y, z of c2 [m]
  Eigen::Vector3d translation_sigma_m{0, 0, 0};
  double chi_square = 0.0;  ///< of six degrees of freedom, the rig's doubt allowed for
  double limit = 0.0;       ///< beyond it the change is significant
  double cost_m = 0.0;      ///< RMS shift of the views' points if the rig were used as it is [m]
};

struct FocalChange {
  double left_share = 0.0;   ///< relative change
  double right_share = 0.0;  ///< likewise
  double chi_square = 0.0;   ///< of two degrees of freedom beyond the pose
  double limit = 0.0;
};

enum class RigState { kOk, kRecalibrate, kMoved };

struct Verification {
  RigState state = RigState::kOk;
  std::vector<std::string> reasons;  ///< sentences, the decisive one first
  RowDrift rows;
  BarLengths bar;
  CameraMove moved;
  FocalChange focal;
  double corner_sigma_px = 0.0;    ///< per axis, what no change explains [px]
  double expected_sigma_px = 0.0;  ///< per axis, by the rig's evidence [px]
  double distance_m = 0.0;         ///< mean distance of the points from the left camera [m]
  int views = 0;
  int points = 0;
};

/// "ok", "recalibrate" or "moved camera".
std::string toString(RigState state);

/// Needs at least three views and thirty points. Throws InputError for fewer, for a rig of one
/// camera, and for views that have nothing to do with the rig or the target.
Verification verifyRig(const StereoRig& rig, const std::vector<SightedView>& views,
                       const VerifyOptions& options = {});

/// The same of views of a board.
Verification verifyRig(const StereoRig& rig, const StereoViews& views, const Board& board,
                       const VerifyOptions& options = {});

}  // namespace ringhook

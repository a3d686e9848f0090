#pragma once

/// \file
/// The least-squares problem of time_delay.h: its unknowns, what the frames say of them, and its
/// minimum by Levenberg and Marquardt with Huber's weights.

#include <optional>
#include <vector>

#include "calib/solve/time_delay.h"

namespace ringhook {

inline constexpr int kOffsetUnknowns = 13;  ///< offset [s], then twists of eMg and of fMc1
using OffsetStep = Eigen::Matrix<double, kOffsetUnknowns, 1>;
using OffsetSquare = Eigen::Matrix<double, kOffsetUnknowns, kOffsetUnknowns>;

/// Corners are weighed against the priors as if each were this sure [px].
inline constexpr double kOffsetSigmaPx = 0.1;

struct OffsetUnknowns {
  double offset_s = 0.0;
  Pose eMg = Pose::Identity();
  Pose fMc1 = Pose::Identity();

  [[nodiscard]] OffsetUnknowns moved(const OffsetStep& d) const {
    return {offset_s + d[0], eMg * expSe3(d.segment<6>(1)), fMc1 * expSe3(d.tail<6>())};
  }
};

/// What one frame, or all of them, say: normal equations with robust weights.
struct OffsetNormal {
  OffsetSquare H = OffsetSquare::Zero();
  OffsetStep g = OffsetStep::Zero();
  double squares = 0.0;  ///< weighted [px^2]
  double weights = 0.0;  ///< of residuals
  double speed = 0.0;    ///< squared image speed, weighted [px^2/s^2]
};

class TimeOffsetFit {
 public:
  /// Both must outlive the fit. Frames without states on either side are left out.
  TimeOffsetFit(const PlateMotion& motion, const TimeOffsetOptions& options);

  /// Frames that count.
  [[nodiscard]] std::size_t views() const { return views_.size(); }
  /// The start that explains most: the plate on the flange as single frames saw it.
  [[nodiscard]] OffsetUnknowns start() const;
  /// The minimum near `x`, with the offset free or held; nothing if there is none.
  [[nodiscard]] std::optional<OffsetUnknowns> minimise(OffsetUnknowns x, bool with_offset) const;
  /// Normal equations; the gradient of each block of time into `blocks` if given.
  [[nodiscard]] OffsetNormal all(const OffsetUnknowns& x, std::vector<OffsetStep>* blocks) const;

 private:
  [[nodiscard]] OffsetStep priorResidual(const OffsetUnknowns& x) const;
  void addPrior(const OffsetUnknowns& x, OffsetNormal& sum) const;
  [[nodiscard]] std::optional<double> cost(const OffsetUnknowns& x) const;
  [[nodiscard]] OffsetNormal single(const HookView& view, const OffsetUnknowns& x) const;

  const PlateMotion& motion_;
  const TimeOffsetOptions& options_;
  MotionSpline flange_;
  std::vector<const HookView*> views_;
};

}  // namespace ringhook

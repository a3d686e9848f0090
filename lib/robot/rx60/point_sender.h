#pragma once

/// \file
/// A coarse move as trajectory points: one request at a time, each reply checked, a refused point
/// sent again after a while (the controller's queue holds ten), until the arm stands at the last.

#include <cstddef>
#include <optional>
#include <vector>

#include "core/joints.h"
#include "core/outcome.h"
#include "robot/rx60/messages.h"

namespace ringhook::rx60 {

struct JointPoint {
  JointVector position;         ///< [rad]
  double speed_fraction = 0.1;  ///< of the nominal joint speeds, above 0, at most 1
};

/// Refused with the reason if a point leaves the limits or its speed means nothing.
Outcome<std::size_t> checkPoints(const std::vector<JointPoint>& points, const JointLimits& limits);

class PointSender {
 public:
  void start(std::vector<JointPoint> points, Time now);
  void clear();

  /// The request to be sent now, if any.
  std::optional<JointTrajPt> next(Time now);
  void replied(bool success, Time now);

  [[nodiscard]] bool allAccepted() const { return at_ == points_.size(); }
  /// A request has been waiting for its reply since then.
  [[nodiscard]] std::optional<Time> unansweredSince() const { return unanswered_since_; }
  /// How long the current point has been refused [s].
  [[nodiscard]] double refusedFor(Time now) const;
  [[nodiscard]] std::size_t current() const { return at_; }
  /// Precondition: started and not cleared.
  [[nodiscard]] const JointVector& goal() const { return points_.back().position; }

 private:
  std::vector<JointPoint> points_;
  std::size_t at_ = 0;
  std::optional<Time> unanswered_since_;
  std::optional<Time> refused_since_;
  Time not_before_;
};

}  // namespace ringhook::rx60

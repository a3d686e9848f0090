#include "robot/rx60/point_sender.h"

#include <string>
#include <utility>

namespace ringhook::rx60 {
namespace {

constexpr double kAgainAfter = 0.04;  // [s]: ten ticks of the controller

}  // namespace

Outcome<std::size_t> checkPoints(const std::vector<JointPoint>& points, const JointLimits& limits) {
  if (points.empty()) {
    return Refusal{"a move needs at least one point"};
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::string which = "point " + std::to_string(k + 1) + " of the move ";
    const JointPoint& point = points[k];
    if (!(point.speed_fraction > 0.0 && point.speed_fraction <= 1.0)) {
      return Refusal{which + "asks for speed " + std::to_string(point.speed_fraction) +
                     ", expected a share above 0 and at most 1"};
    }
    for (int i = 0; i < 6; ++i) {
      if (!(point.position[i] >= limits.lower[i] && point.position[i] <= limits.upper[i])) {
        return Refusal{which + "puts J" + std::to_string(i + 1) + " at " +
                       std::to_string(point.position[i]) + " rad, outside its range"};
      }
    }
  }
  return points.size();
}

void PointSender::start(std::vector<JointPoint> points, Time now) {
  clear();
  points_ = std::move(points);
  not_before_ = now;
}

void PointSender::clear() { *this = PointSender(); }

std::optional<JointTrajPt> PointSender::next(Time now) {
  if (allAccepted() || unanswered_since_ || now < not_before_) {
    return std::nullopt;
  }
  unanswered_since_ = now;
  JointTrajPt point;
  point.sequence = static_cast<std::int32_t>(at_);
  point.joints = toWire(points_[at_].position);
  point.velocity = static_cast<float>(points_[at_].speed_fraction);
  return point;
}

void PointSender::replied(bool success, Time now) {
  if (!unanswered_since_) {
    return;
  }
  unanswered_since_.reset();
  if (success) {
    refused_since_.reset();
    ++at_;
    return;
  }
  refused_since_ = refused_since_.value_or(now);
  not_before_ = now + kAgainAfter;
}

double PointSender::refusedFor(Time now) const {
  return refused_since_ ? now - *refused_since_ : 0.0;
}

}  // namespace ringhook::rx60

#include "calib/solve/time_offset_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace ringhook {
namespace {

using Eigen::Vector2d;

constexpr double kGap = 0.05;         // between two states [s]
constexpr double kDifference = 1e-6;  // for derivatives [s, m, rad]
constexpr double kBlock = 0.2;        // of frames whose errors may be of one kind [s]
constexpr int kIterations = 60;
constexpr int kStarts = 12;

/// Residuals of one frame [px], two for each corner; nothing if there is no state or the plate
/// would lie behind a camera.
std::optional<Eigen::VectorXd> residuals(const HookView& view, const MotionSpline& flange,
                                         const OffsetUnknowns& x) {
  const std::optional<Pose> fMe = flange.at(view.time + x.offset_s);
  if (!fMe) {
    return std::nullopt;
  }
  const Pose c1Mg = x.fMc1.inverse(Eigen::Isometry) * *fMe * x.eMg;
  std::vector<double> values;
  for (const CameraFeatures& camera : view.cameras) {
    for (const CornerFeature& corner : camera.corners) {
      const std::optional<Vector2d> seen = camera.camera.project(c1Mg * corner.point_o);
      if (!seen) {
        return std::nullopt;
      }
      values.push_back(corner.pixel.x() - seen->x());
      values.push_back(corner.pixel.y() - seen->y());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Huber's weights, one for each residual, by the length of its corner's.
Eigen::VectorXd huberWeights(const Eigen::VectorXd& r, double limit_px) {
  Eigen::VectorXd w(r.size());
  for (Eigen::Index i = 0; i + 1 < r.size(); i += 2) {
    const double length = r.segment<2>(i).norm();
    w[i] = w[i + 1] = length > limit_px ? limit_px / length : 1.0;
  }
  return w;
}

double huberCost(const Eigen::VectorXd& r, double limit_px) {
  double cost = 0.0;
  for (Eigen::Index i = 0; i + 1 < r.size(); i += 2) {
    const double length = r.segment<2>(i).norm();
    cost += length > limit_px ? limit_px * (2.0 * length - limit_px) : length * length;
  }
  return cost / (kOffsetSigmaPx * kOffsetSigmaPx);
}

}  // namespace

TimeOffsetFit::TimeOffsetFit(const PlateMotion& motion, const TimeOffsetOptions& options)
    : motion_(motion), options_(options), flange_(motion.flange, kGap) {
  for (const HookView& view : motion.plate) {
    const double reach = options.largest_offset_s;
    if (flange_.at(view.time) && flange_.at(view.time + reach) && flange_.at(view.time - reach) &&
        !view.cameras.empty()) {
      views_.push_back(&view);
    }
  }
}

OffsetUnknowns TimeOffsetFit::start() const {
  OffsetUnknowns best;
  double least = -1.0;
  const std::size_t stride = std::max<std::size_t>(1, views_.size() / kStarts);
  for (std::size_t i = 0; i < views_.size(); i += stride) {
    const Pose fMe = *flange_.at(views_[i]->time);
    const OffsetUnknowns x{0.0, fMe.inverse(Eigen::Isometry) * motion_.fMc1 * views_[i]->c1Mo_start,
                           motion_.fMc1};
    const std::optional<double> here = cost(x);
    if (here && (least < 0.0 || *here < least)) {
      least = *here;
      best = x;
    }
  }
  return best;
}

std::optional<OffsetUnknowns> TimeOffsetFit::minimise(OffsetUnknowns x, bool with_offset) const {
  double damping = 1e-3;
  std::optional<double> now = cost(x);
  for (int i = 0; now && i < kIterations && damping < 1e8; ++i) {
    OffsetNormal normal = all(x, nullptr);
    if (!with_offset) {
      normal.H.row(0).setZero();
      normal.H.col(0).setZero();
      normal.H(0, 0) = 1.0;
      normal.g[0] = 0.0;
    }
    OffsetSquare damped = normal.H;
    damped.diagonal() *= 1.0 + damping;
    const OffsetStep step = damped.ldlt().solve(normal.g);
    const OffsetUnknowns next = x.moved(step);
    const std::optional<double> then =
        std::abs(next.offset_s) < options_.largest_offset_s ? cost(next) : std::nullopt;
    if (!then || *then > *now) {
      damping *= 10.0;
      continue;
    }
    const bool done = *now - *then < 1e-9 * (1.0 + *now);
    x = next;
    now = then;
    damping = std::max(1e-9, 0.1 * damping);
    if (done) {
      return x;
    }
  }
  return now ? std::optional(x) : std::nullopt;
}

OffsetNormal TimeOffsetFit::all(const OffsetUnknowns& x, std::vector<OffsetStep>* blocks) const {
  OffsetNormal sum;
  addPrior(x, sum);
  Time block_end = views_.front()->time;
  for (const HookView* view : views_) {
    const OffsetNormal one = single(*view, x);
    sum.H += one.H;
    sum.g += one.g;
    sum.squares += one.squares;
    sum.weights += one.weights;
    sum.speed += one.speed;
    if (blocks != nullptr) {
      if (view->time >= block_end) {
        blocks->push_back(OffsetStep::Zero());
        block_end = view->time + kBlock;
      }
      blocks->back() += one.g;
    }
  }
  return sum;
}

OffsetStep TimeOffsetFit::priorResidual(const OffsetUnknowns& x) const {
  const Twist d = logSe3(motion_.fMc1.inverse(Eigen::Isometry) * x.fMc1);
  OffsetStep r = OffsetStep::Zero();
  r.segment<3>(7) = d.head<3>() / options_.told_position_m;
  r.tail<3>() = d.tail<3>() / options_.told_rotation_rad;
  return r;
}

void TimeOffsetFit::addPrior(const OffsetUnknowns& x, OffsetNormal& sum) const {
  OffsetStep scale = OffsetStep::Zero();
  scale.segment<3>(7).setConstant(1.0 / options_.told_position_m);
  scale.tail<3>().setConstant(1.0 / options_.told_rotation_rad);
  sum.H.diagonal() += scale.cwiseAbs2();
  sum.g -= scale.cwiseProduct(priorResidual(x));
}

std::optional<double> TimeOffsetFit::cost(const OffsetUnknowns& x) const {
  double sum = priorResidual(x).squaredNorm();
  for (const HookView* view : views_) {
    const auto r = residuals(*view, flange_, x);
    if (!r) {
      return std::nullopt;
    }
    sum += huberCost(*r, options_.huber_px);
  }
  return sum;
}

OffsetNormal TimeOffsetFit::single(const HookView& view, const OffsetUnknowns& x) const {
  OffsetNormal one;
  const auto r = residuals(view, flange_, x);
  if (!r) {
    return one;
  }
  Eigen::Matrix<double, Eigen::Dynamic, kOffsetUnknowns> J(r->size(), kOffsetUnknowns);
  for (int i = 0; i < kOffsetUnknowns; ++i) {
    OffsetStep d = OffsetStep::Zero();
    d[i] = kDifference;
    const auto ahead = residuals(view, flange_, x.moved(d));
    const auto behind = residuals(view, flange_, x.moved(-d));
    if (!ahead || !behind) {
      return one;
    }
    J.col(i) = (*behind - *ahead) / (2.0 * kDifference);  // of the projection
  }
  const Eigen::VectorXd w = huberWeights(*r, options_.huber_px);
  const double scale = 1.0 / (kOffsetSigmaPx * kOffsetSigmaPx);
  one.H = scale * J.transpose() * w.asDiagonal() * J;
  one.g = scale * J.transpose() * w.cwiseProduct(*r);
  one.squares = r->cwiseAbs2().dot(w);
  one.weights = w.sum();
  one.speed = J.col(0).cwiseAbs2().dot(w);
  return one;
}

}  // namespace ringhook

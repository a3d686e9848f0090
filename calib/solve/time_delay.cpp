#include "calib/solve/time_delay.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace ringhook {
namespace {

using Eigen::Vector2d;

constexpr int kUnknowns = 13;  // offset, eMg, fMc1
using Step = Eigen::Matrix<double, kUnknowns, 1>;
using Square = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr double kGap = 0.05;         // between two states [s]
constexpr double kSigmaPx = 0.1;      // scale of corners against the priors
constexpr double kDifference = 1e-6;  // for derivatives [s, m, rad]
constexpr double kBlock = 0.2;        // of frames whose errors may be of one kind [s]
constexpr double kSlowest = 5.0;      // below, nothing moved [px/s]
constexpr int kIterations = 60;
constexpr int kStarts = 12;

struct Unknowns {
  double offset_s = 0.0;
  Pose eMg = Pose::Identity();
  Pose fMc1 = Pose::Identity();

  [[nodiscard]] Unknowns moved(const Step& d) const {
    return {offset_s + d[0], eMg * expSe3(d.segment<6>(1)), fMc1 * expSe3(d.tail<6>())};
  }
};

/// Residuals of one frame [px], two for each corner; nothing if there is no state or the plate
/// would lie behind a camera.
std::optional<Eigen::VectorXd> residuals(const HookView& view, const MotionSpline& flange,
                                         const Unknowns& x) {
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

/// What one frame, or all of them, say: normal equations with robust weights.
struct Normal {
  Square H = Square::Zero();
  Step g = Step::Zero();
  double cost = 0.0;     ///< of Huber's function
  double squares = 0.0;  ///< weighted [px^2]
  double weights = 0.0;  ///< of residuals
  double speed = 0.0;    ///< squared image speed, weighted [px^2/s^2]
};

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
  return cost / (kSigmaPx * kSigmaPx);
}

class Fit {
 public:
  Fit(const PlateMotion& motion, const TimeOffsetOptions& options)
      : motion_(motion), options_(options), flange_(motion.flange, kGap) {
    for (const HookView& view : motion.plate) {
      const double reach = options.largest_offset_s;
      if (flange_.at(view.time) && flange_.at(view.time + reach) && flange_.at(view.time - reach) &&
          !view.cameras.empty()) {
        views_.push_back(&view);
      }
    }
  }

  [[nodiscard]] std::size_t views() const { return views_.size(); }

  /// The start that explains most: the plate on the flange as single frames saw it.
  [[nodiscard]] Unknowns start() const {
    Unknowns best;
    double least = -1.0;
    const std::size_t stride = std::max<std::size_t>(1, views_.size() / kStarts);
    for (std::size_t i = 0; i < views_.size(); i += stride) {
      const Pose fMe = *flange_.at(views_[i]->time);
      const Unknowns x{0.0, fMe.inverse(Eigen::Isometry) * motion_.fMc1 * views_[i]->c1Mo_start,
                       motion_.fMc1};
      const std::optional<double> here = cost(x);
      if (here && (least < 0.0 || *here < least)) {
        least = *here;
        best = x;
      }
    }
    return best;
  }

  /// Levenberg and Marquardt; `with_offset` false holds the offset.
  [[nodiscard]] std::optional<Unknowns> minimise(Unknowns x, bool with_offset) const {
    double damping = 1e-3;
    std::optional<double> now = cost(x);
    for (int i = 0; now && i < kIterations && damping < 1e8; ++i) {
      Normal normal = all(x, nullptr);
      if (!with_offset) {
        normal.H.row(0).setZero();
        normal.H.col(0).setZero();
        normal.H(0, 0) = 1.0;
        normal.g[0] = 0.0;
      }
      Square damped = normal.H;
      damped.diagonal() *= 1.0 + damping;
      const Step step = damped.ldlt().solve(normal.g);
      const Unknowns next = x.moved(step);
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

  /// Normal equations; each block's gradient into `blocks` if given.
  [[nodiscard]] Normal all(const Unknowns& x, std::vector<Step>* blocks) const {
    Normal sum;
    addPrior(x, sum);
    Time block_end = views_.front()->time;
    for (const HookView* view : views_) {
      const Normal one = single(*view, x);
      sum.H += one.H;
      sum.g += one.g;
      sum.squares += one.squares;
      sum.weights += one.weights;
      sum.speed += one.speed;
      if (blocks != nullptr) {
        if (view->time >= block_end) {
          blocks->push_back(Step::Zero());
          block_end = view->time + kBlock;
        }
        blocks->back() += one.g;
      }
    }
    return sum;
  }

 private:
  [[nodiscard]] Step priorResidual(const Unknowns& x) const {
    const Twist d = logSe3(motion_.fMc1.inverse(Eigen::Isometry) * x.fMc1);
    Step r = Step::Zero();
    r.segment<3>(7) = d.head<3>() / options_.told_position_m;
    r.tail<3>() = d.tail<3>() / options_.told_rotation_rad;
    return r;
  }
  void addPrior(const Unknowns& x, Normal& sum) const {
    Step scale = Step::Zero();
    scale.segment<3>(7).setConstant(1.0 / options_.told_position_m);
    scale.tail<3>().setConstant(1.0 / options_.told_rotation_rad);
    sum.H.diagonal() += scale.cwiseAbs2();
    sum.g -= scale.cwiseProduct(priorResidual(x));
  }

  [[nodiscard]] std::optional<double> cost(const Unknowns& x) const {
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

  [[nodiscard]] Normal single(const HookView& view, const Unknowns& x) const {
    Normal one;
    const auto r = residuals(view, flange_, x);
    if (!r) {
      return one;
    }
    Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> J(r->size(), kUnknowns);
    for (int i = 0; i < kUnknowns; ++i) {
      Step d = Step::Zero();
      d[i] = kDifference;
      const auto ahead = residuals(view, flange_, x.moved(d));
      const auto behind = residuals(view, flange_, x.moved(-d));
      if (!ahead || !behind) {
        return one;
      }
      J.col(i) = (*behind - *ahead) / (2.0 * kDifference);  // of the projection
    }
    const Eigen::VectorXd w = huberWeights(*r, options_.huber_px);
    const double scale = 1.0 / (kSigmaPx * kSigmaPx);
    one.H = scale * J.transpose() * w.asDiagonal() * J;
    one.g = scale * J.transpose() * w.cwiseProduct(*r);
    one.squares = r->cwiseAbs2().dot(w);
    one.weights = w.sum();
    one.speed = J.col(0).cwiseAbs2().dot(w);
    return one;
  }

  const PlateMotion& motion_;
  const TimeOffsetOptions& options_;
  MotionSpline flange_;
  std::vector<const HookView*> views_;
};

/// Standard deviation of the offset: what the residuals' spread says, as independent values and by
/// blocks of time, whichever is larger.
double offsetSigma(const Normal& normal, const std::vector<Step>& blocks) {
  const Square inverse = normal.H.ldlt().solve(Square::Identity());
  Square spread = Square::Zero();
  for (const Step& g : blocks) {
    spread += g * g.transpose();
  }
  const auto count = static_cast<double>(blocks.size());
  spread *= count / std::max(0.5 * count, count - kUnknowns);  // what the fit took away
  const double by_blocks = (inverse * spread * inverse)(0, 0);
  const double variance = normal.squares / std::max(1.0, normal.weights - kUnknowns);
  const double independent = inverse(0, 0) * variance / (kSigmaPx * kSigmaPx);
  return std::sqrt(std::max(by_blocks, independent));
}

double rms(const Normal& normal) { return std::sqrt(normal.squares / normal.weights); }

std::string milliseconds(double s) {
  return std::to_string(static_cast<int>(std::lround(1e3 * s))) + " ms";
}

}  // namespace

Outcome<TimeOffset> findTimeOffset(const PlateMotion& motion, const TimeOffsetOptions& options) {
  if (static_cast<int>(motion.plate.size()) < options.fewest_views) {
    return Refusal{"too few pictures of the plate: " + std::to_string(motion.plate.size()) +
                   ", expected at least " + std::to_string(options.fewest_views)};
  }
  if (motion.flange.size() < 10) {
    return Refusal{"too few states of the arm"};
  }
  const Fit fit(motion, options);
  if (2 * fit.views() < motion.plate.size() ||
      static_cast<int>(fit.views()) < options.fewest_views) {
    return Refusal{"no state of the arm around most pictures: only " + std::to_string(fit.views()) +
                   " of " + std::to_string(motion.plate.size()) + " lie between states"};
  }
  const std::optional<Unknowns> held = fit.minimise(fit.start(), false);
  const std::optional<Unknowns> best = held ? fit.minimise(*held, true) : std::nullopt;
  if (!best) {
    return Refusal{"the arm's states do not explain what the cameras saw"};
  }
  std::vector<Step> blocks;
  const Normal normal = fit.all(*best, &blocks);
  TimeOffset found;
  found.offset_s = best->offset_s;
  found.rms_px = rms(normal);
  found.rms_without_px = rms(fit.all(*held, nullptr));
  found.image_speed_px_s = std::sqrt(normal.speed / normal.weights);
  found.sigma_s = offsetSigma(normal, blocks);
  found.views = static_cast<int>(fit.views());
  found.eMg = best->eMg;
  found.fMc1 = best->fMc1;
  if (found.image_speed_px_s < kSlowest) {
    return Refusal{"the plate hardly moved in the images"};
  }
  if (found.rms_px > options.largest_rms_px) {
    return Refusal{"the arm's states do not explain what the cameras saw: " +
                   std::to_string(found.rms_px) + " px remain"};
  }
  if (std::abs(found.offset_s) > 0.95 * options.largest_offset_s) {
    return Refusal{"the delay is larger than " + milliseconds(options.largest_offset_s)};
  }
  if (!(found.sigma_s < options.largest_sigma_s)) {
    return Refusal{"the plate moved too little to tell the delay"};
  }
  return found;
}

}  // namespace ringhook

#include "stereo/joint_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "stereo/joint_residuals.h"

namespace ringhook {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// A step is too small to matter when it promises less than this share of the cost, which counts in
// sigma^2: 1e-5 standard deviations. Steps below it drown in the rounding of the cost.
constexpr double kConverged = 1e-10;
constexpr double kSmallestDamping = 1e-9;  // share of the diagonal
constexpr double kLargestDamping = 1e9;
constexpr double kRankLimit = 1e-10;  // smallest eigenvalue of the normal matrix, diagonal 1

struct NormalEquations {
  Matrix6 H = Matrix6::Zero();  // J^T W J
  Vector6 g = Vector6::Zero();  // J^T W r
};

double informationOf(const ResidualRow& row) {
  return row.weight * row.independence / (row.sigma_px * row.sigma_px);
}

NormalEquations normalEquations(const ResidualRows& rows) {
  NormalEquations out;
  for (const ResidualRow& row : rows.rows) {
    const double information = informationOf(row);
    out.H.noalias() += information * row.J.transpose() * row.J;
    out.g.noalias() += (information * row.r_px) * row.J.transpose();
  }
  return out;
}

/// Cost of `rows` under the weights of `weighed`.
double costUnder(const ResidualRows& weighed, const ResidualRows& rows) {
  double cost = 0.0;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    cost += informationOf(weighed.rows[i]) * rows.rows[i].r_px * rows.rows[i].r_px;
  }
  return cost;
}

/// H with unit diagonal has full rank: every motion is seen.
bool seesEveryMotion(const Matrix6& H) {
  const Vector6 scale = H.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0.0)) {
    return false;
  }
  const Matrix6 scaled = scale.cwiseInverse().asDiagonal() * H * scale.cwiseInverse().asDiagonal();
  // The smallest eigenvalue is above the limit: what is left without it is positive definite.
  return Eigen::LLT<Matrix6>(scaled - kRankLimit * Matrix6::Identity()).info() == Eigen::Success;
}

class Minimiser {
 public:
  Minimiser(const HookView& view, const JointPoseOptions& options)
      : view_(view), options_(options), c1Mo_(view.c1Mo_start) {}

  /// Levenberg-Marquardt with weights renewed at every accepted pose.
  Outcome<HookFix> run() {
    if (!evaluateRows(view_, c1Mo_, rows_)) {
      return Refusal{"behind camera"};
    }
    if (rows_.rows.empty()) {
      return Refusal{"no features"};
    }
    if (rows_.rows.size() < 6) {
      return Refusal{"too few features"};
    }
    refreshWeights();
    for (int i = 0; i < options_.largest_iterations && damping_ < kLargestDamping; ++i) {
      const NormalEquations normal = normalEquations(rows_);
      if (!normal.g.allFinite() || !seesEveryMotion(normal.H)) {
        return Refusal{"too few features"};
      }
      if (step(normal)) {
        return judged();
      }
    }
    // Views that contradict each other leave the robust cost flat: the residual says more then.
    Outcome<HookFix> last = judged();
    if (last) {
      return Refusal{"not converged"};
    }
    return last;
  }

 private:
  void refreshWeights() {
    countSharedEdges(view_, options_.edge_correlation, rows_);
    weighRows(options_, rows_);
  }

  /// One damped step; true when it was too small to matter.
  bool step(const NormalEquations& normal) {
    Matrix6 damped = normal.H;
    damped.diagonal() *= 1.0 + damping_;
    const Vector6 d = -damped.llt().solve(normal.g);
    const Pose candidate = c1Mo_ * expSe3(d);
    const double cost = costUnder(rows_, rows_);
    const bool small = damping_ <= 1.0 && -normal.g.dot(d) < kConverged * (1.0 + cost);
    if (!evaluateRows(view_, candidate, trial_) || !(costUnder(rows_, trial_) <= cost)) {
      damping_ *= 10.0;
      return small;
    }
    c1Mo_ = candidate;
    std::swap(rows_, trial_);
    refreshWeights();
    damping_ = std::max(0.1 * damping_, kSmallestDamping);
    return small;
  }

  /// The fix with its covariance, or the reason why it is not believed.
  [[nodiscard]] Outcome<HookFix> judged() const {
    HookFix fix;
    fix.time = view_.time;
    fix.c1Mo = c1Mo_;
    double weights = 0.0;
    double squares_px = 0.0;
    double chi_square = 0.0;
    std::size_t edges_used = 0;
    for (std::size_t i = 0; i < rows_.rows.size(); ++i) {
      const ResidualRow& row = rows_.rows[i];
      weights += row.weight;
      squares_px += row.weight * row.r_px * row.r_px;
      chi_square += row.weight * std::pow(row.r_px / row.sigma_px, 2);
      fix.features += row.weight > 0.0 ? 1 : 0;
      edges_used += i >= rows_.corner_rows && row.weight > 0.0 ? 1 : 0;
    }
    const auto edges = static_cast<double>(rows_.rows.size() - rows_.corner_rows);
    if (static_cast<double>(edges_used) < options_.smallest_inlier_share * edges) {
      return Refusal{"too many outliers"};
    }
    fix.rms_px = std::sqrt(squares_px / weights);
    if (!(fix.rms_px <= options_.largest_rms_px)) {
      return Refusal{"residual too large"};
    }
    const Matrix6 H = normalEquations(rows_).H;
    if (!seesEveryMotion(H)) {
      return Refusal{"too few features"};
    }
    fix.covariance =
        inflation(chi_square, weights - 6.0) * Matrix6(H.llt().solve(Matrix6::Identity()));
    return fix;
  }

  /// Reduced chi-square where it is significantly above 1, else 1.
  static double inflation(double chi_square, double freedom) {
    if (freedom < 1.0) {
      return 1.0;
    }
    const double reduced = chi_square / freedom;
    return reduced > 1.0 + 3.0 * std::sqrt(2.0 / freedom) ? reduced : 1.0;
  }

  const HookView& view_;
  const JointPoseOptions& options_;
  Pose c1Mo_;
  ResidualRows rows_;
  ResidualRows trial_;
  double damping_ = 1e-4;  // share of the diagonal
};

}  // namespace

Outcome<HookFix> fixFromView(const HookView& view, const JointPoseOptions& options) {
  return Minimiser(view, options).run();
}

}  // namespace ringhook

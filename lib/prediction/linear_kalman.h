#pragma once

/// \file
/// The linear Kalman filter as two pure functions, predict and correct, on a Gaussian belief.
/// Equations after the 2007 report (Jeyabalan, Fork project), which cites Welch and Bishop:
///   x_k = A x_{k-1} + e, e ~ N(0, Q)   (3.3)      y_k = C x_k + d, d ~ N(0, R)   (3.4)
///   x- = A x (3.5)     P- = A P A^T + Q (3.6)
///   x = x- + K (y - C x-) (3.7)     K = P- C^T (C P- C^T + R)^-1 (3.8)
/// The report's covariance update P = (I - K C) P- (3.13) is replaced by Joseph's form
/// P = (I - K C) P- (I - K C)^T + K R K^T, equal for the optimal K and insensitive to errors of K
/// in first order (Bucy and Joseph, 1968); multiplied out, and made symmetric after rounding. The
/// limits that the report gives (3.9 to 3.12: R -> 0 trusts the measurement, P- -> 0 the
/// prediction) are tests. Unlike the report, R need not be diagonal. Sizes are static, or
/// Eigen::Dynamic.

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/time.h"

namespace ringhook {

/// a * b, coefficient by coefficient: as fast at these sizes as Eigen's blocked product, which
/// takes seconds to compile. Not for a state of fifty or more.
template <class A, class B>
Eigen::Matrix<double, A::RowsAtCompileTime, B::ColsAtCompileTime> product(const A& a, const B& b) {
  return a.lazyProduct(b);
}

/// a b a^T
template <class A, class B>
Eigen::Matrix<double, A::RowsAtCompileTime, A::RowsAtCompileTime> carried(const A& a, const B& b) {
  return product(product(a, b), a.transpose());
}

/// Belief about a state of size N; units as the state defines them.
template <int N>
struct Gaussian {
  Eigen::Matrix<double, N, 1> mean;
  Eigen::Matrix<double, N, N> covariance;
};

/// What one measurement did to a belief.
template <int N, int M>
struct Correction {
  Gaussian<N> belief;                                 ///< a posteriori
  Eigen::Matrix<double, M, 1> innovation;             ///< y - C x-
  Eigen::Matrix<double, M, M> innovation_covariance;  ///< S = C P- C^T + R
  double nis = 0.0;  ///< innovation^T S^-1 innovation: chi-square of M degrees if consistent
};

/// What a filter says of a measurement that it took.
struct FilterUpdate {
  Time time;         ///< of the measurement; the filter's state is of this instant now
  double nis = 0.0;  ///< normalised innovation squared
  int degrees = 0;   ///< of freedom of `nis`: the measurement's size
};

/// Equations 3.5 and 3.6. A: N x N, Q: N x N symmetric positive semidefinite.
template <int N>
Gaussian<N> kalmanPredict(const Gaussian<N>& belief, const Eigen::Matrix<double, N, N>& A,
                          const Eigen::Matrix<double, N, N>& Q) {
  Gaussian<N> ahead;
  ahead.mean = product(A, belief.mean);
  const Eigen::Matrix<double, N, N> P = carried(A, belief.covariance) + Q;
  ahead.covariance = 0.5 * (P + P.transpose());
  return ahead;
}

/// Equations 3.7, 3.8 and 3.13 (Joseph's form). C: M x N, R: M x M symmetric positive definite.
template <int N, int M>
Correction<N, M> kalmanCorrect(const Gaussian<N>& prior, const Eigen::Matrix<double, M, 1>& y,
                               const Eigen::Matrix<double, M, N>& C,
                               const Eigen::Matrix<double, M, M>& R) {
  Correction<N, M> result;
  const Eigen::Matrix<double, M, N> CP = product(C, prior.covariance);
  result.innovation = y - product(C, prior.mean);
  result.innovation_covariance = product(CP, C.transpose()) + R;
  const Eigen::LLT<Eigen::Matrix<double, M, M>> llt(result.innovation_covariance);
  const Eigen::Matrix<double, N, M> K = llt.solve(CP).transpose();
  result.nis = result.innovation.dot(llt.solve(result.innovation));
  result.belief.mean = prior.mean + product(K, result.innovation);
  // Joseph's form multiplied out from left to right: each factor I - K C as what it takes away.
  const Eigen::Matrix<double, N, N> left = prior.covariance - product(K, CP);
  const Eigen::Matrix<double, N, M> seen = product(K, R) - product(left, C.transpose());
  const Eigen::Matrix<double, N, N> P = left + product(seen, K.transpose());
  result.belief.covariance = 0.5 * (P + P.transpose());
  return result;
}

}  // namespace ringhook

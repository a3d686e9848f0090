#pragma once

/// \file
/// A linear law in continuous time, sampled without error.
/// Law: x' = F x + w with white noise w of density W. After dt, x+ = A x + e with
///   A = exp(F dt),   cov(e) = Q = integral from 0 to dt of exp(F s) W exp(F s)^T ds.
/// Both stand in one matrix exponential (Van Loan, "Computing integrals involving the matrix
/// exponential", IEEE Trans. Automatic Control 23(3), 1978):
///   exp([-F W; 0 F^T] dt) = [. A^-1 Q; 0 A^T].
/// So process noise is told as physics, a push per second, and fits any step.

#include <Eigen/Core>

namespace ringhook {

struct SampledLaw {
  Eigen::MatrixXd transition;  ///< A, N x N
  Eigen::MatrixXd noise;       ///< Q, N x N, symmetric
};

/// `drift`: F [1/s], N x N; `density`: W, N x N symmetric positive semidefinite [unit^2/s];
/// `dt` >= 0 [s].
SampledLaw sampleLaw(const Eigen::MatrixXd& drift, const Eigen::MatrixXd& density, double dt);

}  // namespace ringhook

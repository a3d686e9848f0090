#pragma once

/// \file
/// Pose of the hook that explains all features of all cameras at once: weighted least reprojection
/// error over the rigid motion, by Levenberg-Marquardt on SE(3) with right increments
/// c1Mo * exp(d) (twist d at and in o), analytic Jacobians (Marchand, Uchiyama, Spindler, "Pose
/// estimation for augmented reality", TVCG 2016). Residuals: two per corner (pixel), one per edge
/// site (signed distance of the pixel to the projected model line, Comport et al., TVCG 2006).
/// Robust by reweighting (Huber 1981): corners by Huber's weight on their standardised length, edge
/// sites by Tukey's biweight whose scale is the MAD of all sites, but at least the given sigma.
/// Covariance: (J^T W J)^-1 with W of sigma and robust weight. Sites on one edge share errors
/// (lighting, blur, model), so n sites of one edge in one view, correlated by rho, count as
/// n / (1 + (n - 1) rho). When the residuals are larger than sigma allows (reduced chi-square more
/// than three standard deviations above 1), the covariance grows by that ratio.

#include "core/hook_values.h"
#include "core/outcome.h"

namespace ringhook {

struct JointPoseOptions {
  double huber_sigmas = 3.0;           ///< standardised corner error from which weight falls
  double tukey_sigmas = 4.685;         ///< standardised site error from which weight is zero
  double edge_correlation = 0.05;      ///< rho between two sites of one edge, 0 to 1
  double largest_rms_px = 2.0;         ///< limit of HookFix::rms_px
  double smallest_inlier_share = 0.5;  ///< of the edge sites with a weight above zero
  int largest_iterations = 50;
};

/// Refuses "no features", "too few features" (less than six residuals, or a motion that none of
/// them sees), "behind camera" (at the start), "not converged", "too many outliers" and
/// "residual too large". rms_px is weighted by the robust weights; `features` counts residuals with
/// a weight above zero.
Outcome<HookFix> fixFromView(const HookView& view, const JointPoseOptions& options = {});

}  // namespace ringhook

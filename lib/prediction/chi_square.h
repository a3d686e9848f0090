#pragma once

/// \file
/// The chi-square law, for gates and consistency bands: the normalised innovation squared of a
/// consistent filter follows it (Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to
/// Tracking and Navigation", 2001, section 5.4).
/// Law: P(x; k) = regularised lower incomplete gamma P(k/2, x/2) (Abramowitz and Stegun, 6.5.1).

namespace ringhook {

/// Probability that a chi-square variable of `degrees` > 0 is at most `x`; 0 for x <= 0.
double chiSquareCdf(double x, double degrees);

/// The x with chiSquareCdf(x, degrees) = probability, 0 < probability < 1, by bisection.
double chiSquareQuantile(double probability, double degrees);

}  // namespace ringhook

#include "prediction/chi_square.h"

#include <cassert>
#include <cmath>

namespace ringhook {
namespace {

// P(a, x) = x^a e^-x / Gamma(a) * sum_n x^n / (a (a+1) ... (a+n)), Abramowitz and Stegun 6.5.29.
// All terms are positive, so nothing cancels, however large x is; only the work grows.
double lowerGammaSeries(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > 1e-17 * sum; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

}  // namespace

double chiSquareCdf(double x, double degrees) {
  assert(degrees > 0.0);
  if (!(x > 0.0)) {
    return 0.0;
  }
  return std::fmin(1.0, lowerGammaSeries(0.5 * degrees, 0.5 * x));
}

double chiSquareQuantile(double probability, double degrees) {
  assert(probability > 0.0 && probability < 1.0);
  double low = 0.0;
  double high = degrees;
  while (chiSquareCdf(high, degrees) < probability) {
    high *= 2.0;
  }
  for (int i = 0; i < 100 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chiSquareCdf(middle, degrees) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace ringhook

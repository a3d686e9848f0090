#include "prediction/swing_law.h"

#include <cmath>

namespace ringhook {
namespace {

double dryPart(double rate, double corner) { return std::tanh(rate / corner); }

double drySlope(double rate, double corner) {
  const double t = std::tanh(rate / corner);
  return (1.0 - t * t) / corner;
}

/// Sines, cosines, lengths and the felt gravity that both equations use.
struct Parts {
  double sa, ca, sb, cb;
  double Ax, Ay, G;  // G = g + A_z
  double Lx, Ly;
  double wa, wb;
};

Parts partsOf(const SwingVector& s, const SwingLaw& law) {
  const double Lx = std::exp(s(kSwingLogLength));
  return {std::sin(s(kSwingAngle)),
          std::cos(s(kSwingAngle)),
          std::sin(s(kSwingAngle + 1)),
          std::cos(s(kSwingAngle + 1)),
          s(kSwingAcceleration),
          s(kSwingAcceleration + 1),
          law.gravity + s(kSwingAcceleration + 2),
          Lx,
          Lx * std::exp(s(kSwingLengthRatio)),
          s(kSwingRate),
          s(kSwingRate + 1)};
}

double pullAboutX(const Parts& p) { return (-p.Ay * p.ca - p.G * p.sa) / (p.Lx * p.cb); }

double pullAboutY(const Parts& p) {
  return (p.Ax * p.cb + p.Ay * p.sa * p.sb - p.G * p.ca * p.sb) / p.Ly;
}

double centrifugal(const Parts& p) { return -(p.Lx / p.Ly) * p.sb * p.cb * p.wa * p.wa; }

// Row of a'' = 2 tan(b) a' b' + pullAboutX - D(a').
void fillAboutX(const Parts& p, const SwingVector& s, const SwingLaw& law, SwingSlopeJacobian& J) {
  auto row = J.row(kSwingRate);
  const double over = 1.0 / (p.Lx * p.cb);
  const double pull = pullAboutX(p);
  row(kSwingAcceleration + 1) = -p.ca * over;
  row(kSwingAcceleration + 2) = -p.sa * over;
  row(kSwingAngle) = (p.Ay * p.sa - p.G * p.ca) * over;
  row(kSwingAngle + 1) = 2.0 * p.wa * p.wb / (p.cb * p.cb) + pull * p.sb / p.cb;
  row(kSwingRate) =
      2.0 * p.sb / p.cb * p.wb - s(kSwingViscous) - s(kSwingDry) * drySlope(p.wa, law.dry_corner);
  row(kSwingRate + 1) = 2.0 * p.sb / p.cb * p.wa;
  row(kSwingLogLength) = -pull;
  row(kSwingViscous) = -p.wa;
  row(kSwingDry) = -dryPart(p.wa, law.dry_corner);
}

// Row of b'' = centrifugal + pullAboutY - D(b').
void fillAboutY(const Parts& p, const SwingVector& s, const SwingLaw& law, SwingSlopeJacobian& J) {
  auto row = J.row(kSwingRate + 1);
  const double pull = pullAboutY(p);
  const double ratio = p.Lx / p.Ly;
  row(kSwingAcceleration) = p.cb / p.Ly;
  row(kSwingAcceleration + 1) = p.sa * p.sb / p.Ly;
  row(kSwingAcceleration + 2) = -p.ca * p.sb / p.Ly;
  row(kSwingAngle) = (p.Ay * p.ca * p.sb + p.G * p.sa * p.sb) / p.Ly;
  row(kSwingAngle + 1) = -ratio * (p.cb * p.cb - p.sb * p.sb) * p.wa * p.wa +
                         (-p.Ax * p.sb + p.Ay * p.sa * p.cb - p.G * p.ca * p.cb) / p.Ly;
  row(kSwingRate) = -2.0 * ratio * p.sb * p.cb * p.wa;
  row(kSwingRate + 1) = -s(kSwingViscous) - s(kSwingDry) * drySlope(p.wb, law.dry_corner);
  row(kSwingLogLength) = -pull;
  row(kSwingLengthRatio) = -pull - centrifugal(p);
  row(kSwingViscous) = -p.wb;
  row(kSwingDry) = -dryPart(p.wb, law.dry_corner);
}

}  // namespace

SwingSlope swingSlope(const SwingVector& s, const SwingLaw& law) {
  const Parts p = partsOf(s, law);
  SwingSlope slope;
  slope.segment<3>(kSwingPivot) = s.segment<3>(kSwingSpeed);
  slope.segment<3>(kSwingSpeed) = s.segment<3>(kSwingAcceleration);
  slope.segment<3>(kSwingAcceleration) = -s.segment<3>(kSwingAcceleration) / law.memory_s;
  slope.segment<2>(kSwingAngle) = s.segment<2>(kSwingRate);
  const double c = s(kSwingViscous);
  const double k = s(kSwingDry);
  slope(kSwingRate) = 2.0 * p.sb / p.cb * p.wa * p.wb + pullAboutX(p) - c * p.wa -
                      k * dryPart(p.wa, law.dry_corner);
  slope(kSwingRate + 1) =
      centrifugal(p) + pullAboutY(p) - c * p.wb - k * dryPart(p.wb, law.dry_corner);
  return slope;
}

SwingSlopeJacobian swingSlopeJacobian(const SwingVector& s, const SwingLaw& law) {
  SwingSlopeJacobian J = SwingSlopeJacobian::Zero();
  J.block<3, 3>(kSwingPivot, kSwingSpeed).setIdentity();
  J.block<3, 3>(kSwingSpeed, kSwingAcceleration).setIdentity();
  J.block<3, 3>(kSwingAcceleration, kSwingAcceleration).diagonal().setConstant(-1.0 / law.memory_s);
  J.block<2, 2>(kSwingAngle, kSwingRate).setIdentity();
  const Parts p = partsOf(s, law);
  fillAboutX(p, s, law, J);
  fillAboutY(p, s, law, J);
  return J;
}

}  // namespace ringhook

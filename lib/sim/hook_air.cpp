#include "sim/hook_air.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace ringhook {
namespace {

constexpr double kBar = 2.0;
constexpr double kPlate = 1.2;
constexpr double kPieceLength = 0.05;  // [m]

/// The shank from z = `low` to `high`, in pieces.
void addShank(const HookShape& s, double low, double high, std::vector<AirPiece>& pieces) {
  const int count = std::max(1, static_cast<int>(std::lround((high - low) / kPieceLength)));
  const double half = 0.5 * (high - low) / count;
  for (int i = 0; i < count; ++i) {
    HookPart box;
    box.center_o = {0.0, -s.arc_radius, low + (2 * i + 1) * half};
    box.half_size = {0.5 * s.bar_thickness, 0.5 * s.bar_width, half};
    pieces.push_back({box, kBar});
  }
}

}  // namespace

std::vector<AirPiece> hookAirPieces(const HookShape& s) {
  std::vector<AirPiece> pieces;
  const double below = s.plate_centre_z - 0.5 * s.plate_height;
  const double above = s.plate_centre_z + 0.5 * s.plate_height;
  addShank(s, 0.0, below, pieces);
  addShank(s, above, s.shank_length, pieces);
  const std::vector<HookPart> plates = hookPlates(s);
  const double back = plates[1].center_o.x() - plates[1].half_size.x();
  HookPart plate = plates[0];
  plate.center_o.x() = 0.5 * (s.plate_face_x + back);
  plate.half_size.x() = 0.5 * (s.plate_face_x - back);
  pieces.push_back({plate, kPlate});
  std::vector<HookPart> bars = hookBars(s);
  pieces.push_back({bars[1], kBar});               // the tip; the first one is the shank
  for (std::size_t i = 2; i < bars.size(); ++i) {  // the arc, here without overlaps
    bars[i].half_size.y() = 0.5 * bars[i].mass / (kSteelDensity * s.bar_width * s.bar_thickness);
    pieces.push_back({bars[i], kBar});
  }
  return pieces;
}

std::string hookAirXml() {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const AirPiece& piece : hookAirPieces()) {
    const Eigen::Vector3d& at = piece.box.center_o;
    const Eigen::Vector3d& half = piece.box.half_size;
    text << "<geom type=\"box\" group=\"3\" contype=\"0\" conaffinity=\"0\" pos=\"" << at.x() << ' '
         << at.y() << ' ' << at.z() << "\" size=\"" << half.x() << ' ' << half.y() << ' '
         << half.z() << "\" euler=\"" << piece.box.angle_x
         << " 0 0\" fluidshape=\"ellipsoid\" fluidcoef=\""
         << 2.0 * piece.drag_coefficient / std::numbers::pi << " 0 0 0 0\"/>\n";
  }
  return text.str();
}

}  // namespace ringhook

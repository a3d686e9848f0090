#include "sim/hook_shape.h"

#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

using Points = std::vector<Eigen::Vector3d>;

std::ostringstream metres() {
  std::ostringstream text;
  text << std::fixed << std::setprecision(6);
  return text;
}

/// Radius of chord vertices whose chords keep the mean distance `radius` from the centre:
/// the mean of 1/cos over the half angle h is ln(sec h + tan h) / h.
double vertexRadius(double radius, int chords) {
  const double h = std::numbers::pi / (2.0 * chords);
  return radius * h / (std::cos(h) * std::log(1.0 / std::cos(h) + std::tan(h)));
}

/// Half circle below z = 0 from -y to +y; end points exactly on the circle.
std::vector<Eigen::Vector2d> lowerArc(double radius, int chords) {
  std::vector<Eigen::Vector2d> arc;
  const double off = vertexRadius(radius, chords);
  for (int i = 0; i <= chords; ++i) {
    const double angle = std::numbers::pi * (1.0 + static_cast<double>(i) / chords);
    const double r = i == 0 || i == chords ? radius : off;
    arc.emplace_back(r * std::cos(angle), i == 0 || i == chords ? 0.0 : r * std::sin(angle));
  }
  return arc;
}

/// Points and two-point lines of an edge model.
struct EdgeModel {
  Points points;
  std::vector<std::pair<std::size_t, std::size_t>> lines;

  void chain(const Points& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i > 0) {
        lines.emplace_back(points.size() - 1, points.size());
      }
      points.push_back(corners[i]);
    }
  }
};

Points atDepth(const std::vector<Eigen::Vector2d>& outline, double x) {
  Points points;
  for (const Eigen::Vector2d& p : outline) {
    points.emplace_back(x, p.x(), p.y());
  }
  return points;
}

/// Rectangle in the plane x, counter-clockwise seen from +x, from its lower left corner.
Points rectangle(double x, double centre_y, double centre_z, double width, double height) {
  const double y0 = centre_y - width / 2.0;
  const double z0 = centre_z - height / 2.0;
  return {{x, y0, z0}, {x, y0 + width, z0}, {x, y0 + width, z0 + height}, {x, y0, z0 + height}};
}

Points plateFace(const HookShape& s, double x) {
  return rectangle(x, -s.arc_radius, s.plate_centre_z, s.plate_width, s.plate_height);
}

/// Without the sign that a rounding error would print before a zero.
Eigen::Vector3d cleaned(const Eigen::Vector3d& p) {
  return p.unaryExpr([](double v) { return std::abs(v) < 5e-7 ? 0.0 : v; });
}

void writePoints(std::ostream& text, const Points& points, const char* prefix) {
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = cleaned(point);
    text << prefix << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
}

/// A prism: the outline at x0 and at x1, its two ends and its sides as Wavefront faces.
void writePrism(std::ostream& text, const char* name, const std::vector<Eigen::Vector2d>& outline,
                double x0, double x1, std::size_t first) {
  text << "o " << name << '\n';
  writePoints(text, atDepth(outline, x0), "v ");
  writePoints(text, atDepth(outline, x1), "v ");
  const std::size_t n = outline.size();
  text << 'f';
  for (std::size_t i = 0; i < n; ++i) {
    text << ' ' << first + n + i;
  }
  text << "\nf";
  for (std::size_t i = n; i-- > 0;) {
    text << ' ' << first + i;
  }
  text << '\n';
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    text << "f " << first + i << ' ' << first + j << ' ' << first + n + j << ' ' << first + n + i
         << '\n';
  }
}

}  // namespace

Pose HookShape::oMk() const {
  Pose pose = Pose::Identity();
  pose.linear() << 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  pose.translation() = Eigen::Vector3d(plate_face_x, -arc_radius, plate_centre_z);
  return pose;
}

void checkHookShape(const HookShape& shape) {
  constexpr double kLargest = 5.0;  // [m]
  const auto check = [](bool good, const std::string& sentence) {
    if (!good) {
      throw InputError("hook: " + sentence);
    }
  };
  const std::pair<const char*, double> measures[] = {
      {"bar width", shape.bar_width},         {"bar thickness", shape.bar_thickness},
      {"arc radius", shape.arc_radius},       {"shank length", shape.shank_length},
      {"tip rise", shape.tip_rise},           {"plate width", shape.plate_width},
      {"plate height", shape.plate_height},   {"plate face", shape.plate_face_x},
      {"plate centre", shape.plate_centre_z}, {"tag size", shape.tag_size},
      {"tag distance", shape.tag_distance},   {"tracked top", shape.tracked_top}};
  for (const auto& [name, value] : measures) {
    check(value >= 0.0005 && value <= kLargest, std::string(name) + ": expected 0.5 mm to 5000 mm");
  }
  const double plate_bottom = shape.plate_centre_z - shape.plate_height / 2.0;
  const double plate_top = shape.plate_centre_z + shape.plate_height / 2.0;
  check(shape.arc_radius > 0.55 * shape.bar_width,
        "arc radius: expected more than half the bar width, or the J closes");
  check(shape.plate_face_x > shape.bar_thickness / 2.0,
        "plate face: expected in front of the bar, beyond half the bar thickness");
  check(shape.tag_distance >= shape.tag_size, "tag distance: expected at least the tag size");
  check(shape.plate_width >= shape.tag_size, "plate width: expected at least the tag size");
  check(shape.plate_height >= shape.tag_distance + shape.tag_size,
        "plate height: expected at least tag distance and tag size together");
  check(plate_bottom > 0.0, "plate centre: expected so high that the plate ends above the arc");
  check(shape.tracked_top > plate_top && shape.tracked_top <= shape.shank_length,
        "tracked top: expected between the plate's top and the shank length");
  check(shape.arc_chords >= 4 && shape.arc_chords <= 256, "arc chords: expected 4 to 256");
}

std::vector<Eigen::Vector2d> barOutline(const HookShape& shape, double top_z, int arc_chords) {
  const double outer = shape.arc_radius + shape.bar_width / 2.0;
  const double inner = shape.arc_radius - shape.bar_width / 2.0;
  std::vector<Eigen::Vector2d> outline{{-outer, top_z}};
  const auto outer_arc = lowerArc(outer, arc_chords);
  outline.insert(outline.end(), outer_arc.begin(), outer_arc.end());
  outline.emplace_back(outer, shape.tip_rise);
  outline.emplace_back(inner, shape.tip_rise);
  const auto inner_arc = lowerArc(inner, arc_chords);
  outline.insert(outline.end(), inner_arc.rbegin(), inner_arc.rend());
  outline.emplace_back(-inner, top_z);
  return outline;
}

std::string hookCao(const HookShape& shape) {
  const double front = shape.bar_thickness / 2.0;
  const double left = -shape.arc_radius - shape.bar_width / 2.0;
  const double right = -shape.arc_radius + shape.bar_width / 2.0;
  const double plate_bottom = shape.plate_centre_z - shape.plate_height / 2.0;
  const double plate_top = shape.plate_centre_z + shape.plate_height / 2.0;
  EdgeModel bar;
  bar.chain(atDepth(barOutline(shape, plate_bottom, shape.arc_chords), front));
  bar.chain({{front, left, plate_top}, {front, left, shape.tracked_top}});
  bar.chain({{front, right, plate_top}, {front, right, shape.tracked_top}});
  const Points plate = plateFace(shape, shape.plate_face_x);

  std::ostringstream text = metres();
  text << "V1\n# Hook in frame o [m]: x to the cameras, y to the tip, z up the shank\n"
       << "# 3D points: bar, then plate\n"
       << bar.points.size() + plate.size() << '\n';
  writePoints(text, bar.points, "");
  writePoints(text, plate, "");
  text << "# 3D lines: bar below the plate, bar above the plate\n" << bar.lines.size() << '\n';
  for (const auto& [from, to] : bar.lines) {
    text << from << ' ' << to << '\n';
  }
  const std::size_t p = bar.points.size();
  text << "# Faces from 3D lines\n0\n# Faces from 3D points: plate\n1\n"
       << "4 " << p << ' ' << p + 1 << ' ' << p + 2 << ' ' << p + 3 << '\n'
       << "# 3D cylinders\n0\n# 3D circles\n0\n";
  return text.str();
}

std::string hookObj(const HookShape& shape) {
  constexpr int kArcChords = 64;
  const double half = shape.bar_thickness / 2.0;
  const auto bar = barOutline(shape, shape.shank_length, kArcChords);
  std::vector<Eigen::Vector2d> plate;
  for (const Eigen::Vector3d& p : plateFace(shape, half)) {
    plate.emplace_back(p.y(), p.z());
  }
  std::ostringstream text = metres();
  text << "# Hook in frame o [m]: x to the cameras, y to the tip, z up the shank\n";
  writePrism(text, "bar", bar, -half, half, 1);
  writePrism(text, "plate", plate, half, shape.plate_face_x, 1 + 2 * bar.size());
  return text.str();
}

std::string markerYaml(const HookShape& shape) {
  const Pose oMk = shape.oMk();
  Eigen::Quaterniond q(oMk.linear());
  q.coeffs() *= q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d t = oMk.translation();
  std::ostringstream text = metres();
  text << "# Tag plate of the hook; tag and plate frames: x right, y down as one reads it [m]\n"
       << "family: tag36h11\nlayout:\n";
  for (int id = 0; id < 2; ++id) {
    const double y = (id == 0 ? -0.5 : 0.5) * shape.tag_distance;
    text << "  - {id: " << id << ", size: " << shape.tag_size << ", x: 0, y: " << y
         << ", z: 0, qw: 1, qx: 0, qy: 0, qz: 0}\n";
  }
  text << "# Plate in the hook frame\noMk: {x: " << t.x() << ", y: " << t.y() << ", z: " << t.z()
       << ", qw: " << q.w() << ", qx: " << q.x() << ", qy: " << q.y() << ", qz: " << q.z() << "}\n";
  return text.str();
}

}  // namespace ringhook

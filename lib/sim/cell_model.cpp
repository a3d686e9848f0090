#include "sim/cell_model.h"

#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "sim/arm_visuals.h"
#include "sim/cell_visuals.h"
#include "sim/hook_air.h"
#include "sim/hook_body.h"
#include "sim/hook_hinges.h"
#include "sim/mjcf_text.h"

namespace ringhook {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;

// Contact groups: a pair collides if one's contype meets the other's conaffinity.
constexpr const char* kRingContact = R"( contype="1" conaffinity="1")";
constexpr const char* kHookContact = R"( contype="2" conaffinity="1")";
constexpr const char* kToolContact = R"( contype="4" conaffinity="3")";
constexpr const char* kFloorContact = R"( contype="0" conaffinity="8")";
constexpr const char* kRingFloorContact = R"( contype="8" conaffinity="0")";
constexpr const char* kNotDrawn = R"( group="3")";
constexpr const char* kNoContact = R"( contype="0" conaffinity="0")";

// ---- Arm

struct Link {
  double alpha, a, d, offset;  // modified DH [rad], [m], [m], [rad]
  double mass;                 // assumption [kg]
  double radius;               // of the link's capsule [m]
  Eigen::Vector3d end;         // of that capsule, from the link's origin [m]
};

const Link kLinks[6] = {
    {0.0, 0.0, 0.341, 0.0, 14.0, 0.070, {0.0, 0.0, -0.12}},
    {-kHalfPi, 0.0, 0.0, -kHalfPi, 8.0, 0.050, {0.290, 0.0, 0.0}},
    {0.0, 0.290, 0.049, kHalfPi, 4.0, 0.050, {0.0, 0.06, 0.0}},
    {kHalfPi, 0.0, 0.310, 0.0, 3.0, 0.040, {0.0, 0.0, -0.24}},
    {-kHalfPi, 0.0, 0.0, 0.0, 1.0, 0.038, {0.0, 0.0, 0.0}},
    {kHalfPi, 0.0, 0.065, 0.0, 0.3, 0.025, {0.0, 0.0, -0.03}},
};

Pose linkPose(const Link& link) {
  return Pose(Eigen::AngleAxisd(link.alpha, Eigen::Vector3d::UnitX())) *
         Eigen::Translation3d(link.a, 0.0, 0.0) *
         Eigen::AngleAxisd(link.offset, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(0.0, 0.0, link.d);
}

/// A jaw in the flange frame: side +1 is the lower one (x_e points down while placing).
std::string jaw(const char* name, double side, const CellOptions& options) {
  constexpr double kHingeBehind = 0.018;
  constexpr double kAir = 0.0002;
  constexpr double kHalfThickness = 0.0015;
  constexpr double kBeyondWire = 0.0035;
  const double x = side * (0.5 * options.ring.wire_diameter + kAir + kHalfThickness);
  const double half_length = 0.5 * (kHingeBehind + kBeyondWire + 0.004);
  std::ostringstream text;
  text << "<body name=\"jaw_" << name << "\""
       << attribute("pos", Eigen::Vector3d(x, 0.0, options.gripper.rim_distance - kHingeBehind))
       << ">\n<joint name=\"" << name << "\" type=\"hinge\" armature=\"1e-4\" damping=\"0.012\""
       << attribute("axis", Eigen::Vector3d(0.0, side, 0.0)) << "/>\n"
       << inertial(0.015, {0.0, 0.0, 0.008}, Eigen::Vector3d(1e-6, 1e-6, 4e-7).asDiagonal())
       << box({0.0, 0.0, half_length - 0.004}, {kHalfThickness, 0.005, half_length},
              std::string(kToolContact) + " material=\"gripper\"")
       << "</body>\n";
  return text.str();
}

std::string gripper(const CellOptions& options) {
  const double palm = options.gripper.rim_distance - 0.024;  // ends 2 mm before the jaws' roots
  return box({0.0, 0.0, 0.5 * palm}, {0.018, 0.020, 0.5 * palm},
             std::string(kToolContact) + kNotDrawn) +
         gripperVisualXml(palm) + jaw("upper", -1.0, options) + jaw("lower", 1.0, options);
}

std::string arm(const CellOptions& options) {
  std::ostringstream text;
  text << "<geom type=\"cylinder\" size=\"0.09 0.11\" pos=\"0 0 0.11\"" << kNotDrawn << kToolContact
       << "/>\n"
       << baseVisualXml();
  for (int i = 0; i < 6; ++i) {
    const Link& link = kLinks[i];
    const double inertia =
        link.mass * (0.4 * link.radius * link.radius + link.end.squaredNorm() / 12.0);
    text << "<body name=\"link" << i + 1 << "\"" << placing(linkPose(link)) << ">\n<joint name=\"j"
         << i + 1 << "\" type=\"hinge\" axis=\"0 0 1\" armature=\"" << (i < 3 ? 3.0 : 0.3)
         << "\"/>\n"
         << inertial(link.mass, 0.5 * link.end, inertia * Eigen::Matrix3d::Identity())
         << capsule(Eigen::Vector3d::Zero(), link.end + Eigen::Vector3d(0.0, 0.0, 1e-4),
                    link.radius, std::string(kToolContact) + kNotDrawn)
         << linkVisualXml(i + 1);
  }
  text << gripper(options);
  for (int i = 0; i < 6; ++i) {
    text << "</body>\n";
  }
  return text.str();
}

// ---- Belt and hooks

std::string hook(const CellOptions& options, const HookDraw& draw, int index) {
  const Eigen::Vector3d pivot = hookPivot(draw.pivot_height);
  const double back = options.belt.start_y - index * options.hook.spacing;
  const Eigen::Vector3d pivot_f(options.belt.x, back, options.belt.pivot_z);
  std::ostringstream text;
  text << "<body name=\"hook" << index << "\"" << attribute("pos", pivot_f - pivot) << ">\n";
  text << hookHingesXml(draw, index);
  for (const HookPart& part : hookBars()) {
    text << box(part.center_o, part.half_size,
                attribute("euler", Eigen::Vector3d(part.angle_x, 0.0, 0.0)) + kHookContact +
                    " material=\"steel\"");
  }
  for (const HookPart& part : hookPlates()) {
    text << box(part.center_o, part.half_size, std::string(kHookContact) + kNotDrawn);
  }
  text << hookAirXml() << tagPlateXml();
  text << "</body>\n";
  return text.str();
}

std::string belt(const CellOptions& options, const CellDraw& draw) {
  std::ostringstream text;
  text << box({options.belt.x, 0.0, options.belt.pivot_z + 0.05}, {0.03, 3.0, 0.02},
              std::string(kNoContact) + " material=\"belt\"")
       << "<body name=\"belt\">\n<joint name=\"belt\" type=\"slide\" axis=\"0 1 0\"/>\n"
       << inertial(1e4, {options.belt.x, 0.0, options.belt.pivot_z + 0.05},
                   1e3 * Eigen::Matrix3d::Identity());
  for (int i = 0; i < options.hook.count; ++i) {
    const double y = options.belt.start_y - i * options.hook.spacing;
    text << box({options.belt.x, y, options.belt.pivot_z + 0.015}, {0.012, 0.02, 0.015},
                std::string(kNoContact) + " material=\"belt\"")
         << hook(options, draw.hooks[static_cast<std::size_t>(i)], i);
  }
  text << "</body>\n";
  return text.str();
}

// ---- Rings

std::string ring(const RingOptions& options, int index) {
  const double a = 0.5 * options.wire_diameter;
  const double radius = options.radius();
  const double pi = std::numbers::pi;
  const double mass = kSteelDensity * pi * a * a * 2.0 * pi * radius;
  const double axial = mass * (radius * radius + 0.75 * a * a);
  const double across = mass * (0.5 * radius * radius + 0.625 * a * a);
  const auto rim = [&](double angle, double r) {
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
  };
  // Corners a little outside the circle, so that the chords' mean radius is the true one.
  const double half = pi / options.segments;
  const double corner = radius * (1.0 + half * half / 3.0);
  std::ostringstream text;
  text << "<body name=\"ring" << index << "\"" << placing(magazinePose(index)) << ">\n"
       << "<freejoint name=\"ring" << index << "\"/>\n"
       << inertial(mass, Eigen::Vector3d::Zero(),
                   Eigen::Vector3d(across, across, axial).asDiagonal());
  for (int i = 0; i < options.segments; ++i) {
    text << capsule(rim(2.0 * half * i, corner), rim(2.0 * half * (i + 1), corner), a,
                    attribute("friction", Eigen::Vector3d(options.friction, 0.002, 1e-4)) +
                        kRingContact + " material=\"ring\"");
  }
  for (int i = 0; i < 8; ++i) {
    text << "<geom type=\"sphere\" group=\"3\"" << attribute("size", a)
         << attribute("pos", rim(0.25 * pi * i, radius)) << kRingFloorContact << "/>\n";
  }
  text << "</body>\n";
  return text.str();
}

std::string equalities(const CellOptions& options) {
  const Pose eMr = gripPose(options);
  const Eigen::Quaterniond q(eMr.linear());
  Eigen::VectorXd relpose(7);
  relpose << eMr.translation(), q.w(), q.x(), q.y(), q.z();
  std::ostringstream text;
  for (int i = 0; i < options.ring.count; ++i) {
    text << "<weld name=\"grip" << i << "\" body1=\"link6\" body2=\"ring" << i
         << "\" active=\"false\" solref=\"0.002 1\" solimp=\"0.98 0.99 0.0005\""
         << attribute("relpose", relpose) << "/>\n";
  }
  return text.str();
}

/// Time step, medium, solver, and room for the constraints of every ring and hook at once.
std::string solverSettings(const CellOptions& options) {
  std::ostringstream text;
  text << "<option" << attribute("timestep", options.physics_step)
       << attribute("density", options.air_density) << attribute("viscosity", options.air_viscosity)
       << attribute("gravity", Eigen::Vector3d(0.0, 0.0, -kGravity))
       << " cone=\"elliptic\" solver=\"Newton\" tolerance=\"1e-8\" impratio=\"3\"/>\n<size njmax=\""
       << 300 + 60 * options.ring.count + 2 * options.hook.count << "\" nconmax=\""
       << 100 + 20 * options.ring.count << "\"/>\n<default><geom"
       << " solref=\"0.003 1\" solimp=\"0.95 0.99 0.0005\" friction=\"0.25 0.002 1e-4\"/>"
       << "</default>\n";
  return text.str();
}

std::string looks(const CellOptions& options) {
  return "<visual>" + visualSettingsXml() + "</visual>\n<asset>" + visualAssetXml(options.scene) +
         "</asset>\n";
}

}  // namespace

Pose gripPose(const CellOptions& options) {
  Pose eMr = Pose::Identity();
  eMr.linear() << 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0;
  eMr.translation().z() = options.gripper.rim_distance + options.ring.radius();
  return eMr;
}

Pose magazinePose(int index) {
  return Pose(Eigen::Translation3d(-0.50, 0.30, 0.05 + 0.10 * index));
}

std::string cellModelXml(const CellOptions& options, const CellDraw& draw) {
  std::ostringstream text;
  text << "<mujoco model=\"ringhook cell\">\n<compiler angle=\"radian\"/>\n"
       << solverSettings(options) << looks(options) << "<worldbody>\n"
       << "<geom name=\"floor\" type=\"plane\" size=\"3 3 0.1\" material=\"floor\"" << kFloorContact
       << "/>\n"
       << sceneVisualXml(options.scene, options.seed) << arm(options) << belt(options, draw);
  for (int i = 0; i < options.ring.count; ++i) {
    text << ring(options.ring, i);
  }
  text << "</worldbody>\n<equality>\n" << equalities(options) << "</equality>\n<actuator>\n";
  for (const char* name : {"upper", "lower"}) {
    text << "<position name=\"" << name << "\" joint=\"" << name << "\" kp=\"0.36\"/>\n";
  }
  text << "</actuator>\n</mujoco>\n";
  return text.str();
}

}  // namespace ringhook

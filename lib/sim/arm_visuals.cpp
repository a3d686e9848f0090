#include "sim/arm_visuals.h"

#include <iomanip>
#include <sstream>

#include "sim/visual_geom.h"

namespace ringhook {
namespace {

using Eigen::Vector3d;

constexpr double kPlateHalfThickness = 0.001;

const char* const kShell = "arm";
const char* const kJoint = "arm_dark";

/// Column that turns on the pedestal, and the shoulder's housing around joint 2 (along y).
std::string shoulder() {
  return visualCylinder({0, 0, -0.135}, {0, 0, -0.06}, 0.088, kShell) +
         visualBox({0, 0.005, -0.035}, {0.078, 0.070, 0.040}, kShell) +
         visualCylinder({0, -0.075, 0}, {0, 0.072, 0}, 0.080, kShell) +
         visualCylinder({0, -0.083, 0}, {0, -0.075, 0}, 0.060, kJoint);
}

/// Beside the shoulder: from joint 2 to joint 3, 290 mm along x.
std::string upperArm() {
  return visualCylinder({0, 0, 0.074}, {0, 0, 0.142}, 0.078, kShell) +
         visualCylinder({0.290, 0, 0.096}, {0.290, 0, 0.142}, 0.062, kShell) +
         visualBox({0.145, 0, 0.118}, {0.145, 0.050, 0.023}, kShell) +
         visualBox({0.145, 0, 0.1415}, {0.115, 0.026, 0.0015}, kJoint) +
         visualCylinder({0, 0, 0.142}, {0, 0, 0.150}, 0.050, kJoint) +
         visualCylinder({0.290, 0, 0.142}, {0.290, 0, 0.149}, 0.042, kJoint);
}

/// Around joint 3, 49 mm nearer than the upper arm; the forearm leaves along -y.
std::string elbow() {
  return visualCylinder({0, 0, -0.050}, {0, 0, 0.046}, 0.062, kShell) +
         visualCylinder({0, 0, -0.057}, {0, 0, -0.050}, 0.044, kJoint) +
         visualBox({0, 0.052, 0}, {0.046, 0.052, 0.044}, kShell) +
         visualCylinder({0, -0.030, 0}, {0, -0.085, 0}, 0.053, kShell);
}

/// Forearm: turns about z, ends at the wrist's fork.
std::string forearm() {
  return visualCylinder({0, 0, -0.225}, {0, 0, -0.214}, 0.046, kJoint) +
         visualCylinder({0, 0, -0.214}, {0, 0, -0.120}, 0.048, kShell) +
         visualCylinder({0, 0, -0.120}, {0, 0, -0.036}, 0.040, kShell) +
         visualBox({0, 0.031, -0.012}, {0.026, 0.007, 0.030}, kShell) +
         visualBox({0, -0.031, -0.012}, {0.026, 0.007, 0.030}, kShell) +
         visualCylinder({0, 0.024, 0}, {0, 0.041, 0}, 0.026, kShell) +
         visualCylinder({0, -0.041, 0}, {0, -0.024, 0}, 0.026, kShell);
}

/// Around joint 5, along z; the hand leaves along -y.
std::string wrist() {
  return visualCylinder({0, 0, -0.023}, {0, 0, 0.023}, 0.025, kJoint) +
         visualCylinder({0, -0.012, 0}, {0, -0.046, 0}, 0.021, kShell);
}

/// Ends in the flange's plane z = 0.
std::string flange() {
  return visualCylinder({0, 0, -0.019}, {0, 0, -0.007}, 0.021, kJoint) +
         visualCylinder({0, 0, -0.007}, {0, 0, 0}, 0.025, "metal");
}

}  // namespace

std::string baseVisualXml() {
  return visualCylinder({0, 0, 0}, {0, 0, 0.018}, 0.130, kJoint) +
         visualCylinder({0, 0, 0.018}, {0, 0, 0.190}, 0.094, kShell) +
         visualCylinder({0, 0, 0.190}, {0, 0, 0.206}, 0.090, kJoint) +
         visualBox({-0.115, 0, 0.070}, {0.030, 0.060, 0.050}, kJoint);
}

std::string linkVisualXml(int link) {
  switch (link) {
    case 1:
      return shoulder();
    case 2:
      return upperArm();
    case 3:
      return elbow();
    case 4:
      return forearm();
    case 5:
      return wrist();
    default:
      return flange();
  }
}

std::string gripperVisualXml(double palm_length) {
  const TagPlateFace face = gripperPlateFace();
  const Vector3d plate = eMg().translation();
  Pose back = eMg();
  back.translation() += kPlateHalfThickness * back.linear().col(2);
  back.linear() = eMg().linear() * Vector3d(1, -1, -1).asDiagonal();  // printed side is +z
  const double lower_edge = plate.x() + 0.5 * face.height;
  return visualCylinder({0, 0, 0}, {0, 0, 0.012}, 0.028, "metal") +
         visualBox({0, 0, 0.5 * (0.012 + 0.070)}, {0.018, 0.020, 0.5 * (0.070 - 0.012)},
                   "gripper") +
         visualBox({0, 0, 0.5 * (0.070 + palm_length)}, {0.010, 0.016, 0.5 * (palm_length - 0.070)},
                   "metal") +
         visualBox({0.5 * (lower_edge - 0.018) - 0.006, 0, plate.z() - 0.006},
                   {0.5 * (-0.018 - lower_edge) + 0.012, 0.010, 0.003}, "gripper") +
         visualBox(back, {0.5 * face.width, 0.5 * face.height, kPlateHalfThickness},
                   "gripper_plate");
}

TagPlateFace gripperPlateFace() { return {0.044, 0.088, 0.032, 0.044, {2, 3}}; }

std::string gripperMarkerYaml() {
  const TagPlateFace face = gripperPlateFace();
  const double middle = 0.5 * (static_cast<double>(face.ids.size()) - 1.0);
  std::ostringstream text;
  text << "# Tag plate of the gripper; tag and plate frames: x right, y down as one reads it [m]\n"
          "family: tag36h11\nlayout:\n"
       << std::fixed << std::setprecision(6);
  for (std::size_t place = 0; place < face.ids.size(); ++place) {
    text << "  - {id: " << face.ids[place] << ", size: " << face.tag_size
         << ", x: 0, y: " << (static_cast<double>(place) - middle) * face.tag_distance
         << ", z: 0, qw: 1, qx: 0, qy: 0, qz: 0}\n";
  }
  return text.str();
}

Pose eMg() {
  Pose pose = Pose::Identity();
  pose.linear() << 0, 1, 0,  //
      1, 0, 0,               //
      0, 0, -1;
  pose.translation() << -0.085, 0.0, 0.055;
  return pose;
}

}  // namespace ringhook

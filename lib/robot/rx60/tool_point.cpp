#include "robot/rx60/tool_point.h"

#include <Eigen/Geometry>
#include <cmath>

namespace ringhook::rx60 {

ToolPoint toolPoint(const Geometry& g, const Eigen::Vector3d& tool_e, const JointVector& q) {
  using Eigen::Vector3d;
  const double c1 = std::cos(q(0)), s1 = std::sin(q(0));
  const double c2 = std::cos(q(1)), s2 = std::sin(q(1));
  const double c23 = std::cos(q(1) + q(2)), s23 = std::sin(q(1) + q(2));
  const double c4 = std::cos(q(3)), s4 = std::sin(q(3));
  const double c5 = std::cos(q(4)), s5 = std::sin(q(4));
  const double c6 = std::cos(q(5)), s6 = std::sin(q(5));

  // Axes of the arm's plane: across it (joints 2 and 3), along the upper arm and the forearm, and
  // square to the forearm within the plane.
  const Vector3d across(-s1, c1, 0.0);
  const Vector3d upper(c1 * s2, s1 * s2, c2);
  const Vector3d fore(c1 * s23, s1 * s23, c23);
  const Vector3d square(c1 * c23, s1 * c23, -s23);
  const Vector3d axis5 = c4 * across - s4 * square;
  const Vector3d tilted = c4 * square + s4 * across;  // direction into which joint 5 bends
  const Vector3d axis6 = s5 * tilted + c5 * fore;

  const double x = c6 * tool_e.x() - s6 * tool_e.y();
  const double y = s6 * tool_e.x() + c6 * tool_e.y();
  const Vector3d beyond =
      x * (c5 * tilted - s5 * fore) + y * axis5 + (g.flange + tool_e.z()) * axis6;
  const Vector3d from_elbow = g.forearm * fore + beyond;
  const Vector3d from_shoulder = g.upper_arm * upper + from_elbow;

  ToolPoint tool;
  tool.position = Vector3d(0.0, 0.0, g.base_height) + g.shoulder_offset * across + from_shoulder;
  tool.fJ.col(0) << -tool.position.y(), tool.position.x(), 0.0;
  tool.fJ.col(1) = across.cross(from_shoulder);
  tool.fJ.col(2) = across.cross(from_elbow);
  tool.fJ.col(3) = fore.cross(beyond);
  tool.fJ.col(4) = axis5.cross(beyond);
  tool.fJ.col(5) = axis6.cross(beyond);
  const double sin3 = s23 * c2 - c23 * s2;
  const double radius = g.upper_arm * s2 + g.forearm * s23;
  tool.manipulability = std::abs(g.upper_arm * g.forearm * sin3 * radius * s5);
  return tool;
}

}  // namespace ringhook::rx60

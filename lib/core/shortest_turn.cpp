#include "core/shortest_turn.h"

namespace ringhook {

using Eigen::Vector3d;

constexpr double kOpposite = 1e-8;  // [rad] from opposite; below it the sum names no axis

Eigen::Quaterniond shortestTurn(const Vector3d& from, const Vector3d& to) {
  const Vector3d a = from.normalized();
  const Vector3d middle = a + to.normalized();
  if (middle.norm() < kOpposite) {
    const Vector3d axis = a.unitOrthogonal();
    return {0.0, axis.x(), axis.y(), axis.z()};
  }
  const Vector3d half_way = middle.normalized();
  const Vector3d v = a.cross(half_way);  // sine of half the angle, along the axis
  return {a.dot(half_way), v.x(), v.y(), v.z()};
}

}  // namespace ringhook

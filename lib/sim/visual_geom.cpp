#include "sim/visual_geom.h"

#include <iomanip>
#include <sstream>

namespace ringhook {
namespace {

std::ostringstream opened(const char* type) {
  std::ostringstream text;
  text << std::setprecision(17) << "<geom type=\"" << type
       << "\" contype=\"0\" conaffinity=\"0\" mass=\"0\"";
  return text;
}

std::string between(const char* type, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    double radius, const std::string& material) {
  std::ostringstream text = opened(type);
  text << " fromto=\"" << from.transpose() << ' ' << to.transpose() << "\" size=\"" << radius
       << "\" material=\"" << material << "\"/>\n";
  return text.str();
}

}  // namespace

std::string visualBox(const Pose& pose, const Eigen::Vector3d& half_size,
                      const std::string& material, const std::string& colour) {
  const Eigen::Quaterniond q(pose.linear());
  std::ostringstream text = opened("box");
  text << " pos=\"" << pose.translation().transpose() << "\" quat=\"" << q.w() << ' ' << q.x()
       << ' ' << q.y() << ' ' << q.z() << "\" size=\"" << half_size.transpose() << "\" material=\""
       << material << '"';
  if (!colour.empty()) {
    text << " rgba=\"" << colour << '"';
  }
  text << "/>\n";
  return text.str();
}

std::string visualBox(const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
                      const std::string& material) {
  return visualBox(Pose(Eigen::Translation3d(centre)), half_size, material);
}

std::string visualCapsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                          const std::string& material) {
  return between("capsule", from, to, radius, material);
}

std::string visualCylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                           const std::string& material) {
  return between("cylinder", from, to, radius, material);
}

}  // namespace ringhook

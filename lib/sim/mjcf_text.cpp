#include "sim/mjcf_text.h"

#include <iomanip>
#include <sstream>

namespace ringhook {

std::string attribute(const char* name, const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::ostringstream text;
  text << std::setprecision(17) << ' ' << name << "=\"";
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text << (i > 0 ? " " : "") << values[i];
  }
  text << '"';
  return text.str();
}

std::string attribute(const char* name, double value) {
  return attribute(name, Eigen::VectorXd::Constant(1, value));
}

std::string placing(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return attribute("pos", pose.translation()) +
         attribute("quat", Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

std::string inertial(double mass, const Eigen::Vector3d& center, const Eigen::Matrix3d& inertia) {
  Eigen::VectorXd full(6);
  full << inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2);
  return "<inertial" + attribute("mass", mass) + attribute("pos", center) +
         attribute("fullinertia", full) + "/>\n";
}

std::string box(const Eigen::Vector3d& pos, const Eigen::Vector3d& half, const std::string& more) {
  return "<geom type=\"box\"" + attribute("pos", pos) + attribute("size", half) + more + "/>\n";
}

std::string capsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                    const std::string& more) {
  Eigen::VectorXd ends(6);
  ends << from, to;
  return "<geom type=\"capsule\"" + attribute("fromto", ends) + attribute("size", radius) + more +
         "/>\n";
}

}  // namespace ringhook

#include "sim/hook_hinges.h"

#include <sstream>

#include "sim/hook_body.h"
#include "sim/mjcf_text.h"

namespace ringhook {

std::string hookHingesXml(const HookDraw& draw, int index) {
  const Eigen::Vector3d pivot = hookPivot(draw.pivot_height);
  const HookMass mass = hookMass();
  std::ostringstream text;
  for (const char* axis : {"x", "y"}) {
    text << "<joint name=\"hook" << index << '_' << axis << "\" type=\"hinge\" axis=\""
         << (*axis == 'x' ? "1 0 0" : "0 1 0") << '"' << attribute("pos", pivot)
         << attribute("frictionloss", draw.friction) << attribute("damping", draw.damping)
         << "/>\n";
  }
  text << inertial(mass.mass, mass.center_o, mass.inertia_o);
  return text.str();
}

}  // namespace ringhook

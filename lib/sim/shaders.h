#pragma once

/// \file
/// The programs that draw Solids (GLSL 3.30), and their compilation. Light is added up linearly:
/// no gamma anywhere, as in a machine-vision sensor.
///   albedo * (surroundings by the normal's height + key lamp * shadow + fill lamp)   (Lambert)
///   + specular * (Blinn's highlight of the key lamp * shadow + mirrored lamp rows)
/// (J. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977.)
/// Shadows: depth seen from the key lamp, compared at 16 places around each point (percentage
/// closer filtering, Reeves, Salesin, Cook, SIGGRAPH 1987).
/// Printed textures: a texel's border is spread over exactly one pixel, the integral of the print
/// over the pixel; so the print's edges stay where they are at any size of the picture.

#include <string>

namespace ringhook {

/// Places vertices; attributes: see kPlace in shaders.cpp.
std::string sceneVertexShader();
std::string sceneFragmentShader();
/// For the shadow map.
std::string depthVertexShader();
std::string depthFragmentShader();

/// A linked program of the current context; the caller deletes it. Throws DeviceError with the
/// driver's words.
unsigned linkProgram(const std::string& vertex, const std::string& fragment);

}  // namespace ringhook

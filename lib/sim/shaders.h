#pragma once

/// \file
/// The programs that draw Solids (GLSL 3.30), and their compilation. Light is added up linearly:
/// no gamma anywhere, as in a machine-vision sensor.
///   albedo * (surroundings by the normal's height + fill lamp + key lamp * shadow)   (Lambert)
///   + specular * (Blinn's highlight of the key lamp * shadow + mirrored lamp rows)
/// (J. Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977.)
/// Lambert's part is worked out at the vertices, highlights at every pixel. A software renderer
/// takes both sides of every branch, so each kind of surface gets a program without branches.
/// Shadows: depth seen from the key lamp, compared at the four texels around each point (percentage
/// closer filtering, Reeves, Salesin, Cook, SIGGRAPH 1987).
/// Printed textures: a texel's border is spread over exactly one pixel, the integral of the print
/// over the pixel; so the print's edges stay where they are at any size of the picture.

#include <string>

namespace ringhook {

/// How a texture is put on: not at all, as a printed pattern, as a smooth picture that repeats.
enum class TextureKind { none = 0, print = 1, picture = 2 };

/// What a program can do.
struct SurfaceKind {
  TextureKind texture = TextureKind::none;
  bool specular = false;
  bool shadows = true;
  bool colour = false;  ///< false: one grey value, scaled by the uniform `white`
};

/// Places vertices; attributes and uniforms: see kPlace, kSceneVertex in shaders.cpp.
std::string sceneVertexShader(const SurfaceKind& kind);
std::string sceneFragmentShader(const SurfaceKind& kind);
/// For the shadow map.
std::string depthVertexShader();
std::string depthFragmentShader();

/// A linked program of the current context; the caller deletes it. Throws DeviceError with the
/// driver's words.
unsigned linkProgram(const std::string& vertex, const std::string& fragment);

}  // namespace ringhook

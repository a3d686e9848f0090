#include "sim/shaders.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr const char* kVersion = "#version 330\n";

// A vertex of a unit mesh, and the solid that it belongs to.
constexpr const char* kPlace = R"(
layout(location = 0) in vec3 unit_position;
layout(location = 1) in vec3 unit_normal;
layout(location = 2) in float unit_end;
layout(location = 3) in vec3 axis_x;
layout(location = 4) in vec3 axis_y;
layout(location = 5) in vec3 axis_z;
layout(location = 6) in vec3 origin;
layout(location = 7) in vec4 half_size;  // and half length
layout(location = 8) in vec4 colour;     // and specular
layout(location = 9) in vec3 finish;     // shininess, texture repeat x and y
vec3 placed(vec3 p) { return p.x * axis_x + p.y * axis_y + p.z * axis_z; }
vec3 point() {
  return origin + placed(unit_position * half_size.xyz + vec3(0.0, 0.0, unit_end * half_size.w));
}
)";

constexpr const char* kSceneVertex = R"(
uniform mat4 to_clip;
uniform mat4 to_shadow;
uniform float shadow_bias;  // along the normal, so that no surface shades itself [m]
uniform vec3 towards_key;
uniform vec3 towards_fill;
uniform vec4 lamps;         // key, fill, sky, ground
out vec3 in_shadow;
out TONE always;
out TONE by_key;
#if PRINT || PICTURE
out vec2 place;
flat out float printed;
#endif
#if SPECULAR
out vec3 from_eye;
out vec3 normal;
flat out vec2 gloss;
#endif
void main() {
  vec3 p = point();
  vec3 n = normalize(placed(unit_normal / half_size.xyz));
  in_shadow = (to_shadow * vec4(p + shadow_bias * n, 1.0)).xyz;
#if COLOUR
  TONE albedo = colour.rgb;
#else
  TONE albedo = dot(colour.rgb, vec3(0.299, 0.587, 0.114));  // luma of ITU-R BT.601
#endif
  float around = mix(lamps.w, lamps.z, 0.5 + 0.5 * n.z);
  always = albedo * (around + lamps.y * max(dot(n, towards_fill), 0.0));
  by_key = albedo * (lamps.x * max(dot(n, towards_key), 0.0));
#if PRINT || PICTURE
  place = vec2(0.5 + 0.5 * unit_position.x, 0.5 - 0.5 * unit_position.y) * finish.yz;
  printed = abs(unit_normal.z) > 0.5 ? 1.0 : 0.0;
#endif
#if SPECULAR
  from_eye = p;
  normal = n;
  gloss = vec2(colour.a, 4.0 + 124.0 * finish.x);
#endif
  gl_Position = to_clip * vec4(p, 1.0);
}
)";

constexpr const char* kSceneFragment = R"(
in vec3 in_shadow;
in TONE always;
in TONE by_key;
uniform sampler2D print;
uniform sampler2DShadow shadow_map;
uniform float white;
out vec4 result;

#if PRINT
in vec2 place;
flat in float printed;
float onSurface() {
  vec2 size = vec2(textureSize(print, 0));
  vec2 texel = place * size;
  vec2 width = max(fwidth(texel), vec2(1e-6));
  vec2 border = floor(texel + 0.5);
  vec2 at = (border + clamp((texel - border) / width, -0.5, 0.5)) / size;
  return mix(1.0, textureLod(print, at, 0.0).r, printed);
}
#elif PICTURE
in vec2 place;
flat in float printed;
float onSurface() { return mix(1.0, textureLod(print, place, 0.0).r, printed); }
#else
float onSurface() { return 1.0; }
#endif

#if SPECULAR
in vec3 from_eye;
in vec3 normal;
flat in vec2 gloss;
uniform vec3 towards_key;
uniform vec4 lamps;
uniform float tubes;

/// Rows of lamps under the roof, as polished metal mirrors them.
float mirrored(vec3 ray) {
  float row = abs(fract(2.5 * ray.y / (abs(ray.z) + 0.3)) - 0.5);
  float lamp = smoothstep(0.30, 0.42, row) * smoothstep(0.05, 0.35, ray.z);
  return 0.15 + 0.20 * ray.z + lamp;
}

float shine(float lit) {
  vec3 n = normalize(normal);
  vec3 v = normalize(-from_eye);
  float half_angle = max(dot(n, normalize(v + towards_key)), 0.0);
  float key = dot(n, towards_key) > 0.0 ? lit * lamps.x : 0.0;
  return gloss.x * (key * pow(half_angle, gloss.y) + tubes * mirrored(reflect(-v, n)));
}
#else
float shine(float lit) { return 0.0; }
#endif

void main() {
#if SHADOWS
  float lit = texture(shadow_map, in_shadow);
#else
  float lit = 1.0;
#endif
  TONE tone = onSurface() * (always + lit * by_key) + shine(lit);
#if COLOUR
  result = vec4(tone, 1.0);
#else
  result = vec4(white * tone);
#endif
}
)";

constexpr const char* kDepthVertex = R"(
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(point(), 1.0); }
)";

constexpr const char* kDepthFragment = R"(
void main() {}
)";

std::string choices(const SurfaceKind& kind) {
  const auto choice = [](const char* name, bool chosen) {
    return std::string("#define ") + name + (chosen ? " 1\n" : " 0\n");
  };
  return choice("PRINT", kind.texture == TextureKind::print) +
         choice("PICTURE", kind.texture == TextureKind::picture) +
         choice("SPECULAR", kind.specular) + choice("SHADOWS", kind.shadows) +
         choice("COLOUR", kind.colour) + "#define TONE " + (kind.colour ? "vec3\n" : "float\n");
}

unsigned compile(GLenum kind, const std::string& text) {
  const unsigned shader = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::array<char, 1000> words{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
    throw DeviceError(std::string("OpenGL refused a shader: ") + words.data());
  }
  return shader;
}

}  // namespace

std::string sceneVertexShader(const SurfaceKind& kind) {
  return kVersion + choices(kind) + kPlace + kSceneVertex;
}

std::string sceneFragmentShader(const SurfaceKind& kind) {
  return kVersion + choices(kind) + kSceneFragment;
}

std::string depthVertexShader() { return std::string(kVersion) + kPlace + kDepthVertex; }

std::string depthFragmentShader() { return std::string(kVersion) + kDepthFragment; }

unsigned linkProgram(const std::string& vertex, const std::string& fragment) {
  const unsigned program = glCreateProgram();
  const unsigned parts[2] = {compile(GL_VERTEX_SHADER, vertex),
                             compile(GL_FRAGMENT_SHADER, fragment)};
  for (const unsigned part : parts) {
    glAttachShader(program, part);
    glDeleteShader(part);
  }
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == 0) {
    throw DeviceError("OpenGL could not link a program; OpenGL 3.3 is needed");
  }
  return program;
}

}  // namespace ringhook

#include "sim/shaders.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>

#include "core/error.h"

namespace ringhook {
namespace {

// A vertex of a unit mesh, and the solid that it belongs to.
constexpr const char* kPlace = R"(#version 330
layout(location = 0) in vec3 unit_position;
layout(location = 1) in vec3 unit_normal;
layout(location = 2) in float unit_end;
layout(location = 3) in vec3 axis_x;
layout(location = 4) in vec3 axis_y;
layout(location = 5) in vec3 axis_z;
layout(location = 6) in vec3 origin;
layout(location = 7) in vec4 half_size;  // and half length
layout(location = 8) in vec4 colour;     // and specular
layout(location = 9) in vec4 finish;     // shininess, texture repeat x and y, unused
vec3 placed(vec3 p) { return p.x * axis_x + p.y * axis_y + p.z * axis_z; }
vec3 point() {
  return origin + placed(unit_position * half_size.xyz + vec3(0.0, 0.0, unit_end * half_size.w));
}
)";

constexpr const char* kSceneVertex = R"(
uniform mat4 to_clip;
uniform mat4 to_shadow;
uniform float shadow_bias;  // along the normal, so that no surface shades itself [m]
out vec3 from_eye;
out vec3 normal;
out vec3 in_shadow;
out vec2 place;
flat out vec4 paint;
flat out float shininess;
flat out float printed;
void main() {
  vec3 p = point();
  from_eye = p;
  normal = normalize(placed(unit_normal / half_size.xyz));
  in_shadow = (to_shadow * vec4(p + shadow_bias * normal, 1.0)).xyz;
  place = vec2(0.5 + 0.5 * unit_position.x, 0.5 - 0.5 * unit_position.y) * finish.yz;
  printed = abs(unit_normal.z) > 0.5 ? 1.0 : 0.0;
  paint = colour;
  shininess = finish.x;
  gl_Position = to_clip * vec4(p, 1.0);
}
)";

constexpr const char* kSceneFragment = R"(#version 330
in vec3 from_eye;
in vec3 normal;
in vec3 in_shadow;
in vec2 place;
flat in vec4 paint;
flat in float shininess;
flat in float printed;
uniform sampler2D print;
uniform sampler2DShadow shadow_map;
uniform int texture_kind;    // 0 none, 1 printed pattern, 2 smooth picture
uniform vec3 towards_key;
uniform vec3 towards_fill;
uniform vec4 lamps;          // key, fill, sky, ground
uniform float tubes;
uniform float shadow_reach;  // in the shadow map, 0: no shadows
uniform vec4 grey_weights;   // of red, green, blue; 0: keep colour; then the scale
out vec4 result;

vec3 printAt(vec2 at) {
  if (texture_kind == 2) return texture(print, at).rgb;
  vec2 size = vec2(textureSize(print, 0));
  vec2 texel = at * size;
  vec2 width = max(fwidth(texel), vec2(1e-6));
  vec2 border = floor(texel + 0.5);
  return textureLod(print, (border + clamp((texel - border) / width, -0.5, 0.5)) / size, 0.0).rgb;
}

float lit() {
  if (shadow_reach <= 0.0) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 offset = shadow_reach * vec2((i & 1) - 0.5, (i >> 1) - 0.5);
    sum += texture(shadow_map, in_shadow + vec3(offset, 0.0));
  }
  return 0.25 * sum;
}

/// Rows of lamps under the roof, as polished metal mirrors them.
float mirrored(vec3 ray) {
  float row = abs(fract(2.5 * ray.y / (abs(ray.z) + 0.3)) - 0.5);
  float lamp = smoothstep(0.30, 0.42, row) * smoothstep(0.05, 0.35, ray.z);
  return 0.15 + 0.20 * ray.z + lamp;
}

void main() {
  vec3 n = normalize(normal);
  vec3 albedo = paint.rgb;
  if (texture_kind != 0 && printed > 0.5) albedo *= printAt(place);
  float facing = dot(n, towards_key);
  float key = facing > 0.0 ? lamps.x * lit() : 0.0;
  float ambient = mix(lamps.w, lamps.z, 0.5 + 0.5 * n.z);
  vec3 c = albedo * (ambient + key * facing + lamps.y * max(dot(n, towards_fill), 0.0));
  if (paint.a > 0.0) {
    vec3 v = normalize(-from_eye);
    float half_angle = max(dot(n, normalize(v + towards_key)), 0.0);
    float exponent = 4.0 + 124.0 * shininess;
    c += paint.a * (key * pow(half_angle, exponent) + tubes * mirrored(reflect(-v, n)));
  }
  float grey = dot(c, grey_weights.rgb);
  result = grey_weights.r > 0.0 ? vec4(grey * grey_weights.a) : vec4(c, 1.0);
}
)";

constexpr const char* kDepthVertex = R"(
uniform mat4 to_clip;
void main() { gl_Position = to_clip * vec4(point(), 1.0); }
)";

constexpr const char* kDepthFragment = R"(#version 330
void main() {}
)";

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

std::string sceneVertexShader() { return std::string(kPlace) + kSceneVertex; }
std::string sceneFragmentShader() { return kSceneFragment; }
std::string depthVertexShader() { return std::string(kPlace) + kDepthVertex; }
std::string depthFragmentShader() { return kDepthFragment; }

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

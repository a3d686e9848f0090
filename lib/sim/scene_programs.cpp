#include "sim/scene_programs.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

namespace ringhook {
namespace {

void setMatrix(unsigned program, const char* name, const Eigen::Matrix4f& matrix) {
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, matrix.data());
}

void setVector(unsigned program, const char* name, const Eigen::Vector3d& v) {
  const Eigen::Vector3f values = v.cast<float>();
  glUniform3fv(glGetUniformLocation(program, name), 1, values.data());
}

void setNumber(unsigned program, const char* name, double value) {
  glUniform1f(glGetUniformLocation(program, name), static_cast<float>(value));
}

}  // namespace

ScenePrograms::ScenePrograms(const SceneLight& light)
    : light_(light), depth_(linkProgram(depthVertexShader(), depthFragmentShader())) {}

ScenePrograms::~ScenePrograms() {
  for (const auto& [key, program] : programs_) {
    glDeleteProgram(program.id);
  }
  glDeleteProgram(depth_);
}

void ScenePrograms::setView(const View& view) {
  view_ = view;
  ++views_;
}

ScenePrograms::Program ScenePrograms::link(const SurfaceKind& kind) const {
  const unsigned id = linkProgram(sceneVertexShader(kind), sceneFragmentShader(kind));
  glUseProgram(id);
  setVector(id, "towards_key", light_.towards_key);
  setVector(id, "towards_fill", light_.towards_fill);
  const Eigen::Vector4f lamps =
      Eigen::Vector4d(light_.key, light_.fill, light_.sky, light_.ground).cast<float>();
  glUniform4fv(glGetUniformLocation(id, "lamps"), 1, lamps.data());
  setNumber(id, "tubes", light_.tubes);
  glUniform1i(glGetUniformLocation(id, "print"), 0);
  glUniform1i(glGetUniformLocation(id, "shadow_map"), 1);
  return {id, 0};
}

void ScenePrograms::tell(Program& program) const {
  setMatrix(program.id, "to_clip", view_.to_clip);
  setMatrix(program.id, "to_shadow", view_.to_shadow);
  setNumber(program.id, "shadow_bias", static_cast<double>(view_.shadow_bias));
  setNumber(program.id, "white", static_cast<double>(view_.white));
  program.seen_view = views_;
}

void ScenePrograms::use(TextureKind texture, bool specular) {
  const bool shadows = light_.shadow_map_px > 0;
  const auto [place, fresh] = programs_.try_emplace({texture, specular, view_.colour});
  if (fresh) {
    place->second = link({texture, specular, shadows, view_.colour});
  }
  glUseProgram(place->second.id);
  if (place->second.seen_view != views_) {
    tell(place->second);
  }
}

void ScenePrograms::useDepth(const Eigen::Matrix4f& to_clip) const {
  glUseProgram(depth_);
  setMatrix(depth_, "to_clip", to_clip);
}

}  // namespace ringhook

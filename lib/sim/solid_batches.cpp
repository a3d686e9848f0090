#include "sim/solid_batches.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <mujoco/mujoco.h>

#include <array>
#include <bit>
#include <cstddef>
#include <string>

#include "sim/unit_meshes.h"

namespace ringhook {
namespace {

constexpr std::array<SolidShape, 6> kShapes{SolidShape::box,          SolidShape::capsule,
                                            SolidShape::wire,         SolidShape::cylinder,
                                            SolidShape::slimCylinder, SolidShape::rod};
/// Floats of each attribute of an instance, from location 3 on: see shaders.cpp.
constexpr std::array<int, 7> kAttributes{3, 3, 3, 3, 4, 4, 3};
constexpr int kInstanceFloats = 23;

/// OpenGL takes offsets into a buffer where it once took addresses.
const void* offset(std::size_t bytes) { return std::bit_cast<const void*>(bytes); }

void append(std::vector<float>& values, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) {
    values.push_back(static_cast<float>(v[i]));
  }
}

void appendInstance(const Solid& solid, const Eigen::Vector3d& origin, std::vector<float>& values) {
  for (int axis = 0; axis < 3; ++axis) {
    append(values, solid.fMs.linear().col(axis));
  }
  append(values, solid.fMs.translation() - origin);
  append(values, solid.half);
  values.push_back(static_cast<float>(solid.half_length));
  values.insert(values.end(), solid.colour.begin(), solid.colour.end());
  values.insert(values.end(), {solid.specular, solid.shininess, solid.repeat[0], solid.repeat[1]});
}

}  // namespace

SolidBatches::SolidBatches(const mjModel_& model) : meshes_(kShapes.size()) {
  glGenBuffers(1, &instances_);
  for (const SolidShape shape : kShapes) {
    makeMesh(shape);
  }
  for (int id = 0; id < model.ntex; ++id) {
    makeTexture(model, id);
  }
}

SolidBatches::~SolidBatches() {
  for (const Mesh& mesh : meshes_) {
    glDeleteBuffers(1, &mesh.vertices);
    glDeleteBuffers(1, &mesh.indices);
    glDeleteVertexArrays(1, &mesh.array);
  }
  glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
  glDeleteBuffers(1, &instances_);
}

void SolidBatches::makeMesh(SolidShape shape) {
  const UnitMesh unit = unitMesh(shape);
  Mesh& mesh = meshes_[static_cast<std::size_t>(shape)];
  mesh.count = static_cast<int>(unit.indices.size());
  glGenVertexArrays(1, &mesh.array);
  glBindVertexArray(mesh.array);
  glGenBuffers(1, &mesh.vertices);
  glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(unit.vertices.size() * sizeof(MeshVertex)),
               unit.vertices.data(), GL_STATIC_DRAW);
  glGenBuffers(1, &mesh.indices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(unit.indices.size() * 4U),
               unit.indices.data(), GL_STATIC_DRAW);
  const std::array<std::size_t, 3> from{offsetof(MeshVertex, position),
                                        offsetof(MeshVertex, normal), offsetof(MeshVertex, end)};
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, i < 2 ? 3 : 1, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                          offset(from[i]));
  }
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  std::size_t at = 0;
  for (GLuint i = 0; i < kAttributes.size(); ++i) {
    glEnableVertexAttribArray(3 + i);
    glVertexAttribPointer(3 + i, kAttributes[i], GL_FLOAT, GL_FALSE,
                          kInstanceFloats * sizeof(float), offset(at * sizeof(float)));
    glVertexAttribDivisor(3 + i, 1);
    at += static_cast<std::size_t>(kAttributes[i]);
  }
}

void SolidBatches::makeTexture(const mjModel_& model, int id) {
  const char* name = mj_id2name(&model, mjOBJ_TEXTURE, id);
  const bool print = name != nullptr && std::string(name).starts_with("print");
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, model.tex_width[id], model.tex_height[id], 0, GL_RGB,
               GL_UNSIGNED_BYTE, model.tex_rgb + model.tex_adr[id]);
  const GLint wrap = print ? GL_CLAMP_TO_EDGE : GL_REPEAT;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  textures_.push_back(texture);
  kinds_.push_back(print ? TextureKind::print : TextureKind::picture);
}

SolidBatches::Kind SolidBatches::kindOf(const Solid& solid) {
  return {solid.isSheet(), solid.shape, solid.texture, solid.specular > 0.0F};
}

void SolidBatches::draw(const std::vector<Solid>& solids, const std::vector<char>& wanted,
                        const Eigen::Vector3d& origin, const Prepare& prepare) {
  for (auto& [kind, values] : batches_) {
    values.clear();
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (wanted[i] != 0) {
      appendInstance(solids[i], origin, batches_[kindOf(solids[i])]);
    }
  }
  for (const auto& [kind, values] : batches_) {
    if (!values.empty()) {
      drawBatch(kind, values, prepare);
    }
  }
}

void SolidBatches::drawBatch(const Kind& kind, const std::vector<float>& values,
                             const Prepare& prepare) {
  const auto slot = static_cast<std::size_t>(std::max(kind.texture, 0));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, kind.texture < 0 ? 0 : textures_[slot]);
  prepare(kind.texture < 0 ? TextureKind::none : kinds_[slot], kind.specular);
  const Mesh& mesh = meshes_[static_cast<std::size_t>(kind.shape)];
  glBindVertexArray(mesh.array);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)),
               values.data(), GL_STREAM_DRAW);
  glDrawElementsInstanced(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr,
                          static_cast<GLsizei>(values.size() / kInstanceFloats));
}

}  // namespace ringhook

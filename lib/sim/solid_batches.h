#pragma once

/// \file
/// The solids of one scene on the graphics side: unit meshes, and the model's textures; solids of
/// one shape and texture are drawn together. To be made, used and ended with its context current.

#include <functional>
#include <vector>

#include "sim/solids.h"

namespace ringhook {

class SolidBatches {
 public:
  explicit SolidBatches(const mjModel_& model);
  ~SolidBatches();
  SolidBatches(const SolidBatches&) = delete;
  SolidBatches& operator=(const SolidBatches&) = delete;

  /// How a texture is put on: see shaders.h.
  enum class TextureKind { none = 0, print = 1, picture = 2 };
  /// Called before each batch, whose texture is bound.
  using Prepare = std::function<void(TextureKind)>;

  /// Draws the wanted solids, in the current program, placed relative to `origin` in f.
  void draw(const std::vector<Solid>& solids, const std::vector<char>& wanted,
            const Eigen::Vector3d& origin, const Prepare& prepare);

 private:
  struct Mesh {
    unsigned vertices = 0;
    unsigned indices = 0;
    unsigned array = 0;
    int count = 0;  ///< of indices
  };
  void makeMesh(SolidShape shape);
  void makeTexture(const mjModel_& model, int id);

  std::vector<Mesh> meshes_;        // by SolidShape
  std::vector<unsigned> textures_;  // of the model
  std::vector<TextureKind> kinds_;  // of those
  unsigned instances_ = 0;          // buffer
  std::vector<float> values_;       // of the instances of one batch
};

}  // namespace ringhook

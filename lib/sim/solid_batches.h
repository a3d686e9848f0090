#pragma once

/// \file
/// The solids of one scene on the graphics side: unit meshes, and the model's textures; solids of
/// one shape, texture and finish are drawn together. To be made, used and ended with its context
/// current.

#include <compare>
#include <functional>
#include <map>
#include <vector>

#include "sim/shaders.h"
#include "sim/solids.h"

namespace ringhook {

class SolidBatches {
 public:
  explicit SolidBatches(const mjModel_& model);
  ~SolidBatches();
  SolidBatches(const SolidBatches&) = delete;
  SolidBatches& operator=(const SolidBatches&) = delete;

  /// Called before each batch, whose texture is bound, to choose its program.
  using Prepare = std::function<void(TextureKind, bool specular)>;

  /// Draws the wanted solids, placed relative to `origin` in f; wall and floor last, since most of
  /// them is hidden.
  void draw(const std::vector<Solid>& solids, const std::vector<char>& wanted,
            const Eigen::Vector3d& origin, const Prepare& prepare);

 private:
  struct Mesh {
    unsigned vertices = 0;
    unsigned indices = 0;
    unsigned array = 0;
    int count = 0;  ///< of indices
  };
  /// What solids of one draw call have in common.
  struct Kind {
    bool sheet = false;
    SolidShape shape = SolidShape::box;
    int texture = -1;
    bool specular = false;
    bool operator==(const Kind&) const = default;
    auto operator<=>(const Kind&) const = default;
  };
  static Kind kindOf(const Solid& solid);
  void drawBatch(const Kind& kind, const std::vector<float>& values, const Prepare& prepare);
  void makeMesh(SolidShape shape);
  void makeTexture(const mjModel_& model, int id);

  std::vector<Mesh> meshes_;                    // by SolidShape
  std::vector<unsigned> textures_;              // of the model
  std::vector<TextureKind> kinds_;              // of those
  unsigned instances_ = 0;                      // buffer
  std::map<Kind, std::vector<float>> batches_;  // values of the instances
};

}  // namespace ringhook

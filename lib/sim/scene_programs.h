#pragma once

/// \file
/// One program for each kind of surface, linked when it is first needed, and what they all have to
/// know of lamps and camera. To be made, used and ended with its context current.

#include <Eigen/Core>
#include <map>
#include <tuple>

#include "sim/scene_light.h"
#include "sim/shaders.h"

namespace ringhook {

class ScenePrograms {
 public:
  explicit ScenePrograms(const SceneLight& light);
  ~ScenePrograms();
  ScenePrograms(const ScenePrograms&) = delete;
  ScenePrograms& operator=(const ScenePrograms&) = delete;

  /// What differs from draw to draw; for points in f given from the camera's place.
  struct View {
    Eigen::Matrix4f to_clip;
    Eigen::Matrix4f to_shadow;  ///< 0 to 1 over the shadow map and its depth
    float shadow_bias = 0.0F;   ///< [m]
    float white = 1.0F;         ///< grey value of brightness 1
    bool colour = false;
  };
  void setView(const View& view);

  /// Makes the program for a surface the current one.
  void use(TextureKind texture, bool specular);
  /// The program that draws depth alone.
  void useDepth(const Eigen::Matrix4f& to_clip) const;

 private:
  using Key = std::tuple<TextureKind, bool, bool>;  // texture, specular, colour
  struct Program {
    unsigned id = 0;
    unsigned seen_view = 0;  ///< number of the view it was told last
  };
  [[nodiscard]] Program link(const SurfaceKind& kind) const;
  void tell(Program& program) const;

  SceneLight light_;
  View view_;
  unsigned views_ = 0;  // number of the present one
  std::map<Key, Program> programs_;
  unsigned depth_;
};

}  // namespace ringhook

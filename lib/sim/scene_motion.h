#pragma once

/// \file
/// Where everything in the cell is shortly before and after the world's present instant: bodies
/// move on with their present velocities, qpos(t + dt) = qpos(t) + qvel(t) dt on the joints'
/// manifold (mj_integratePos). At the ends of an exposure of T that is wrong by a T^2 / 8: 0.06 um
/// for 2 m/s^2 and 0.5 ms. A held board stands still during an exposure. Occluders follow their own
/// law, an exact function of time; the physics knows nothing of them.

#include <memory>
#include <vector>

#include "sim/mujoco_handles.h"
#include "sim/scene_options.h"
#include "sim/solids.h"

namespace ringhook {

class SceneMotion {
 public:
  /// \param cell_seed used where options.seed is 0. The world behind the handles must outlive this.
  SceneMotion(const MujocoHandles& world, const SceneOptions& options, std::uint64_t cell_seed);
  ~SceneMotion();
  SceneMotion(const SceneMotion&) = delete;
  SceneMotion& operator=(const SceneMotion&) = delete;

  /// Solids at time_s + from_now [s], where time_s is the world's present time.
  void solidsAt(double time_s, double from_now_s, std::vector<Solid>& solids);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One passing rod, as drawn by the seed.
struct Occluder {
  double crossing_s = 0.0;  ///< when it crosses y_f = 0 [s]
  double speed = 0.0;       ///< along -y_f [m/s]

  [[nodiscard]] double y(double time_s) const { return speed * (crossing_s - time_s); }
};

std::vector<Occluder> drawOccluders(const SceneOptions& options, std::uint64_t cell_seed);

}  // namespace ringhook

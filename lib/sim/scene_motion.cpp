#include "sim/scene_motion.h"

#include <algorithm>
#include <string>

#include "sim/mujoco_model.h"
#include "sim/scene_dice.h"

namespace ringhook {

struct SceneMotion::Impl {
  const mjModel& model;
  const mjData& present;
  DataPtr moved;
  double occluder_x = 0.0;
  std::vector<Occluder> occluders;
  std::vector<int> mocap;  // of those
};

SceneMotion::SceneMotion(const MujocoHandles& world, const SceneOptions& options,
                         std::uint64_t cell_seed)
    : impl_(new Impl{*world.model,
                     *world.data,
                     makeData(*world.model),
                     options.occluder.x,
                     drawOccluders(options, cell_seed),
                     {}}) {
  for (std::size_t i = 0; i < impl_->occluders.size(); ++i) {
    const int body = findObject(*world.model, mjOBJ_BODY, "occluder" + std::to_string(i));
    impl_->mocap.push_back(world.model->body_mocapid[body]);
  }
}

SceneMotion::~SceneMotion() = default;

void SceneMotion::solidsAt(double time_s, double from_now_s, std::vector<Solid>& solids) {
  const mjModel& model = impl_->model;
  mjData& moved = *impl_->moved;
  mju_copy(moved.qpos, impl_->present.qpos, model.nq);
  mju_copy(moved.mocap_pos, impl_->present.mocap_pos, 3 * model.nmocap);
  mju_copy(moved.mocap_quat, impl_->present.mocap_quat, 4 * model.nmocap);
  mj_integratePos(&model, moved.qpos, impl_->present.qvel, from_now_s);
  for (std::size_t i = 0; i < impl_->occluders.size(); ++i) {
    mjtNum* position = moved.mocap_pos + 3L * impl_->mocap[i];
    position[0] = impl_->occluder_x;
    position[1] = impl_->occluders[i].y(time_s + from_now_s);
    position[2] = 0.0;
  }
  mj_kinematics(&model, &moved);
  takeSolids(model, moved, solids);
}

std::vector<Occluder> drawOccluders(const SceneOptions& options, std::uint64_t cell_seed) {
  SceneDice dice(options, cell_seed, SceneStream::occluders);
  const OccluderOptions& chosen = options.occluder;
  std::vector<Occluder> occluders;
  occluders.reserve(static_cast<std::size_t>(std::max(0, chosen.count)));
  for (int i = 0; i < chosen.count; ++i) {
    occluders.push_back(
        {chosen.first_s + i * chosen.interval_s, chosen.speed * dice.factor(chosen.speed_spread)});
  }
  return occluders;
}

}  // namespace ringhook

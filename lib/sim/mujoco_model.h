#pragma once

/// \file
/// Owning MuJoCo's model and data, with its errors turned into ours: a model that does not compile
/// and an internal error throw Error; a simulation that diverged is noticed by checkHealth instead
/// of being reset in silence. Includes MuJoCo: for .cpp files of sim only.

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace ringhook {

struct MujocoDelete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, MujocoDelete>;
using DataPtr = std::unique_ptr<mjData, MujocoDelete>;

/// Compiles MJCF text. Throws Error with MuJoCo's sentence.
ModelPtr loadModel(const std::string& mjcf);
/// Data at the model's initial state. Throws Error if memory runs out.
DataPtr makeData(const mjModel& model);

/// Index of a named object (mjOBJ_...). Throws Error if the model has none of that name.
int findObject(const mjModel& model, mjtObj type, const std::string& name);

/// Throws Error when the state has become bad or contacts had to be dropped.
void checkHealth(const mjData& data);

}  // namespace ringhook

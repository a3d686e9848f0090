#pragma once

/// \file
/// The simulated cell's MuJoCo model and data, for code inside sim (drawing, truth) only.

struct mjModel_;
struct mjData_;

namespace ringhook {

class CellWorld;

struct MujocoHandles {
  mjModel_* model = nullptr;  ///< owned by the world
  mjData_* data = nullptr;    ///< owned by the world; positions are those of CellWorld::time()
};

/// Valid as long as the world. Drawing may use the data's scratch space but not change its state.
MujocoHandles mujocoHandles(const CellWorld& world);

}  // namespace ringhook

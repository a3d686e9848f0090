#pragma once

/// \file
/// The shapes of Solid as triangles of unit size. A vertex is placed at
/// position * half + (0, 0, end * half_length), so one mesh serves every size: a capsule's two
/// half balls are pulled apart along z by `end`. Triangles run counter-clockwise seen from outside.

#include <cstdint>
#include <vector>

#include "sim/solids.h"

namespace ringhook {

struct MeshVertex {
  float position[3];  ///< of a shape with half extents 1
  float normal[3];    ///< outwards, length 1
  float end;          ///< -1, 0 or +1
};

struct UnitMesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};

UnitMesh unitMesh(SolidShape shape);

}  // namespace ringhook

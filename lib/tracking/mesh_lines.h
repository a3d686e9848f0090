#pragma once

/// \file
/// Feature edges joined to lines. A chain is a run of feature edges between the same patches
/// without a junction; collinear ones become one line, and an arc becomes as few chords as stay
/// within a tolerance of it (Douglas, Peucker, "Algorithms for the reduction of the number of
/// points required to represent a digitized line or its caricature", Cartographica 1973). Both
/// sides of a line end at the same points, so neighbouring faces keep sharing their lines.

#include <Eigen/Core>
#include <vector>

#include "tracking/mesh_patches.h"

namespace ringhook {

/// A line as one of its patches has it.
struct LineSide {
  int patch = 0;
  bool forward = true;     ///< the patch lies to the left of start -> end, seen from outside
  Eigen::Vector3d normal;  ///< of the patch along the line, outward, of length 1
};

struct MeshLine {
  int start = 0;  ///< point number
  int end = 0;    ///< point number
  std::vector<LineSide> sides;
};

/// \param tolerance of chords from the edges that they stand for, in the mesh's unit; 0 joins
/// collinear edges only.
std::vector<MeshLine> joinEdges(const Mesh& mesh, const MeshPatches& patches, double tolerance);

}  // namespace ringhook

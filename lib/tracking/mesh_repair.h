#pragma once

/// \file
/// What meshes out of CAD programs need before their edges mean anything: points that are one are
/// made one, faces without area go, an edge that ends on another face's side divides it, and every
/// closed part is wound so that its faces look outward (its volume is positive). Open parts keep
/// the winding that most of their faces have: nobody can tell their outside.

#include <array>
#include <map>
#include <vector>

#include "tracking/mesh.h"

namespace ringhook {

/// One face at one of its sides: from corner number `corner` to the next one.
struct FaceSide {
  int face = 0;
  int corner = 0;
};

/// Faces at each edge; the key holds its two point numbers, the smaller first.
using EdgeMap = std::map<std::array<int, 2>, std::vector<FaceSide>>;
EdgeMap edgesOf(const Mesh& mesh);

/// Point where a side begins and where it ends.
int sideStart(const Mesh& mesh, const FaceSide& side);
int sideEnd(const Mesh& mesh, const FaceSide& side);

struct RepairReport {
  int welded_points = 0;  ///< points that another one stood for
  int dropped_faces = 0;  ///< without area, or written twice
  int divided_sides = 0;  ///< sides that a point of another face stood on
  int turned_faces = 0;   ///< wound the other way round than in the file
  int open_edges = 0;     ///< edges of one face only
  int crowded_edges = 0;  ///< edges of three faces or more
};

/// Repairs in place. `tolerance` in the mesh's unit: points nearer than that are one. Throws
/// InputError that begins with `where`, if no face is left or a part has no two sides (a Moebius
/// strip).
RepairReport repairMesh(Mesh& mesh, double tolerance, const std::string& where);

}  // namespace ringhook

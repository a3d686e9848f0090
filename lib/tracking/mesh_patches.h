#pragma once

/// \file
/// Parts of a surface, in two sizes. A facet is a connected flat region: coplanar faces merged. A
/// patch is a connected smooth region: facets joined across edges whose dihedral angle is below the
/// feature angle, such as all facets of a cylinder's side. The other edges are feature edges: those
/// that one sees as edges; open and crowded edges always belong to them.

#include <Eigen/Core>
#include <vector>

#include "tracking/mesh_repair.h"

namespace ringhook {

struct MeshPatches {
  std::vector<int> facet_of_face;
  std::vector<int> patch_of_facet;
  std::vector<Eigen::Vector3d> normal_of_facet;  ///< outward, of length 1
  std::vector<int> facets_in_patch;              ///< how many; a flat patch has one
  EdgeMap feature_edges;
};

/// \param feature_angle between the normals of two facets, at least this makes an edge [rad]
/// \param flatness how far a facet's points may lie off its plane, in the mesh's unit
MeshPatches findPatches(const Mesh& mesh, double feature_angle, double flatness);

}  // namespace ringhook

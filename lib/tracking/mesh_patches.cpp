#include "tracking/mesh_patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/angle.h"

namespace ringhook {
namespace {

constexpr double kCoplanarAngle = kDegree;  // beyond it faces are not one facet

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The plane that a facet grows in.
struct Plane {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

bool liesIn(const Plane& plane, const Mesh& mesh, const MeshFace& face,
            const Eigen::Vector3d& normal, double flatness) {
  if (normal.dot(plane.normal) < std::cos(kCoplanarAngle)) {
    return false;
  }
  return std::all_of(face.corners.begin(), face.corners.end(), [&](int corner) {
    return std::abs((mesh.points[at(corner)] - plane.point).dot(plane.normal)) <= flatness;
  });
}

/// The face that shares a side with no third one; -1 if there is none.
int acrossManifoldEdge(const Mesh& mesh, const EdgeMap& edges, const FaceSide& side) {
  const int a = sideStart(mesh, side);
  const int b = sideEnd(mesh, side);
  const std::vector<FaceSide>& sides = edges.at({std::min(a, b), std::max(a, b)});
  if (sides.size() != 2) {
    return -1;
  }
  return sides[0].face == side.face ? sides[1].face : sides[0].face;
}

/// Grows a facet from its largest face.
void growFacet(const Mesh& mesh, const EdgeMap& edges, const std::vector<Eigen::Vector3d>& normals,
               int seed, double flatness, std::vector<int>& facet_of_face, int facet) {
  const MeshFace& first = mesh.faces[at(seed)];
  const Plane plane{mesh.points[at(first.corners[0])], normals[at(seed)]};
  std::vector<int> queue{seed};
  facet_of_face[at(seed)] = facet;
  for (std::size_t done = 0; done < queue.size(); ++done) {
    const int face = queue[done];
    for (int c = 0; c < static_cast<int>(mesh.faces[at(face)].corners.size()); ++c) {
      const int next = acrossManifoldEdge(mesh, edges, {face, c});
      if (next >= 0 && facet_of_face[at(next)] < 0 &&
          liesIn(plane, mesh, mesh.faces[at(next)], normals[at(next)], flatness)) {
        facet_of_face[at(next)] = facet;
        queue.push_back(next);
      }
    }
  }
}

int findRoot(std::vector<int>& parent, int i) {
  while (parent[at(i)] != i) {
    parent[at(i)] = parent[at(parent[at(i)])];
    i = parent[at(i)];
  }
  return i;
}

void findFacets(const Mesh& mesh, const EdgeMap& edges, double flatness, MeshPatches& patches) {
  std::vector<Eigen::Vector3d> areas;
  std::vector<Eigen::Vector3d> normals;
  for (const MeshFace& face : mesh.faces) {
    areas.push_back(areaVector(mesh, face));
    normals.push_back(areas.back().normalized());
  }
  std::vector<int> by_area(mesh.faces.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](int a, int b) { return areas[at(a)].norm() > areas[at(b)].norm(); });
  patches.facet_of_face.assign(mesh.faces.size(), -1);
  int facets = 0;
  for (const int seed : by_area) {
    if (patches.facet_of_face[at(seed)] < 0) {
      growFacet(mesh, edges, normals, seed, flatness, patches.facet_of_face, facets++);
    }
  }
  patches.normal_of_facet.assign(at(facets), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    patches.normal_of_facet[at(patches.facet_of_face[i])] += areas[i];
  }
  for (Eigen::Vector3d& normal : patches.normal_of_facet) {
    normal.normalize();
  }
}

}  // namespace

MeshPatches findPatches(const Mesh& mesh, double feature_angle, double flatness) {
  MeshPatches patches;
  const EdgeMap edges = edgesOf(mesh);
  findFacets(mesh, edges, flatness, patches);
  const auto facets = patches.normal_of_facet.size();
  std::vector<int> parent(facets);
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [edge, sides] : edges) {
    const bool manifold = sides.size() == 2;
    const int a = patches.facet_of_face[at(sides.front().face)];
    const int b = patches.facet_of_face[at(sides.back().face)];
    const double cosine = patches.normal_of_facet[at(a)].dot(patches.normal_of_facet[at(b)]);
    // Rounding must not decide about an angle that equals the feature angle.
    if (!manifold || (a != b && cosine <= std::cos(feature_angle) + 1e-9)) {
      patches.feature_edges[edge] = sides;
    } else {
      parent[at(findRoot(parent, a))] = findRoot(parent, b);
    }
  }
  std::map<int, int> number_of_root;
  for (int facet = 0; facet < static_cast<int>(facets); ++facet) {
    const int root = findRoot(parent, facet);
    const auto it = number_of_root.emplace(root, static_cast<int>(number_of_root.size())).first;
    patches.patch_of_facet.push_back(it->second);
  }
  patches.facets_in_patch.assign(number_of_root.size(), 0);
  for (const int patch : patches.patch_of_facet) {
    ++patches.facets_in_patch[at(patch)];
  }
  return patches;
}

}  // namespace ringhook

#include "tracking/mesh_lines.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace ringhook {
namespace {

using Edge = std::array<int, 2>;
using Chain = std::vector<int>;  // points in order; the first again at the end if it is closed

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Edge edgeOf(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Feature edges as a graph.
class EdgeGraph {
 public:
  EdgeGraph(const Mesh& mesh, const MeshPatches& patches) : mesh_(mesh), patches_(patches) {
    for (const auto& [edge, sides] : patches.feature_edges) {
      neighbours_[edge[0]].push_back(edge[1]);
      neighbours_[edge[1]].push_back(edge[0]);
    }
  }

  /// All chains: first those between junctions, then closed ones without any.
  std::vector<Chain> chains() {
    std::vector<Chain> all;
    for (const auto& [point, next] : neighbours_) {
      for (const int second : passable(point) ? std::vector<int>() : next) {
        addChain(point, second, all);
      }
    }
    for (const auto& [point, next] : neighbours_) {
      addChain(point, next.front(), all);
    }
    return all;
  }

 private:
  /// The patches at an edge, in order.
  [[nodiscard]] std::vector<int> patchesAt(const Edge& edge) const {
    std::vector<int> list;
    for (const FaceSide& side : patches_.feature_edges.at(edge)) {
      list.push_back(patches_.patch_of_facet[at(patches_.facet_of_face[at(side.face)])]);
    }
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Two edges of the same patches meet here, and nothing else.
  [[nodiscard]] bool passable(int point) const {
    const std::vector<int>& next = neighbours_.at(point);
    return next.size() == 2 &&
           patchesAt(edgeOf(point, next[0])) == patchesAt(edgeOf(point, next[1]));
  }

  void addChain(int first, int second, std::vector<Chain>& all) {
    if (used_.contains(edgeOf(first, second))) {
      return;
    }
    Chain chain{first, second};
    used_.insert(edgeOf(first, second));
    while (chain.back() != first && passable(chain.back())) {
      const std::vector<int>& next = neighbours_.at(chain.back());
      const int onward = next[0] == chain[chain.size() - 2] ? next[1] : next[0];
      used_.insert(edgeOf(chain.back(), onward));
      chain.push_back(onward);
    }
    all.push_back(std::move(chain));
  }

  const Mesh& mesh_;
  const MeshPatches& patches_;
  std::map<int, std::vector<int>> neighbours_;
  std::set<Edge> used_;
};

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - s * along).norm();
}

/// Places in the chain that stay, the first and the last among them.
std::set<std::size_t> keptPlaces(const Mesh& mesh, const Chain& chain, double tolerance) {
  std::set<std::size_t> kept{0, chain.size() - 1};
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, chain.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    std::size_t farthest = first;
    double distance = -1.0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distanceToSegment(mesh.points[at(chain[i])], mesh.points[at(chain[first])],
                                         mesh.points[at(chain[last])]);
      farthest = d > distance ? i : farthest;
      distance = std::max(distance, d);
    }
    if (distance > tolerance) {
      kept.insert(farthest);
      spans.emplace_back(first, farthest);
      spans.emplace_back(farthest, last);
    }
  }
  return kept;
}

/// The line that stands for chain[first..last].
MeshLine lineOf(const Mesh& mesh, const MeshPatches& patches, const Chain& chain, std::size_t first,
                std::size_t last) {
  std::map<std::pair<int, bool>, Eigen::Vector3d> normals;
  for (std::size_t i = first; i < last; ++i) {
    const double length = (mesh.points[at(chain[i + 1])] - mesh.points[at(chain[i])]).norm();
    for (const FaceSide& side : patches.feature_edges.at(edgeOf(chain[i], chain[i + 1]))) {
      const int facet = patches.facet_of_face[at(side.face)];
      const bool forward = sideStart(mesh, side) == chain[i];
      const std::pair key{patches.patch_of_facet[at(facet)], forward};
      const auto it = normals.emplace(key, Eigen::Vector3d::Zero()).first;
      it->second += length * patches.normal_of_facet[at(facet)];
    }
  }
  MeshLine line{chain[first], chain[last], {}};
  for (const auto& [key, normal] : normals) {
    line.sides.push_back({key.first, key.second, normal.normalized()});
  }
  return line;
}

}  // namespace

std::vector<MeshLine> joinEdges(const Mesh& mesh, const MeshPatches& patches, double tolerance) {
  const double least = 1e-6 * extents(mesh).norm();
  std::vector<MeshLine> lines;
  for (const Chain& chain : EdgeGraph(mesh, patches).chains()) {
    const std::set<std::size_t> kept = keptPlaces(mesh, chain, std::max(tolerance, least));
    for (auto it = std::next(kept.begin()); it != kept.end(); ++it) {
      if (chain[*std::prev(it)] != chain[*it]) {  // a ring smaller than the tolerance is no line
        lines.push_back(lineOf(mesh, patches, chain, *std::prev(it), *it));
      }
    }
  }
  return lines;
}

}  // namespace ringhook

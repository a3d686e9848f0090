#include "tracking/mesh_model.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "tracking/mesh_lines.h"
#include "tracking/mesh_patches.h"

namespace ringhook {
namespace {

constexpr double kSmallest = 0.001;         // [m]
constexpr double kLargest = 20.0;           // [m]
constexpr double kFlatness = 1e-5;          // of the mesh's size
constexpr double kThread = 1e-6;            // width of a thread face [m]
constexpr std::size_t kMostFaces = 100000;  // that ViSP reads

// ViSP scales a normal to length 1 only if its square exceeds 2.2e-16, so that twice the area of a
// face must exceed 1.5e-8 m^2; twice that is asked for.
constexpr double kLeastTwiceArea = 3e-8;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string inWords(double number) {
  std::ostringstream text;
  text << std::setprecision(3) << number;
  return text.str();
}

class ModelBuilder {
 public:
  ModelBuilder(const Mesh& mesh, const MeshPatches& patches, const std::vector<MeshLine>& lines)
      : mesh_(mesh), patches_(patches), edges_(edgesOf(mesh)) {
    model_.lines = static_cast<int>(lines.size());
    for (const MeshLine& line : lines) {
      kept_.insert({line.start, line.end});
    }
    addFlatPatches();
    for (const MeshLine& line : lines) {
      addThreads(line);
    }
  }

  MeshModel take() { return std::move(model_); }

 private:
  [[nodiscard]] int facetAt(const FaceSide& side) const {
    return patches_.facet_of_face[at(side.face)];
  }
  [[nodiscard]] bool isFlat(int patch) const { return patches_.facets_in_patch[at(patch)] == 1; }

  [[nodiscard]] const std::vector<FaceSide>& sidesAt(const FaceSide& side) const {
    const int a = sideStart(mesh_, side);
    const int b = sideEnd(mesh_, side);
    return edges_.at({std::min(a, b), std::max(a, b)});
  }

  /// A side that the facet shares with itself.
  [[nodiscard]] bool isInner(const FaceSide& side) const {
    const std::vector<FaceSide>& sides = sidesAt(side);
    return sides.size() == 2 && facetAt(sides[0]) == facetAt(sides[1]);
  }

  [[nodiscard]] FaceSide following(const FaceSide& side) const {
    const auto corners = static_cast<int>(mesh_.faces[at(side.face)].corners.size());
    return {side.face, (side.corner + 1) % corners};
  }

  /// The next side of the facet's border, round the point where this one ends.
  [[nodiscard]] FaceSide followingBorder(FaceSide side) const {
    side = following(side);
    while (isInner(side)) {
      const std::vector<FaceSide>& sides = sidesAt(side);
      const bool first = sides[0].face == side.face && sides[0].corner == side.corner;
      side = following(first ? sides[1] : sides[0]);
    }
    return side;
  }

  void addFlatPatches() {
    std::set<std::pair<int, int>> done;
    std::map<int, std::vector<std::vector<int>>> loops;  // by facet
    for (int face = 0; face < static_cast<int>(mesh_.faces.size()); ++face) {
      const auto corners = static_cast<int>(mesh_.faces[at(face)].corners.size());
      for (int c = 0; c < corners; ++c) {
        const int facet = facetAt({face, c});
        if (isFlat(patches_.patch_of_facet[at(facet)]) && !isInner({face, c}) &&
            !done.contains({face, c})) {
          loops[facet].push_back(loopFrom({face, c}, done));
        }
      }
    }
    for (const auto& [facet, borders] : loops) {
      for (const std::vector<int>& border : borders) {
        addLoop(border, patches_.normal_of_facet[at(facet)]);
      }
    }
  }

  std::vector<int> loopFrom(const FaceSide& first, std::set<std::pair<int, int>>& done) const {
    std::vector<int> loop;
    for (FaceSide side = first; done.insert({side.face, side.corner}).second;
         side = followingBorder(side)) {
      if (kept_.contains(sideStart(mesh_, side))) {
        loop.push_back(sideStart(mesh_, side));
      }
    }
    return loop;
  }

  /// A border of a flat patch; one that runs against the normal surrounds a hole.
  void addLoop(std::vector<int> loop, const Eigen::Vector3d& normal) {
    const double twice_area = loop.size() < 3 ? 0.0 : areaVector(mesh_, {loop, 0}).dot(normal);
    if (std::abs(twice_area) < kLeastTwiceArea) {
      ++model_.left_out;
      return;
    }
    if (twice_area < 0.0) {
      std::reverse(loop.begin(), loop.end());
    }
    ++(twice_area < 0.0 ? model_.hole_faces : model_.flat_faces);
    std::vector<int> face;
    face.reserve(loop.size());
    for (const int point : loop) {
      face.push_back(numberOf(point));
    }
    model_.faces.push_back(std::move(face));
  }

  void addThreads(const MeshLine& line) {
    for (const LineSide& side : line.sides) {
      if (!isFlat(side.patch)) {
        addThread(side.forward ? line.start : line.end, side.forward ? line.end : line.start,
                  side.normal);
      }
    }
  }

  /// A thread along start -> end, the patch to its left.
  void addThread(int start, int end, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d along = mesh_.points[at(end)] - mesh_.points[at(start)];
    const double length = along.norm();
    const double width = std::max(kThread, kLeastTwiceArea / length);
    const Eigen::Vector3d inward = normal.cross(along);
    if (width > 0.2 * length || inward.norm() < 0.1 * length) {
      ++model_.left_out;
      return;
    }
    const int apex = static_cast<int>(model_.points.size());
    model_.points.emplace_back(mesh_.points[at(start)] + 0.5 * along + width * inward.normalized());
    // Numbered before the corners are, since that may add points, too.
    const int first = numberOf(start);
    const int second = numberOf(end);
    model_.faces.push_back({first, second, apex});
    ++model_.thread_faces;
  }

  int numberOf(int point) {
    const auto [it, fresh] = numbers_.emplace(point, static_cast<int>(model_.points.size()));
    if (fresh) {
      model_.points.push_back(mesh_.points[at(point)]);
    }
    return it->second;
  }

  const Mesh& mesh_;
  const MeshPatches& patches_;
  EdgeMap edges_;
  std::set<int> kept_;
  std::map<int, int> numbers_;
  MeshModel model_;
};

void checkSize(const Mesh& mesh, const MeshModelOptions& options, const std::string& where) {
  const double size = extents(mesh).maxCoeff();
  const std::string advice = "; --scale tells how many metres one unit of the file is, and " +
                             inWords(options.scale) + " was taken";
  if (size > kLargest) {
    throw InputError(where + ": the model is " + inWords(size) +
                     " m large, expected at most 20 m: a file in millimetres needs --scale 0.001" +
                     advice);
  }
  if (size < kSmallest) {
    throw InputError(where + ": the model is " + inWords(1e3 * size) +
                     " mm large, expected at least 1 mm: is --scale too small" + advice);
  }
}

}  // namespace

MeshModel modelFromMesh(Mesh mesh, const MeshModelOptions& options, const std::string& where) {
  for (Eigen::Vector3d& point : mesh.points) {
    point *= options.scale;
  }
  checkSize(mesh, options, where);
  const RepairReport repair = repairMesh(mesh, options.weld_m, where);
  const double flatness = std::max(options.weld_m, kFlatness * extents(mesh).norm());
  const MeshPatches patches = findPatches(mesh, options.feature_angle, flatness);
  if (patches.feature_edges.empty()) {
    throw InputError(where +
                     ": no edge is sharper than the feature angle; expected a solid with "
                     "edges, or a smaller --feature-angle-deg");
  }
  const std::vector<MeshLine> lines = joinEdges(mesh, patches, options.chord_tolerance_m);
  MeshModel model = ModelBuilder(mesh, patches, lines).take();
  if (model.faces.empty() || model.faces.size() > kMostFaces || model.points.size() > kMostFaces) {
    throw InputError(
        where + ": " + std::to_string(model.faces.size()) + " faces and " +
        std::to_string(model.points.size()) +
        " points would be left; ViSP reads 1 to 100000 of each: expected another mesh, "
        "or another --chord-tolerance-mm");
  }
  model.extents_m = extents(mesh);
  model.repair = repair;
  return model;
}

std::string caoText(const MeshModel& model, const std::string& origin) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(9);
  text << "V1\n# Edges of " << origin << " [m], made by ringhook model convert\n# 3D points\n"
       << model.points.size() << '\n';
  for (const Eigen::Vector3d& p : model.points) {
    // Without the sign that a rounding error would print before a zero.
    const Eigen::Vector3d q = p.unaryExpr([](double v) { return std::abs(v) < 5e-10 ? 0.0 : v; });
    text << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
  }
  text << "# 3D lines\n0\n# Faces from 3D lines\n0\n# Faces from 3D points\n"
       << model.faces.size() << '\n';
  for (const std::vector<int>& face : model.faces) {
    text << face.size();
    for (const int point : face) {
      text << ' ' << point;
    }
    text << '\n';
  }
  text << "# 3D cylinders\n0\n# 3D circles\n0\n";
  return text.str();
}

}  // namespace ringhook

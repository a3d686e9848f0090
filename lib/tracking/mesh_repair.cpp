#include "tracking/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <ranges>
#include <set>

#include "core/error.h"

namespace ringhook {
namespace {

using Cell = std::array<std::int64_t, 3>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Points too far off for a number to tell their cell share the outermost one.
Cell cellOf(const Eigen::Vector3d& p, double size) {
  constexpr double kOutermost = 1e18;
  const Eigen::Vector3d cell = (p / size).cwiseMax(-kOutermost).cwiseMin(kOutermost);
  return {std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())};
}

/// The point that stands for each point: the first one within the tolerance.
std::vector<int> representatives(const std::vector<Eigen::Vector3d>& points, double tolerance) {
  std::map<Cell, std::vector<int>> grid;
  std::vector<int> stands_for(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cell home = cellOf(points[i], tolerance);
    int found = -1;
    for (int k = 0; k < 27 && found < 0; ++k) {
      const auto cell =
          grid.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
      if (cell == grid.end()) {
        continue;
      }
      for (const int other : cell->second) {
        const bool near = (points[at(other)] - points[i]).norm() <= tolerance;
        found = near && found < 0 ? other : found;
      }
    }
    stands_for[i] = found < 0 ? static_cast<int>(i) : found;
    if (found < 0) {
      grid[home].push_back(static_cast<int>(i));
    }
  }
  return stands_for;
}

/// Corners without repetitions and without spikes (a, b, a).
void cleanCorners(std::vector<int>& corners) {
  for (std::size_t i = 0; i < corners.size() && corners.size() >= 3;) {
    const std::size_t n = corners.size();
    const std::size_t next = (i + 1) % n;
    if (corners[i] == corners[next] || corners[i] == corners[(i + 2) % n]) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(next));
      i = 0;
    } else {
      ++i;
    }
  }
}

void weld(Mesh& mesh, double tolerance, RepairReport& report) {
  const std::vector<int> stands_for = representatives(mesh.points, tolerance);
  for (std::size_t i = 0; i < stands_for.size(); ++i) {
    report.welded_points += stands_for[i] == static_cast<int>(i) ? 0 : 1;
  }
  for (MeshFace& face : mesh.faces) {
    for (int& corner : face.corners) {
      corner = stands_for[at(corner)];
    }
    cleanCorners(face.corners);
  }
}

/// The corners from the least on, for comparison.
std::vector<int> turnedToLeast(std::vector<int> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// A face with an area: wider than the tolerance.
bool hasArea(const Mesh& mesh, const MeshFace& face, double tolerance) {
  double longest = 0.0;
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const int next = face.corners[(i + 1) % face.corners.size()];
    longest = std::max(longest, (mesh.points[at(next)] - mesh.points[at(face.corners[i])]).norm());
  }
  return face.corners.size() >= 3 && areaVector(mesh, face).norm() > tolerance * longest;
}

void dropFaces(Mesh& mesh, double tolerance, RepairReport& report) {
  const std::size_t before = mesh.faces.size();
  std::set<std::vector<int>> seen;
  std::erase_if(mesh.faces, [&](const MeshFace& face) {
    return !hasArea(mesh, face, tolerance) || !seen.insert(turnedToLeast(face.corners)).second;
  });
  report.dropped_faces += static_cast<int>(before - mesh.faces.size());
}

/// Points strictly within the segment a-b, in order from a; `by_x` is sorted by x.
std::vector<int> pointsWithin(const Mesh& mesh, const std::vector<int>& by_x, int a, int b,
                              double tolerance) {
  const Eigen::Vector3d& start = mesh.points[at(a)];
  const Eigen::Vector3d along = mesh.points[at(b)] - start;
  const double length = along.norm();
  const double low = std::min(start.x(), start.x() + along.x()) - tolerance;
  const double high = std::max(start.x(), start.x() + along.x()) + tolerance;
  auto it = std::lower_bound(by_x.begin(), by_x.end(), low,
                             [&](int i, double x) { return mesh.points[at(i)].x() < x; });
  std::vector<std::pair<double, int>> found;
  for (; it != by_x.end() && mesh.points[at(*it)].x() <= high; ++it) {
    const Eigen::Vector3d from_start = mesh.points[at(*it)] - start;
    const double s = from_start.dot(along) / length;
    const double off = (from_start - along * (s / length)).norm();
    if (s > tolerance && s < length - tolerance && off <= tolerance) {
      found.emplace_back(s, *it);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<int> points;
  points.reserve(found.size());
  for (const auto& [s, point] : found) {
    points.push_back(point);
  }
  return points;
}

/// Where an edge has one face only, a point of another such edge may stand on it.
void divideSides(Mesh& mesh, double tolerance, RepairReport& report) {
  std::map<std::array<int, 2>, FaceSide> open;
  std::set<int> ends;
  for (const auto& [edge, sides] : edgesOf(mesh)) {
    if (sides.size() == 1) {
      open[edge] = sides.front();
      ends.insert(edge.begin(), edge.end());
    }
  }
  std::vector<int> by_x(ends.begin(), ends.end());
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) {
    const double xa = mesh.points[at(a)].x();
    const double xb = mesh.points[at(b)].x();
    return xa < xb || (xa == xb && a < b);
  });
  std::map<int, std::map<int, std::vector<int>>> inserts;  // by face, then corner
  for (const auto& [edge, side] : open) {
    std::vector<int> within =
        pointsWithin(mesh, by_x, sideStart(mesh, side), sideEnd(mesh, side), tolerance);
    if (!within.empty()) {
      inserts[side.face][side.corner] = std::move(within);
    }
  }
  for (const auto& [face, by_corner] : inserts) {
    std::vector<int>& corners = mesh.faces[at(face)].corners;
    for (const auto& [corner, points] : std::views::reverse(by_corner)) {
      corners.insert(corners.begin() + corner + 1, points.begin(), points.end());
      ++report.divided_sides;
    }
    cleanCorners(corners);
  }
}

/// The face across a side and whether it is wound alike there; nothing across an edge that is not
/// shared by exactly two faces.
struct Neighbour {
  int face = -1;
  bool alike = true;
};

Neighbour across(const Mesh& mesh, const EdgeMap& edges, const FaceSide& side) {
  const int a = sideStart(mesh, side);
  const int b = sideEnd(mesh, side);
  const std::vector<FaceSide>& sides = edges.at({std::min(a, b), std::max(a, b)});
  if (sides.size() != 2 || sides[0].face == sides[1].face) {
    return {};
  }
  const FaceSide& other = sides[0].face == side.face ? sides[1] : sides[0];
  return {other.face, sideStart(mesh, other) == b};
}

/// One connected part: its faces, which of them are to be turned, and whether it is closed.
struct Part {
  std::vector<int> faces;
  bool closed = true;
};

/// Walks over a part from `first`; turn[face] becomes 0 or 1.
Part walkPart(const Mesh& mesh, const EdgeMap& edges, int first, std::vector<int>& turn,
              const std::string& where) {
  Part part;
  part.faces.push_back(first);
  turn[at(first)] = 0;
  for (std::size_t done = 0; done < part.faces.size(); ++done) {
    const int face = part.faces[done];
    for (int c = 0; c < static_cast<int>(mesh.faces[at(face)].corners.size()); ++c) {
      const Neighbour next = across(mesh, edges, {face, c});
      if (next.face < 0) {
        part.closed = false;
        continue;
      }
      const int wanted = next.alike ? turn[at(face)] : 1 - turn[at(face)];
      if (turn[at(next.face)] < 0) {
        turn[at(next.face)] = wanted;
        part.faces.push_back(next.face);
      } else if (turn[at(next.face)] != wanted) {
        throw InputError(where + ":" + std::to_string(mesh.faces[at(next.face)].line) +
                         ": this face belongs to a surface with one side only; expected one with "
                         "an inside and an outside");
      }
    }
  }
  return part;
}

/// Six times the volume that the part encloses, as it is to be turned.
double volumeOf(const Mesh& mesh, const Part& part, const std::vector<int>& turn) {
  double volume = 0.0;
  const Eigen::Vector3d& near = mesh.points[at(mesh.faces[at(part.faces[0])].corners[0])];
  for (const int face : part.faces) {
    const MeshFace& f = mesh.faces[at(face)];
    const double sign = turn[at(face)] == 1 ? -1.0 : 1.0;
    volume += sign * areaVector(mesh, f).dot(mesh.points[at(f.corners[0])] - near);
  }
  return volume;
}

void orient(Mesh& mesh, const std::string& where, RepairReport& report) {
  const EdgeMap edges = edgesOf(mesh);
  std::vector<int> turn(mesh.faces.size(), -1);
  for (int first = 0; first < static_cast<int>(mesh.faces.size()); ++first) {
    if (turn[at(first)] >= 0) {
      continue;
    }
    const Part part = walkPart(mesh, edges, first, turn, where);
    const auto turned = std::count_if(part.faces.begin(), part.faces.end(),
                                      [&](int face) { return turn[at(face)] == 1; });
    const bool minority = 2 * turned <= static_cast<std::ptrdiff_t>(part.faces.size());
    const bool keep = part.closed ? volumeOf(mesh, part, turn) >= 0.0 : minority;
    for (const int face : part.faces) {
      if ((turn[at(face)] == 1) == keep) {
        std::vector<int>& corners = mesh.faces[at(face)].corners;
        std::reverse(corners.begin(), corners.end());
        ++report.turned_faces;
      }
    }
  }
  for (const auto& [edge, sides] : edges) {
    report.open_edges += sides.size() == 1 ? 1 : 0;
    report.crowded_edges += sides.size() > 2 ? 1 : 0;
  }
}

}  // namespace

int sideStart(const Mesh& mesh, const FaceSide& side) {
  return mesh.faces[at(side.face)].corners[at(side.corner)];
}

int sideEnd(const Mesh& mesh, const FaceSide& side) {
  const std::vector<int>& corners = mesh.faces[at(side.face)].corners;
  return corners[(at(side.corner) + 1) % corners.size()];
}

EdgeMap edgesOf(const Mesh& mesh) {
  EdgeMap edges;
  for (int face = 0; face < static_cast<int>(mesh.faces.size()); ++face) {
    for (int c = 0; c < static_cast<int>(mesh.faces[at(face)].corners.size()); ++c) {
      const FaceSide side{face, c};
      const int a = sideStart(mesh, side);
      const int b = sideEnd(mesh, side);
      edges[{std::min(a, b), std::max(a, b)}].push_back(side);
    }
  }
  return edges;
}

RepairReport repairMesh(Mesh& mesh, double tolerance, const std::string& where) {
  RepairReport report;
  weld(mesh, tolerance, report);
  dropFaces(mesh, tolerance, report);  // first, since what they leave open is then divided
  divideSides(mesh, tolerance, report);
  dropFaces(mesh, tolerance, report);
  if (mesh.faces.empty()) {
    throw InputError(where + ": no face has an area; expected a solid of polygons");
  }
  orient(mesh, where, report);
  return report;
}

}  // namespace ringhook

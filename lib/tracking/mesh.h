#pragma once

/// \file
/// A solid's surface as polygons, as a CAD program exports it: Wavefront OBJ, text (Wavefront
/// Technologies, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual). Read are
/// vertices `v` and faces `f` in all their spellings (v, v/vt, v//vn, v/vt/vn, numbers from the
/// end, lines continued by a backslash, CRLF); groups, materials, normals, texture and single lines
/// are read over. Free-form surfaces are refused: a tracker needs polygons.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ringhook {

/// A polygon, its corners counter-clockwise as seen from outside.
struct MeshFace {
  std::vector<int> corners;  ///< point numbers, at least three
  int line = 0;              ///< in the file, counted from 1
};

struct Mesh {
  std::vector<Eigen::Vector3d> points;  ///< in the model frame o, unit of the file
  std::vector<MeshFace> faces;
};

/// Throws InputError naming file and line for what is malformed, and for a file without a face.
Mesh loadObj(const std::filesystem::path& path);

/// The same from text; `path` is named in errors.
Mesh parseObj(const std::string& text, const std::filesystem::path& path);

/// Twice the face's area along its normal (Newell's formula; Sutherland, Sproull, Schumacker,
/// "A characterization of ten hidden-surface algorithms", 1974); holds for concave and slightly
/// bent polygons.
Eigen::Vector3d areaVector(const Mesh& mesh, const MeshFace& face);

/// Sides of the box around the faces. Precondition: there is a face.
Eigen::Vector3d extents(const Mesh& mesh);

}  // namespace ringhook

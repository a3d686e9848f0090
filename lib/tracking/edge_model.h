#pragma once

/// \file
/// A wireframe from a ViSP model file (.cao, version 1): points, lines, polygonal faces, and models
/// included with load("..."). Cylinders and circles are checked and left out. The format is drawn
/// in doc/formats.md; attributes such as name=... are read over.

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace ringhook {

struct EdgeModel {
  std::vector<Eigen::Vector3d> points;    ///< in the model frame o [m]
  std::vector<std::array<int, 2>> edges;  ///< pairs of point numbers, each pair once
};

/// A piece of a model edge: where it is and where it leads.
struct EdgeSample {
  Eigen::Vector3d point_o;    ///< [m]
  Eigen::Vector3d tangent_o;  ///< of length 1
};

/// Samples every edge at steps of at most `step_m` [m].
std::vector<EdgeSample> sampleEdges(const EdgeModel& model, double step_m);

/// Throws InputError naming file and line for a malformed file, and "model with no face or line".
EdgeModel loadEdgeModel(const std::filesystem::path& path);

/// The same from text; `path` is named in errors and is where load("...") looks from.
EdgeModel parseEdgeModel(const std::string& text, const std::filesystem::path& path);

}  // namespace ringhook

#pragma once

/// \file
/// From a CAD mesh to an edge model for ViSP's tracker. What ViSP 3.5 makes of a model decides the
/// form (vpMbTracker::loadCAOModel, vpMbtPolygon::isVisible): every side of a face of points is a
/// line that is searched in the image; a face is visible by its normal, which is Newell's, so that
/// concave faces are right; a line is visible if any of its faces is; lines without a face are
/// always visible; "faces of lines" join one line's end to the next one's start and are of no use.
/// So
///   - a flat patch is one face; each of its holes is one more face of the same direction, since a
///     hole's edges are visible together with the surface around it;
///   - a line at the border of a curved patch gets a face as thin as a thread (micrometres), turned
///     as the patch is there: it makes the line visible with the patch and adds no other edge. Two
///     further lines lie on it, so that such a line counts twice.
/// Edges that another part of the solid hides are not known to the model, as in ViSP itself.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "tracking/mesh_repair.h"

namespace ringhook {

struct MeshModelOptions {
  double scale = 1.0;                 ///< metres in one unit of the mesh
  double feature_angle = 0.5236;      ///< between faces; at least this makes an edge [rad]
  double chord_tolerance_m = 0.0001;  ///< of chords from the edges that they stand for [m]
  double weld_m = 0.000001;           ///< points nearer than this are one [m]
};

/// An edge model made of faces, and how it came about.
struct MeshModel {
  std::vector<Eigen::Vector3d> points;  ///< in the model frame o [m]
  std::vector<std::vector<int>> faces;  ///< point numbers, counter-clockwise from outside
  Eigen::Vector3d extents_m;            ///< of the mesh [m]
  RepairReport repair;
  int lines = 0;         ///< edges that one sees
  int flat_faces = 0;    ///< of flat patches
  int hole_faces = 0;    ///< around the holes of these
  int thread_faces = 0;  ///< along the borders of curved patches
  int left_out = 0;      ///< faces and threads too small for ViSP to tell their direction
};

/// Throws InputError that begins with `where`: for a solid smaller than 1 mm or larger than 20 m
/// (the wrong unit), without an edge, or beyond what ViSP reads.
MeshModel modelFromMesh(Mesh mesh, const MeshModelOptions& options, const std::string& where);

/// The file's text; `origin` is named in its head.
std::string caoText(const MeshModel& model, const std::string& origin);

}  // namespace ringhook

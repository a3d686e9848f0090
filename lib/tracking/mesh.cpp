#include "tracking/mesh.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

constexpr std::size_t kMostEntries = 500000;
constexpr double kFarthest = 1e9;  // of a coordinate, whatever the unit

/// One .obj file, line by line.
class ObjReader {
 public:
  ObjReader(const std::string& text, const std::filesystem::path& path)
      : stream_(text), path_(path) {}

  Mesh read() {
    while (next()) {
      const std::string keyword = word();
      if (keyword == "v") {
        readPoint();
      } else if (keyword == "f") {
        readFace();
      } else {
        readOver(keyword);
      }
    }
    if (mesh_.faces.empty()) {
      throw InputError(path_.string() +
                       ": no face found; expected a Wavefront OBJ file with lines v and f");
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(path_.string() + ":" + std::to_string(first_line_) + ": " + sentence);
  }

  /// The next line, with those that it is continued by; without comment and carriage return.
  bool next() {
    std::string whole;
    std::string raw;
    bool more = true;
    first_line_ = line_ + 1;
    while (more && std::getline(stream_, raw)) {
      ++line_;
      if (!raw.empty() && raw.back() == '\r') {
        raw.pop_back();
      }
      more = !raw.empty() && raw.back() == '\\';
      whole += more ? raw.substr(0, raw.size() - 1) + " " : raw;
    }
    words_ = std::istringstream(whole.substr(0, whole.find('#')));
    return line_ >= first_line_;
  }

  std::string word() {
    std::string text;
    words_ >> text;
    return text;
  }

  void readOver(const std::string& keyword) const {
    static const std::set<std::string> kReadOver = {
        "",       "vt",    "vn",       "vp",       "g",          "o",        "s",
        "mg",     "p",     "l",        "lod",      "usemtl",     "mtllib",   "usemap",
        "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    static const std::set<std::string> kFreeForm = {"cstype", "deg",  "curv", "curv2", "surf",
                                                    "parm",   "trim", "hole", "bmat",  "step"};
    if (kFreeForm.contains(keyword)) {
      fail("free-form curves and surfaces (" + keyword +
           ") are not read: expected polygons, so export the model as a mesh");
    }
    if (!kReadOver.contains(keyword) && keyword != "end" && keyword != "sp" && keyword != "con") {
      fail("a line of a Wavefront OBJ file expected (v, f, vn, g, ...), not '" +
           keyword.substr(0, 20) + "'");
    }
  }

  double number() {
    const std::string text = word();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value) ||
        std::abs(value) > kFarthest) {
      fail("three coordinates expected after v" +
           (text.empty() ? std::string() : ", not '" + text.substr(0, 20) + "'"));
    }
    return value;
  }

  void readPoint() {
    const double x = number();
    const double y = number();
    const double z = number();
    mesh_.points.emplace_back(x, y, z);
    if (mesh_.points.size() > kMostEntries) {
      fail("more than " + std::to_string(kMostEntries) + " points: expected a coarser mesh");
    }
  }

  /// "7", "7/1", "7//2" or "7/1/2"; from the end if negative.
  int corner(const std::string& text) const {
    const std::string first = text.substr(0, text.find('/'));
    char* end = nullptr;
    const long number = std::strtol(first.c_str(), &end, 10);
    const auto points = static_cast<long>(mesh_.points.size());
    if (first.empty() || end != first.c_str() + first.size()) {
      fail("a point number expected, not '" + text.substr(0, 20) + "'");
    }
    if (number == 0 || number > points || number < -points) {
      fail("point " + first.substr(0, 20) + " does not exist: " + std::to_string(points) +
           " points stand above this line");
    }
    return static_cast<int>(number > 0 ? number - 1 : points + number);
  }

  void readFace() {
    MeshFace face;
    face.line = first_line_;
    for (std::string text = word(); !text.empty(); text = word()) {
      face.corners.push_back(corner(text));
    }
    if (face.corners.size() < 3) {
      fail("a face needs three corners or more");
    }
    sides_ += face.corners.size();
    mesh_.faces.push_back(std::move(face));
    if (sides_ > 4 * kMostEntries) {
      fail("more than " + std::to_string(4 * kMostEntries) +
           " sides of faces: expected a coarser mesh");
    }
  }

  std::istringstream stream_;
  std::filesystem::path path_;
  std::istringstream words_;
  int line_ = 0;
  int first_line_ = 0;
  std::size_t sides_ = 0;
  Mesh mesh_;
};

}  // namespace

Mesh parseObj(const std::string& text, const std::filesystem::path& path) {
  return ObjReader(text, path).read();
}

Mesh loadObj(const std::filesystem::path& path) {
  // A folder or a device would open, but has no end up to which it could be read.
  std::ifstream file(isFile(path) ? path : std::filesystem::path(), std::ios::binary);
  if (!file) {
    throw InputError(path.string() + ": cannot read this mesh (.obj expected)");
  }
  return parseObj({std::istreambuf_iterator<char>(file), {}}, path);
}

Eigen::Vector3d areaVector(const Mesh& mesh, const MeshFace& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = mesh.points[static_cast<std::size_t>(face.corners.front())];
  for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
    const Eigen::Vector3d a = mesh.points[static_cast<std::size_t>(face.corners[i])] - origin;
    const Eigen::Vector3d b = mesh.points[static_cast<std::size_t>(face.corners[i + 1])] - origin;
    sum += a.cross(b);
  }
  return sum;
}

Eigen::Vector3d extents(const Mesh& mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Eigen::Vector3d least = Eigen::Vector3d::Constant(kFar);
  Eigen::Vector3d most = -least;
  for (const MeshFace& face : mesh.faces) {
    for (const int corner : face.corners) {
      least = least.cwiseMin(mesh.points[static_cast<std::size_t>(corner)]);
      most = most.cwiseMax(mesh.points[static_cast<std::size_t>(corner)]);
    }
  }
  return most - least;
}

}  // namespace ringhook

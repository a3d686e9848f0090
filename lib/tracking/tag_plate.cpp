#include "tracking/tag_plate.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include "core/error.h"

namespace ringhook {
namespace {

/// A YAML file that knows its name, so that every complaint can give file and line.
class PlateReader {
 public:
  explicit PlateReader(const std::filesystem::path& path) : name_(path.string()) {}

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& sentence) const {
    const std::string line = mark.line < 0 ? "" : ":" + std::to_string(mark.line + 1);
    throw InputError(name_ + line + ": " + sentence);
  }

  YAML::Node parse() const {
    std::ifstream file(name_);
    if (!file) {
      throw InputError(name_ + ": cannot read this tag plate file (marker.yaml expected)");
    }
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    try {
      return YAML::Load(text);
    } catch (const YAML::Exception& e) {
      fail(e.mark, "not a YAML file: " + e.msg);
    }
  }

  double number(const YAML::Node& map, const std::string& key,
                std::optional<double> fallback) const {
    const YAML::Node node = map[key];
    if (!node && fallback) {
      return *fallback;
    }
    if (!node) {
      fail(map.Mark(), "key '" + key + "' is missing, a number was expected");
    }
    return toNumber(node, key);
  }

  double toNumber(const YAML::Node& node, const std::string& key) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      fail(node.Mark(), "'" + key + "' must be a finite number");
    }
    return value;
  }

  /// Keys x, y, z [m] and qx, qy, qz, qw; a missing quaternion means no rotation.
  Pose poseOfMap(const YAML::Node& map) const {
    const Eigen::Vector3d position(number(map, "x", 0.0), number(map, "y", 0.0),
                                   number(map, "z", 0.0));
    const Eigen::Quaterniond q(number(map, "qw", 1.0), number(map, "qx", 0.0),
                               number(map, "qy", 0.0), number(map, "qz", 0.0));
    return checkedPose(map, position, q);
  }

  /// A map as above, or seven numbers x y z qx qy qz qw.
  Pose pose(const YAML::Node& node, const std::string& key) const {
    if (node.IsMap()) {
      return poseOfMap(node);
    }
    if (!node.IsSequence() || node.size() != 7) {
      fail(node.Mark(), "'" + key + "' must be a map x, y, z, qw, qx, qy, qz or seven numbers");
    }
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      v[i] = toNumber(node[i], key);
    }
    return checkedPose(node, {v[0], v[1], v[2]}, Eigen::Quaterniond(v[6], v[3], v[4], v[5]));
  }

 private:
  Pose checkedPose(const YAML::Node& node, const Eigen::Vector3d& position,
                   const Eigen::Quaterniond& q) const {
    if (std::abs(q.norm() - 1.0) > 0.01) {
      fail(node.Mark(),
           "quaternion qx, qy, qz, qw must have length 1, not " + std::to_string(q.norm()));
    }
    return makePose(position, q);
  }

  std::string name_;
};

const std::map<std::string, int>& families() {
  static const std::map<std::string, int> sizes{
      {"tag36h11", 587}, {"tag25h9", 35}, {"tag16h5", 30}};
  return sizes;
}

std::string readFamily(const PlateReader& reader, const YAML::Node& root) {
  const YAML::Node node = root["family"];
  if (!node || !node.IsScalar()) {
    reader.fail(root.Mark(), "key 'family' is missing, one of tag36h11, tag25h9, tag16h5 expected");
  }
  if (tagFamilySize(node.Scalar()) == 0) {
    reader.fail(node.Mark(), "family '" + node.Scalar() +
                                 "' is unknown, one of tag36h11, tag25h9, tag16h5 expected");
  }
  return node.Scalar();
}

PlateTag readTag(const PlateReader& reader, const YAML::Node& node, const TagPlate& plate) {
  if (!node.IsMap()) {
    reader.fail(node.Mark(), "each entry of 'layout' must be a map with id, size and a pose");
  }
  const double id = reader.number(node, "id", std::nullopt);
  const int codes = tagFamilySize(plate.family);
  if (id != std::floor(id) || id < 0.0 || id >= codes) {
    reader.fail(node.Mark(), "'id' must be a whole number from 0 to " + std::to_string(codes - 1) +
                                 " for " + plate.family);
  }
  PlateTag tag;
  tag.id = static_cast<int>(id);
  tag.size_m = reader.number(node, "size", std::nullopt);
  if (!(tag.size_m > 0.0)) {
    reader.fail(node["size"].Mark(), "'size' must be a positive length in metres");
  }
  if (plate.find(tag.id) != nullptr) {
    reader.fail(node.Mark(), "id " + std::to_string(tag.id) + " stands twice in 'layout'");
  }
  tag.kMtag = reader.poseOfMap(node);
  return tag;
}

TagPlate readPlate(const PlateReader& reader) {
  const YAML::Node root = reader.parse();
  if (!root.IsMap()) {
    reader.fail(root.Mark(), "a map with 'family' and 'layout' was expected");
  }
  TagPlate plate;
  plate.family = readFamily(reader, root);
  const YAML::Node layout = root["layout"];
  if (!layout || !layout.IsSequence() || layout.size() == 0) {
    reader.fail(layout ? layout.Mark() : root.Mark(),
                "'layout' must be a list of at least one tag");
  }
  for (const YAML::Node& node : layout) {
    plate.tags.push_back(readTag(reader, node, plate));
  }
  if (const YAML::Node oMk = root["oMk"]) {
    plate.oMk = reader.pose(oMk, "oMk");
  }
  return plate;
}

}  // namespace

const PlateTag* TagPlate::find(int id) const {
  const auto at = std::find_if(tags.begin(), tags.end(), [id](auto& t) { return t.id == id; });
  return at == tags.end() ? nullptr : &*at;
}

int tagFamilySize(const std::string& family) {
  const auto at = families().find(family);
  return at == families().end() ? 0 : at->second;
}

std::array<Eigen::Vector3d, 4> tagCorners(const TagPlate& plate, const PlateTag& tag) {
  const Pose oMtag = plate.oMk * tag.kMtag;
  const double h = tag.size_m / 2.0;
  return {oMtag * Eigen::Vector3d(-h, -h, 0.0), oMtag * Eigen::Vector3d(h, -h, 0.0),
          oMtag * Eigen::Vector3d(h, h, 0.0), oMtag * Eigen::Vector3d(-h, h, 0.0)};
}

TagPlate loadTagPlate(const std::filesystem::path& path) {
  const PlateReader reader(path);
  try {
    return readPlate(reader);
  } catch (const YAML::Exception& e) {
    reader.fail(e.mark, "not a tag plate: " + e.msg);
  }
}

}  // namespace ringhook

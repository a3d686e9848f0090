#include "tracking/tag_plate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/yaml_fields.h"

namespace ringhook {
namespace {

constexpr double kFar = 100.0;  // [m]; no plate is larger or farther from its hook

/// Keys x, y, z [m] and qx, qy, qz, qw; a missing quaternion means no rotation.
Pose readPose(YamlFields& fields) {
  Eigen::Vector3d position(0.0, 0.0, 0.0);
  Eigen::Quaterniond q(1.0, 0.0, 0.0, 0.0);
  fields.update("x", position.x(), -kFar, kFar);
  fields.update("y", position.y(), -kFar, kFar);
  fields.update("z", position.z(), -kFar, kFar);
  fields.update("qw", q.w(), -2.0, 2.0);
  fields.update("qx", q.x(), -2.0, 2.0);
  fields.update("qy", q.y(), -2.0, 2.0);
  fields.update("qz", q.z(), -2.0, 2.0);
  if (std::abs(q.norm() - 1.0) > 0.01) {
    fields.refuseWhole("a quaternion qx, qy, qz, qw of length 1");
  }
  fields.refuseUnknown();
  return makePose(position, q);
}

/// A mapping as above, or seven numbers x y z qx qy qz qw.
Pose readPose(YamlFields& fields, const std::string& key) {
  if (fields.isMapping(key)) {
    YamlFields inner = fields.section(key);
    return readPose(inner);
  }
  return fields.pose(key);
}

const std::map<std::string, int>& families() {
  static const std::map<std::string, int> sizes{
      {"tag36h11", 587}, {"tag25h9", 35}, {"tag16h5", 30}};
  return sizes;
}

PlateTag readTag(YamlFields& fields, const TagPlate& plate) {
  PlateTag tag;
  tag.id = fields.integer("id", 0, tagFamilySize(plate.family) - 1);
  tag.size_m = fields.number("size", 0.0, kFar);
  if (tag.size_m == 0.0) {
    fields.refuse("size", "a positive length in metres");
  }
  if (plate.find(tag.id) != nullptr) {
    fields.refuse("id", "each id once, got " + std::to_string(tag.id) + " again");
  }
  tag.kMtag = readPose(fields);
  return tag;
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
  YamlFields fields = YamlFields::open(path);
  std::vector<std::string> names;
  for (const auto& [name, size] : families()) {
    names.push_back(name);
  }
  TagPlate plate;
  plate.family = names[fields.choice("family", names)];
  for (YamlFields& entry : fields.list("layout")) {
    plate.tags.push_back(readTag(entry, plate));
  }
  if (fields.has("oMk")) {
    plate.oMk = readPose(fields, "oMk");
  }
  fields.refuseUnknown();
  return plate;
}

}  // namespace ringhook

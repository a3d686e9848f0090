#pragma once

/// \file
/// A flat plate (or a bundle of plates) carrying AprilTags, as a file describes it.
/// Tag frame: origin at the tag's centre, x to the right and y down as one reads the upright tag,
/// z away from the reader into the plate. The size is the side of the black square, whose corners
/// the detector reports (Wang and Olson, "AprilTag 2", IROS 2016; layout keys after the bundles of
/// apriltag_ros). See doc/formats.md, marker.yaml.

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/pose.h"

namespace ringhook {

/// One tag of a plate.
struct PlateTag {
  int id = 0;                     ///< number of the code within its family
  double size_m = 0.0;            ///< side of the black square [m]
  Pose kMtag = Pose::Identity();  ///< tag in the plate frame
};

struct TagPlate {
  std::string family = "tag36h11";  ///< tag36h11, tag25h9 or tag16h5
  std::vector<PlateTag> tags;       ///< ids are unique
  Pose oMk = Pose::Identity();      ///< plate in the hook model frame

  /// The tag with this id, or null.
  [[nodiscard]] const PlateTag* find(int id) const;
};

/// Number of codes in a tag family; 0 for a family that the project does not know.
int tagFamilySize(const std::string& family);

/// Corners of a tag's black square in o [m]: upper left, upper right, lower right, lower left as
/// one reads the upright tag.
std::array<Eigen::Vector3d, 4> tagCorners(const TagPlate& plate, const PlateTag& tag);

/// Reads marker.yaml. Throws InputError naming the file, the line and the field.
TagPlate loadTagPlate(const std::filesystem::path& path);

}  // namespace ringhook

#include "sim/tag_pattern.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kModules = 10;      // across the tag with its white border
constexpr int kBlackModules = 8;  // across the black square
constexpr int kBorder = (kModules - kBlackModules) / 2;
constexpr std::uint8_t kWhite = 255;
constexpr std::uint8_t kBlack = 0;

}  // namespace

GrayImage tagModules(int id) {
  const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                               &tag36h11_destroy);
  if (id < 0 || static_cast<std::uint32_t>(id) >= family->ncodes) {
    throw InputError("tag id " + std::to_string(id) + " is not in tag36h11: expected 0 to " +
                     std::to_string(family->ncodes - 1));
  }
  GrayImage modules(kModules, kModules, kWhite);
  for (int y = kBorder; y < kModules - kBorder; ++y) {
    std::fill_n(modules.row(y) + kBorder, kBlackModules, kBlack);
  }
  // Bits are stored from the most significant one; their places count from the black border.
  for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
    if (((family->codes[id] >> (family->nbits - 1 - bit)) & 1U) != 0U) {
      modules.row(kBorder + static_cast<int>(family->bit_y[bit]))[kBorder + family->bit_x[bit]] =
          kWhite;
    }
  }
  return modules;
}

GrayImage drawTagPlate(const TagPlateFace& face, double texel) {
  GrayImage picture(static_cast<int>(std::lround(face.width / texel)),
                    static_cast<int>(std::lround(face.height / texel)), kWhite);
  const double module = face.tag_size / kBlackModules;
  const double first_y =
      face.height / 2.0 - 0.5 * face.tag_distance * (static_cast<double>(face.ids.size()) - 1.0);
  for (std::size_t t = 0; t < face.ids.size(); ++t) {
    const GrayImage modules = tagModules(face.ids[t]);
    const double top = first_y + static_cast<double>(t) * face.tag_distance - kModules * module / 2;
    const double left = face.width / 2.0 - kModules * module / 2.0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const double mx = std::floor(((x + 0.5) * texel - left) / module);
        const double my = std::floor(((y + 0.5) * texel - top) / module);
        if (mx >= 0.0 && mx < kModules && my >= 0.0 && my < kModules) {
          picture.row(y)[x] = modules.row(static_cast<int>(my))[static_cast<int>(mx)];
        }
      }
    }
  }
  return picture;
}

}  // namespace ringhook

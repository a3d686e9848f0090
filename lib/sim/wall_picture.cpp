#include "sim/wall_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/scene_dice.h"

namespace ringhook {
namespace {

constexpr int kMean = 205;

/// A square field that repeats beyond its borders; the side is a power of two.
class Field {
 public:
  explicit Field(int side)
      : side_(side), values_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}
  [[nodiscard]] int side() const { return side_; }
  double& at(int x, int y) {
    return values_[static_cast<std::size_t>(y & (side_ - 1)) * static_cast<std::size_t>(side_) +
                   static_cast<std::size_t>(x & (side_ - 1))];
  }

 private:
  int side_;
  std::vector<double> values_;
};

/// Noise of mean 0, smoothed over a few texels.
Field stains(int side, SceneDice& dice) {
  Field field(side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      field.at(x, y) = dice.between(-0.5, 0.5);
    }
  }
  for (const int reach : {1, 2, 4, 3, 2, 1}) {
    Field smooth(side);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        smooth.at(x, y) = 0.2 * (field.at(x, y) + field.at(x + reach, y) + field.at(x - reach, y) +
                                 field.at(x, y + reach) + field.at(x, y - reach));
      }
    }
    field = smooth;
  }
  return field;
}

void addRectangle(Field& wall, int x, int y, int width, int height, double value) {
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      wall.at(x + i, y + j) = value;
    }
  }
}

/// Panels, their joints, and notices with lines of print.
Field panels(int side, SceneDice& dice) {
  Field wall(side);
  const int panel = side / 8;
  for (int y = 0; y < side; y += panel) {
    for (int x = 0; x < side; x += panel) {
      addRectangle(wall, x, y, panel, panel, dice.between(-50.0, 35.0));
      addRectangle(wall, x, y, panel, 3, -120.0);
      addRectangle(wall, x, y, 3, panel, -120.0);
    }
  }
  for (int i = 0; i < 40; ++i) {
    const int x = dice.below(side);
    const int y = dice.below(side);
    const int width = 10 + dice.below(60);
    const int height = 10 + dice.below(80);
    addRectangle(wall, x, y, width, height, dice.between(-170.0, 50.0));
    for (int line = 6; line < height - 6; line += 8) {
      addRectangle(wall, x + 4, y + line, std::max(1, width - 8 - dice.below(12)), 3,
                   dice.between(-170.0, 50.0));
    }
  }
  return wall;
}

}  // namespace

int wallTexels(WallKind kind) { return kind == WallKind::plain ? 256 : 512; }

GrayImage wallPicture(const SceneOptions& options, std::uint64_t cell_seed) {
  constexpr double kStainContrast = 650.0;
  SceneDice dice(options, cell_seed, SceneStream::wall);
  const int side = wallTexels(options.wall);
  Field field = stains(side, dice);
  Field things = options.wall == WallKind::plain ? Field(side) : panels(side, dice);
  GrayImage picture(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double value = kMean + kStainContrast * field.at(x, y) + things.at(x, y);
      picture.row(y)[x] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
    }
  }
  return picture;
}

}  // namespace ringhook

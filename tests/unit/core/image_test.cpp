#include "core/image.h"

#include <gtest/gtest.h>

namespace ringhook {
namespace {

TEST(Window, IntersectionIsTheCommonPart) {
  const Window a{10, 20, 100, 50};
  EXPECT_EQ(intersect(a, {50, 0, 100, 30}), (Window{50, 20, 60, 10}));
  EXPECT_TRUE(intersect(a, {200, 200, 5, 5}).empty());
}

TEST(Window, ContainsItsPixelCentresOnly) {
  const Window w{10, 20, 2, 2};
  EXPECT_TRUE(w.contains(10.0, 21.0));
  EXPECT_TRUE(w.contains(11.0, 20.5));
  EXPECT_FALSE(w.contains(11.5, 20.5));
  EXPECT_FALSE(w.contains(9.9, 20.0));
}

TEST(GrayImage, RowsLieOneAfterTheOther) {
  GrayImage image(3, 2, 7);
  image.row(1)[2] = 9;
  EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{7, 7, 7, 7, 7, 9}));
}

}  // namespace
}  // namespace ringhook

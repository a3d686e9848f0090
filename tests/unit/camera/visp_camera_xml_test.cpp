#include "camera/visp_camera_xml.h"

#include <gmock/gmock.h>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

std::string cameraXml(const std::string& size) {
  return "<?xml version=\"1.0\"?>\n<root>\n<camera>\n<name>Camera</name>\n" + size +
         "<model>\n<type>perspectiveProjWithDistortion</type>\n<px>601.0</px>\n<py>602.4</py>\n"
         "<u0>321.4</u0>\n<v0>236.8</v0>\n<kud>0.0566</kud>\n<kdu>-0.0558</kdu>\n</model>\n"
         "</camera>\n</root>\n";
}

TEST(VispCamera, KudIsTheFirstRadialTerm) {
  const ScratchFolder folder;
  const auto file =
      folder.write("camera.xml",
                   cameraXml("<image_width>640</image_width>\n<image_height>480</image_height>\n"));
  const StereoRig rig = loadVispCamera(file, "Camera", {});
  EXPECT_EQ(rig.left.width, 640);
  EXPECT_EQ(rig.left.height, 480);
  EXPECT_FALSE(rig.right);
  // ViSP's law, x_d = x_u (1 + kud r^2), written out.
  const Eigen::Vector2d ideal(0.3, -0.2);
  const double factor = 1.0 + 0.0566 * ideal.squaredNorm();
  const Eigen::Vector2d pixel = projectNormalised(rig.left, ideal);
  EXPECT_NEAR(pixel.x(), 321.4 + 601.0 * ideal.x() * factor, 1e-9);
  EXPECT_NEAR(pixel.y(), 236.8 + 602.4 * ideal.y() * factor, 1e-9);
}

TEST(VispCamera, IsReadInSilence) {
  const ScratchFolder folder;
  const auto file = folder.write("camera.xml", cameraXml(""));
  ::testing::internal::CaptureStdout();
  EXPECT_NO_THROW((void)loadAnyRig(file, {640, 480}));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(VispCamera, TakesTheImagesSizeWhereTheFileTellsNone) {
  const ScratchFolder folder;
  const auto file = folder.write("camera.xml", cameraXml(""));
  EXPECT_EQ(loadAnyRig(file, {640, 480}).left.width, 640);
  EXPECT_THAT(messageOf<InputError>([&] { (void)loadAnyRig(file); }), HasSubstr("image_width"));
}

TEST(VispCamera, RefusesImagesOfAnotherSize) {
  const ScratchFolder folder;
  const auto file =
      folder.write("camera.xml",
                   cameraXml("<image_width>640</image_width>\n<image_height>480</image_height>\n"));
  EXPECT_THAT(messageOf<InputError>([&] {
                (void)loadAnyRig(file, {800, 600});
              }),
              ::testing::AllOf(HasSubstr("640x480"), HasSubstr("800x600")));
}

TEST(VispCamera, NamesAFileWithoutACamera) {
  const ScratchFolder folder;
  const auto file = folder.write("camera.xml", "<?xml version=\"1.0\"?>\n<root></root>\n");
  EXPECT_THAT(messageOf<InputError>([&] {
                (void)loadAnyRig(file, {640, 480});
              }),
              HasSubstr("camera.xml"));
  EXPECT_THROW((void)loadAnyRig(folder.path() / "none.xml", {640, 480}), InputError);
}

}  // namespace
}  // namespace ringhook

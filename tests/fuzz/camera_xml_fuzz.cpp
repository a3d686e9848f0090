// Any bytes as a ViSP camera file.

#include "camera/visp_camera_xml.h"

#include "fuzz/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const auto file = fuzz::scratch().write("camera.xml", fuzz::textOf(data, size));
  return fuzz::understoodOrRefused([&file] {
    static_cast<void>(loadAnyRig(file, {640, 480}));
    static_cast<void>(loadVispCamera(file, "", {}));
  });
}

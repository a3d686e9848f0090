// Any words on the command line: a board, a mishap, a pose.

#include "calib/solve/board.h"
#include "camera/sequence.h"
#include "fuzz/scratch_folder.h"
#include "sim/rx60_mishaps.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringhook;
  const std::string text(fuzz::textOf(data, size));
  fuzz::understoodOrRefused([&text] { static_cast<void>(parseBoard(text)); });
  fuzz::understoodOrRefused([&text] { static_cast<void>(parseMishap(text)); });
  return fuzz::understoodOrRefused([&text] { static_cast<void>(poseFromText(text, "--pose")); });
}

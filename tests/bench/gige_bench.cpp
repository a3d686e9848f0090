// The cameras' way over the network, alone: two GigE Vision devices on loopback (Aravis's fake
// cameras) send windows of the simulated cell that were rendered ahead, the product's driver
// receives them and moves the windows with every frame. Told are pairs, what stayed alone, what was
// lost, how often a frame's window was not the one that its pixels come from, and lateness; then
// the same with packets lost on purpose. Runs in a network namespace of its own.
//
//   gige_bench --seconds 60

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "../support/own_network.h"
#include "camera/aravis_stereo_camera.h"
#include "core/error.h"
#include "cycle/statistics.h"
#include "sim/cell_world.h"
#include "sim/gige_server.h"
#include "sim/nominal_rig.h"
#include "sim/sim_stereo_camera.h"

namespace ringhook {
namespace {

constexpr double kRateHz = 50.0;
constexpr int kAhead = 5;      // full pairs rendered ahead, shown in turn
constexpr int kWindow = 512;   // [px]
constexpr int kPacket = 8000;  // [bytes]

std::int64_t realNow_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::vector<StereoFrame> renderAhead() {
  CellWorld world(CellOptions{});
  SimCameraOptions options;
  options.rate_hz = 2.0;
  SimStereoCamera camera(world, nominalRig(), options);
  std::vector<StereoFrame> frames;
  while (frames.size() < kAhead) {
    world.advanceTo(world.time() + 0.1);
    while (auto frame = camera.grab(0.0)) {
      frames.push_back(std::move(*frame));
    }
  }
  return frames;
}

GrayImage crop(const GrayImage& image, const Window& region) {
  GrayImage part(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    const std::uint8_t* from = image.row(region.y + y) + region.x;
    std::copy(from, from + region.width, part.row(y));
  }
  return part;
}

struct Run {
  AravisCounts counts;
  Statistics lateness_s;
  std::int64_t windows = 0;  ///< different from the frame before
  std::int64_t wrong = 0;    ///< pixels of another place than the frame names
  std::int64_t sent = 0;     ///< pairs
};

/// The window's way through the image, a few pixels further each frame.
Window windowAt(std::int64_t index, int phase) {
  const int span = kGigeSensorSide - kWindow;
  const auto at = [span](std::int64_t v) {
    const auto folded = static_cast<int>(v % (2 * span));
    return folded < span ? folded : 2 * span - folded;
  };
  return {at(7 * index + phase), at(5 * index), kWindow, kWindow};
}

bool shows(const std::vector<StereoFrame>& ahead, const StereoFrame& got) {
  return std::any_of(ahead.begin(), ahead.end(), [&got](const StereoFrame& full) {
    return crop(full.left, got.left_window).pixels == got.left.pixels &&
           crop(full.right, got.right_window).pixels == got.right.pixels;
  });
}

Run run(const std::vector<StereoFrame>& ahead, double seconds, double lost_packets) {
  std::size_t turn = 0;
  const auto source = [&](const ExposureRequest& request) {
    const StereoFrame& full = ahead[turn++ % ahead.size()];
    ExposedPair pair;
    pair.start_ns = realNow_ns();
    for (std::size_t side = 0; side < 2; ++side) {
      if (!request.regions[side].empty()) {
        pair.images[side] = crop(side == 0 ? full.left : full.right, request.regions[side]);
      }
    }
    return std::optional<ExposedPair>(std::move(pair));
  };
  GigeServer server({"127.0.0.1", "127.0.0.2", lost_packets}, source);
  AravisOptions options;
  options.left.device = "127.0.0.1";
  options.right.device = "127.0.0.2";
  options.left.packet_bytes = options.right.packet_bytes = kPacket;
  options.clock = CameraClock::kHost;
  options.rate_hz = kRateHz;
  AravisStereoCamera camera(options);
  Run result;
  Window last;
  const auto start = std::chrono::steady_clock::now();
  const auto end = start + std::chrono::duration<double>(seconds);
  for (std::int64_t i = 0; std::chrono::steady_clock::now() < end; ++i) {
    camera.setWindows(windowAt(i, 0), windowAt(i, 40));
    const auto frame = camera.grab(1.0);
    if (!frame) {
      continue;
    }
    result.lateness_s.add(camera.counts().lateness_s);
    result.windows += frame->left_window == last ? 0 : 1;
    last = frame->left_window;
    result.wrong += shows(ahead, *frame) ? 0 : 1;
  }
  result.counts = camera.counts();
  result.sent = server.sent(0);
  return result;
}

void print(const char* what, const Run& r, double seconds) {
  const AravisCounts& c = r.counts;
  const auto number = [](std::int64_t n) { return static_cast<long long>(n); };
  std::printf("%s, %.0f s\n", what, seconds);
  std::printf("  pairs received      %8lld of %lld sent, %.2f a second\n", number(c.pairs),
              number(r.sent), static_cast<double>(c.pairs) / seconds);
  std::printf("  unpaired images     %8lld left, %lld right (while starting: %lld)\n",
              number(c.unpaired_left), number(c.unpaired_right), number(c.settling));
  std::printf("  lost images         %8lld left, %lld right; missing packets %lld, %lld\n",
              number(c.left.lost_images), number(c.right.lost_images),
              number(c.left.missing_packets), number(c.right.missing_packets));
  std::printf("  window moved in     %8lld frames; pixels of another window in %lld\n",
              number(r.windows), number(r.wrong));
  std::printf("  start of exposure to first packet: mean %.2f ms, max %.2f ms\n",
              1e3 * r.lateness_s.mean(), 1e3 * r.lateness_s.max());
}

int benchmark(double seconds) {
  if (!test::ownNetwork().empty()) {
    throw Error(test::ownNetwork());
  }
  const std::vector<StereoFrame> ahead = renderAhead();
  print("all packets arrive", run(ahead, seconds, 0.0), seconds);
  const double shorter = seconds / 6.0;
  print("one packet in 1000 is lost", run(ahead, shorter, 0.001), shorter);
  return 0;
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  double seconds = 60.0;
  CLI::App app{"Two GigE Vision cameras on loopback; to be run in app/own-network"};
  app.add_option("--seconds", seconds, "Of the first part")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    return ringhook::benchmark(seconds);
  } catch (const ringhook::Error& e) {
    std::fprintf(stderr, "gige_bench: %s\n", e.what());
    return e.exitCode();
  }
}

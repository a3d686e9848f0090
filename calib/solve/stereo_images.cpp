#include "calib/solve/stereo_images.h"

#include <algorithm>
#include <future>

#include "calib/solve/chessboard.h"
#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::size_t kAtOnce = 2;  // pairs examined at the same time
constexpr std::size_t kEnough = 4;  // views, below which something is wrong with all pictures

std::string sizeOf(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void requireSize(const std::filesystem::path& path, int image_width, int image_height, int width,
                 int height) {
  if (image_width != width || image_height != height) {
    throw InputError(path.string() + ": the image is " + sizeOf(image_width, image_height) +
                     " px, expected " + sizeOf(width, height) + " px as in the images before it");
  }
}

// What one pair of files gives.
struct Examined {
  StereoView view;
  std::string reason;  // why it cannot be used; empty if it can
  int right_width = 0;
  int right_height = 0;
};

Examined examinePair(const std::filesystem::path& left_path,
                     const std::filesystem::path& right_path, const Board& board) {
  Examined pair;
  pair.view.left_name = left_path.filename().string();
  pair.view.right_name = right_path.filename().string();
  const GrayImage left_image = readGrayImage(left_path);
  const GrayImage right_image = readGrayImage(right_path);
  pair.view.width = left_image.width;
  pair.view.height = left_image.height;
  pair.right_width = right_image.width;
  pair.right_height = right_image.height;
  const Outcome<BoardSighting> left = findBoard(left_image, board);
  if (!left) {
    pair.reason = pair.view.left_name + ": " + left.reason();
    return pair;
  }
  const Outcome<BoardSighting> right = findBoard(right_image, board);
  if (!right) {
    pair.reason = pair.view.right_name + ": " + right.reason();
    return pair;
  }
  pair.view.left = *left;
  pair.view.right = orderedLike(*left, *right, board);
  return pair;
}

void sortIn(const Examined& pair, const std::filesystem::path& left,
            const std::filesystem::path& right, StereoViews& views) {
  if (!pair.reason.empty()) {
    views.rejected.push_back({pair.view.left_name, pair.view.right_name, pair.reason});
    return;
  }
  const StereoView& first = views.usable.empty() ? pair.view : views.usable.front();
  requireSize(left, pair.view.width, pair.view.height, first.width, first.height);
  requireSize(right, pair.right_width, pair.right_height, first.width, first.height);
  views.usable.push_back(pair.view);
}

// Too few views are most often the wrong board: says what the first picture shows instead.
void tellOtherBoard(const std::vector<std::filesystem::path>& left, const Board& board,
                    StereoViews& views) {
  for (std::size_t i = 0; i < left.size() && !views.rejected.empty(); ++i) {
    if (left[i].filename() != views.rejected.front().left_name) {
      continue;
    }
    const std::string seen = seenChessboard(readGrayImage(left[i]));
    if (!seen.empty()) {
      views.rejected.front().reason += "; a chessboard with " + seen +
                                       " inner corners is there, and --board is " + toString(board);
    }
    return;
  }
}

void requireOtherFile(const std::filesystem::path& left, const std::filesystem::path& right) {
  if (std::filesystem::weakly_canonical(left) == std::filesystem::weakly_canonical(right)) {
    throw InputError(left.string() + ": the same file is in --left and --right");
  }
}

}  // namespace

std::vector<std::filesystem::path> expandGlob(const std::string& pattern,
                                              const std::string& option) {
  std::vector<std::filesystem::path> paths = filesMatching(pattern);
  if (paths.empty()) {
    throw InputError(option + ": no file matches '" + pattern + "'");
  }
  return paths;
}

StereoViews findViews(const std::vector<std::filesystem::path>& left,
                      const std::vector<std::filesystem::path>& right, const Board& board,
                      const StepHook& hook) {
  if (left.size() != right.size()) {
    throw InputError("--left matches " + std::to_string(left.size()) + " images and --right " +
                     std::to_string(right.size()) + ", expected one right image for each left one");
  }
  StereoViews views;
  for (std::size_t first = 0; first < left.size(); first += kAtOnce) {
    hook(static_cast<double>(first) / static_cast<double>(left.size()),
         left[first].filename().string());
    std::vector<std::future<Examined>> running;
    for (std::size_t i = first; i < std::min(first + kAtOnce, left.size()); ++i) {
      requireOtherFile(left[i], right[i]);
      running.push_back(
          std::async(std::launch::async, [&, i] { return examinePair(left[i], right[i], board); }));
    }
    for (std::size_t k = 0; k < running.size(); ++k) {
      sortIn(running[k].get(), left[first + k], right[first + k], views);
    }
  }
  if (views.usable.size() < kEnough) {
    tellOtherBoard(left, board, views);
  }
  hook(1.0, std::to_string(views.usable.size()) + " of " + std::to_string(left.size()) + " pairs");
  return views;
}

}  // namespace ringhook

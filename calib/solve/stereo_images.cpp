#include "calib/solve/stereo_images.h"

#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "core/error.h"

namespace ringhook {
namespace {

std::string sizeOf(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void requireSize(const std::filesystem::path& path, const GrayImage& image, int width, int height) {
  if (image.width != width || image.height != height) {
    throw InputError(path.string() + ": the image is " + sizeOf(image.width, image.height) +
                     " px, expected " + sizeOf(width, height) + " px as in the images before it");
  }
}

// One pair: into the usable views, or into the rejected ones with the reason.
void examinePair(const std::filesystem::path& left_path, const std::filesystem::path& right_path,
                 const Board& board, StereoViews& views) {
  const std::string left_name = left_path.filename().string();
  const std::string right_name = right_path.filename().string();
  const GrayImage left_image = readGrayImage(left_path);
  const GrayImage right_image = readGrayImage(right_path);
  const Outcome<BoardSighting> left_found = findBoard(left_image, board);
  if (!left_found) {
    views.rejected.push_back({left_name, right_name, left_name + ": " + left_found.reason()});
    return;
  }
  const BoardSighting& left = left_found.value();
  const Outcome<BoardSighting> right_found = findBoard(right_image, board);
  if (!right_found) {
    views.rejected.push_back({left_name, right_name, right_name + ": " + right_found.reason()});
    return;
  }
  const BoardSighting right = orderedLike(left, right_found.value(), board);
  const bool first = views.usable.empty();
  const int width = first ? left_image.width : views.usable.front().width;
  const int height = first ? left_image.height : views.usable.front().height;
  requireSize(left_path, left_image, width, height);
  requireSize(right_path, right_image, width, height);
  views.usable.push_back({left_name, right_name, width, height, left, right});
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
  for (std::size_t i = 0; i < left.size(); ++i) {
    hook(static_cast<double>(i) / static_cast<double>(left.size()), left[i].filename().string());
    if (std::filesystem::weakly_canonical(left[i]) == std::filesystem::weakly_canonical(right[i])) {
      throw InputError(left[i].string() + ": the same file is in --left and --right");
    }
    examinePair(left[i], right[i], board, views);
  }
  hook(1.0, std::to_string(views.usable.size()) + " of " + std::to_string(left.size()) + " pairs");
  return views;
}

}  // namespace ringhook

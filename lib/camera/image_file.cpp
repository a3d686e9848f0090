#include "camera/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

GrayImage fromMat(const cv::Mat& mat) {
  GrayImage image(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y) {
    std::memcpy(image.row(y), mat.ptr(y), static_cast<std::size_t>(mat.cols));
  }
  return image;
}

}  // namespace

GrayImage readGrayImage(const fs::path& file) {
  cv::Mat mat;
  try {
    mat = cv::imread(file.string(), cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& e) {
    throw InputError("cannot read the image " + file.string() + ": " + e.err);
  }
  if (mat.empty()) {
    throw InputError("cannot read the image " + file.string() +
                     ": expected a whole PNG, PGM, JPEG, TIFF or BMP file");
  }
  return fromMat(mat);
}

void writeGrayImage(const fs::path& file, const GrayImage& image) {
  const cv::Mat mat(image.height, image.width, CV_8UC1,
                    const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<unsigned char> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(file.extension().string(), mat, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception& e) {
    throw Error("cannot write the image " + file.string() + ": " + e.err);
  }
  if (!encoded) {
    throw Error("cannot write the image " + file.string() + ": unknown format");
  }
  writeFileAtomically(file, std::string(bytes.begin(), bytes.end()));
}

bool isVideoName(const fs::path& file) {
  static constexpr std::array kContainers = {".mp4", ".avi",  ".mkv", ".mov", ".webm",
                                             ".mpg", ".mpeg", ".m4v", ".ogv"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kContainers.begin(), kContainers.end(), extension) != kContainers.end();
}

struct VideoReader::Held {
  cv::VideoCapture capture;
};

VideoReader::VideoReader(const fs::path& file) : held_(std::make_unique<Held>()) {
  if (!isFile(file)) {
    throw InputError("there is no file " + file.string() + ": expected a video");
  }
  try {
    held_->capture.open(file.string());
  } catch (const cv::Exception& e) {
    throw InputError("cannot read the video " + file.string() + ": " + e.err);
  }
  if (!held_->capture.isOpened()) {
    throw InputError("cannot read the video " + file.string() +
                     ": expected a container and codec that FFmpeg knows");
  }
}

VideoReader::~VideoReader() = default;
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;

std::optional<GrayImage> VideoReader::next() {
  cv::Mat mat;
  if (!held_->capture.read(mat) || mat.empty()) {
    return std::nullopt;
  }
  if (mat.channels() == 3) {
    cv::Mat grey;
    cv::cvtColor(mat, grey, cv::COLOR_BGR2GRAY);
    return fromMat(grey);
  }
  return fromMat(mat);
}

std::size_t VideoReader::expectedFrames() const {
  const double count = held_->capture.get(cv::CAP_PROP_FRAME_COUNT);
  return count > 0.0 && count < 1e9 ? static_cast<std::size_t>(count) : 0;
}

double VideoReader::rateHz() const {
  const double rate = held_->capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(rate) && rate > 0.0 ? rate : 0.0;
}

}  // namespace ringhook

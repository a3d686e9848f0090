#include "calib/wizard/live_view.h"

#include <cstdlib>
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/atomic_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kWidth = 640;  // of one picture [px]
constexpr auto kTitle = "ringhook calibrate wizard";

cv::Mat smallPicture(const GrayImage& image, const Window& window,
                     const std::vector<Eigen::Vector2d>& points) {
  cv::Mat grey(image.height, image.width, CV_8UC1);
  std::copy(image.pixels.begin(), image.pixels.end(), grey.data);
  const double scale = static_cast<double>(kWidth) / image.width;
  cv::Mat small;
  cv::resize(grey, small, cv::Size(), scale, scale, cv::INTER_AREA);
  cv::Mat colour;
  cv::cvtColor(small, colour, cv::COLOR_GRAY2BGR);
  for (const Eigen::Vector2d& point : points) {
    const cv::Point2d at((point.x() - window.x) * scale, (point.y() - window.y) * scale);
    cv::circle(colour, at, 3, cv::Scalar(60, 200, 60), 1, cv::LINE_AA);
  }
  return colour;
}

}  // namespace

LiveView::LiveView(std::filesystem::path file, bool window)
    : file_(std::move(file)), window_(window) {}

LiveView::~LiveView() {
  if (window_) {
    try {
      cv::destroyAllWindows();
    } catch (const cv::Exception&) {
      window_ = false;  // the display went first
    }
  }
}

void LiveView::show(const StereoFrame& frame, const std::vector<Eigen::Vector2d>& left,
                    const std::vector<Eigen::Vector2d>& right) {
  cv::Mat both;
  cv::hconcat(smallPicture(frame.left, frame.left_window, left),
              smallPicture(frame.right, frame.right_window, right), both);
  AtomicFile file(file_);
  if (!cv::imwrite(file.temporaryPath().string(), both)) {
    throw Error("cannot write " + file_.string());
  }
  file.commit();
  if (window_) {
    try {
      cv::imshow(kTitle, both);
      cv::waitKey(1);
    } catch (const cv::Exception&) {
      window_ = false;  // no display after all: the file goes on
    }
  }
}

bool LiveView::displayAtHand() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') {
      return true;
    }
  }
  return false;
}

}  // namespace ringhook

#include "evaluation/overlay.h"

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace ringhook {
namespace {

const cv::Scalar kModel(0, 200, 255);  // amber, blue-green-red
const cv::Scalar kSeen(255, 160, 0);   // blue

/// Draws in the picture what is given in the camera's full rectified image.
class Pen {
 public:
  Pen(cv::Mat& picture, const RectifiedView& view, double scale, const Pose& c1Mo)
      : picture_(picture), view_(view), scale_(scale), c1Mo_(c1Mo) {}

  [[nodiscard]] cv::Point2d at(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - view_.window.x) * scale_, (pixel.y() - view_.window.y) * scale_};
  }
  void line(const Eigen::Vector3d& a_o, const Eigen::Vector3d& b_o, const cv::Scalar& colour) {
    const auto a = view_.camera.project(c1Mo_ * a_o);
    const auto b = view_.camera.project(c1Mo_ * b_o);
    if (a && b) {
      cv::line(picture_, at(*a), at(*b), colour, 1, cv::LINE_AA);
    }
  }
  void dot(const Eigen::Vector2d& pixel) {
    cv::circle(picture_, at(pixel), 2, kSeen, cv::FILLED, cv::LINE_AA);
  }

 private:
  cv::Mat& picture_;
  const RectifiedView& view_;
  double scale_;
  Pose c1Mo_;
};

/// Length of the drawn axes [m]: about a twelfth of the picture's width at the hook.
double axisLength(const RectifiedView& view, const Pose& c1Mo) {
  return view.window.width / 12.0 / view.camera.fx * std::max(0.01, c1Mo.translation().z());
}

void drawSnapshot(cv::Mat& picture, const Snapshot& snapshot, double scale) {
  Pen pen(picture, snapshot.left, scale, snapshot.fix.c1Mo);
  const CameraFeatures& features = snapshot.view.cameras.front();
  for (const auto& edge : features.edges) {
    pen.line(edge.start_o, edge.end_o, kModel);
  }
  for (const auto& edge : features.edges) {
    pen.dot(edge.pixel);
  }
  for (std::size_t i = 0; i + 3 < features.corners.size(); i += 4) {
    for (std::size_t side = 0; side < 4; ++side) {
      pen.line(features.corners[i + side].point_o, features.corners[i + (side + 1) % 4].point_o,
               kModel);
    }
  }
  for (const auto& corner : features.corners) {
    pen.dot(corner.pixel);
  }
  const double length = axisLength(snapshot.left, snapshot.fix.c1Mo);
  const std::array colours = {cv::Scalar(0, 0, 255), cv::Scalar(0, 200, 0), cv::Scalar(255, 0, 0)};
  for (int axis = 0; axis < 3; ++axis) {
    pen.line(Eigen::Vector3d::Zero(), length * Eigen::Vector3d::Unit(axis),
             colours.at(static_cast<std::size_t>(axis)));
  }
}

}  // namespace

std::string overlayPng(const Snapshot& snapshot, int largest_width) {
  const GrayImage& image = snapshot.left.image;
  const cv::Mat grey(image.height, image.width, CV_8UC1,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  const double scale = std::min(1.0, static_cast<double>(largest_width) / image.width);
  cv::Mat picture;
  std::vector<unsigned char> bytes;
  try {
    cv::resize(grey, picture, {}, scale, scale, cv::INTER_AREA);
    cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    drawSnapshot(picture, snapshot, scale);
    cv::imencode(".png", picture, bytes);
  } catch (const cv::Exception& e) {
    throw Error("cannot draw the report's picture: " + e.err);
  }
  return {bytes.begin(), bytes.end()};
}

std::string base64(const std::string& bytes) {
  constexpr auto kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      const bool padding = i + j > bytes.size();
      text += padding ? '=' : kDigits[group >> (18U - 6U * static_cast<unsigned>(j)) & 63U];
    }
  }
  return text;
}

}  // namespace ringhook

#include "rig/rectify_map.h"

#include <Eigen/LU>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kParts = cv::INTER_TAB_SIZE;  // fractions of a pixel
constexpr std::int16_t kNowhere = -20000;   // outside every raw window, also after a shift

}  // namespace

std::optional<Eigen::Vector2d> rawPosition(const TurnedCamera& camera,
                                           const Eigen::Vector2d& rectified) {
  const PinholeView& view = camera.view;
  const Eigen::Vector3d ray =
      camera.rRc.transpose() * Eigen::Vector3d((rectified.x() - view.cx) / view.fx,
                                               (rectified.y() - view.cy) / view.fy, 1.0);
  if (!(ray.z() > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d normalised = ray.head<2>() / ray.z();
  if (normalised.norm() >= camera.fold_radius) {
    return std::nullopt;
  }
  return projectNormalised(camera.raw, normalised);
}

RectifyMap::RectifyMap(const TurnedCamera& camera, const Window& window) : window_(window) {
  const std::size_t count =
      static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
  whole_.assign(2 * count, kNowhere);
  fraction_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto column = static_cast<int>(i % static_cast<std::size_t>(window.width));
    const auto row = static_cast<int>(i / static_cast<std::size_t>(window.width));
    const auto p = rawPosition(camera, Eigen::Vector2d(window.x + column, window.y + row));
    if (!p || p->cwiseAbs().maxCoeff() > -kNowhere) {
      continue;
    }
    const int x = static_cast<int>(std::lround(p->x() * kParts));
    const int y = static_cast<int>(std::lround(p->y() * kParts));
    whole_[2 * i] = static_cast<std::int16_t>(x >> cv::INTER_BITS);
    whole_[2 * i + 1] = static_cast<std::int16_t>(y >> cv::INTER_BITS);
    fraction_[i] = static_cast<std::uint16_t>((y & (kParts - 1)) * kParts + (x & (kParts - 1)));
  }
}

std::size_t RectifyMap::index(int x, int y) const {
  return static_cast<std::size_t>(y - window_.y) * static_cast<std::size_t>(window_.width) +
         static_cast<std::size_t>(x - window_.x);
}

bool RectifyMap::covered(int x, int y, const Window& raw) const {
  const std::size_t i = index(x, y);
  const int raw_x = whole_[2 * i];
  const int raw_y = whole_[2 * i + 1];
  const int more_x = fraction_[i] % kParts != 0 ? 1 : 0;
  const int more_y = fraction_[i] / kParts != 0 ? 1 : 0;
  return raw_x >= raw.x && raw_y >= raw.y && raw_x + more_x < raw.x + raw.width &&
         raw_y + more_y < raw.y + raw.height;
}

GrayImage RectifyMap::remap(const GrayImage& image, const Window& raw, const Window& target) const {
  GrayImage out(target.width, target.height);
  if (target.empty()) {
    return out;
  }
  const cv::Rect part(target.x - window_.x, target.y - window_.y, target.width, target.height);
  // OpenCV's headers take no const data; none of these three is written.
  const cv::Mat whole(window_.height, window_.width, CV_16SC2,
                      const_cast<std::int16_t*>(whole_.data()));
  const cv::Mat fraction(window_.height, window_.width, CV_16UC1,
                         const_cast<std::uint16_t*>(fraction_.data()));
  const cv::Mat source(image.height, image.width, CV_8UC1,
                       const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat result(out.height, out.width, CV_8UC1, out.pixels.data());
  try {
    cv::Mat shifted;
    cv::subtract(whole(part), cv::Scalar(raw.x, raw.y), shifted);
    cv::remap(source, result, shifted, fraction(part), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  } catch (const cv::Exception& e) {
    throw Error(std::string("rectification failed: ") + e.err);
  }
  return out;
}

}  // namespace ringhook

#include "rig/rectifier.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string>

#include "core/error.h"
#include "core/shortest_turn.h"
#include "rig/covered_rectangle.h"
#include "rig/rectify_map.h"

namespace ringhook {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kBorderSteps = 16;        // samples per side of a window
constexpr double kLargestGrowth = 2.0;  // full view over raw image, per axis

Window fullWindow(const CameraModel& camera) { return {0, 0, camera.width, camera.height}; }

std::string sizeText(const Window& w) {
  return std::to_string(w.width) + "x" + std::to_string(w.height) + " at (" + std::to_string(w.x) +
         ", " + std::to_string(w.y) + ")";
}

/// Points once around the border of a window, from its first pixel to its last.
std::vector<Vector2d> borderPoints(const Window& w) {
  const Vector2d a(w.x, w.y);
  const Vector2d c(w.x + w.width - 1, w.y + w.height - 1);
  const std::array<Vector2d, 4> corners = {a, Vector2d(c.x(), a.y()), c, Vector2d(a.x(), c.y())};
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int s = 0; s < kBorderSteps; ++s) {
      points.emplace_back(corners[i] +
                          (corners[(i + 1) % 4] - corners[i]) * (double(s) / kBorderSteps));
    }
  }
  return points;
}

/// Rectified pixel, with the rectified camera's present principal point.
std::optional<Vector2d> rectified(const TurnedCamera& camera, const Vector2d& raw) {
  const auto normalised = undistortPixel(camera.raw, raw);
  if (!normalised) {
    return std::nullopt;
  }
  const Vector3d ray = camera.rRc * normalised->homogeneous();
  if (!(ray.z() > 0.0)) {
    return std::nullopt;
  }
  return Vector2d(camera.view.fx * ray.x() / ray.z() + camera.view.cx,
                  camera.view.fy * ray.y() / ray.z() + camera.view.cy);
}

std::vector<Vector2d> rectifiedBorder(const TurnedCamera& camera, const Window& raw) {
  std::vector<Vector2d> points;
  for (const Vector2d& p : borderPoints(raw)) {
    if (const auto q = rectified(camera, p)) {
      points.push_back(*q);
    }
  }
  return points;
}

struct Box {
  Vector2d low = Vector2d::Constant(1e9);
  Vector2d high = Vector2d::Constant(-1e9);
  void add(const std::vector<Vector2d>& points) {
    for (const Vector2d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  /// Whole pixels that contain the box and `margin` more on each side.
  [[nodiscard]] Window window(int margin) const {
    const int x = static_cast<int>(std::floor(low.x())) - margin;
    const int y = static_cast<int>(std::floor(low.y())) - margin;
    return {x, y, static_cast<int>(std::ceil(high.x())) + margin - x + 1,
            static_cast<int>(std::ceil(high.y())) + margin - y + 1};
  }
};

/// Size and principal point that show the raw images of all cameras whole.
void fitFullView(std::vector<TurnedCamera>& cameras) {
  Box box;
  for (const TurnedCamera& camera : cameras) {
    box.add(rectifiedBorder(camera, fullWindow(camera.raw)));
  }
  if (!(box.high.x() > box.low.x())) {
    throw InputError("the rig's lens model cannot be inverted anywhere at the border of its image");
  }
  const CameraModel& raw = cameras.front().raw;
  const Vector2d limit = kLargestGrowth * Vector2d(raw.width, raw.height);
  const Vector2d centre = 0.5 * (box.low + box.high);
  const Vector2d half = 0.5 * (box.high - box.low).cwiseMin(limit);
  const Vector2d low = (centre - half).array().floor();
  const Vector2d size = (centre + half - low).array().ceil() + 1.0;
  for (TurnedCamera& camera : cameras) {
    camera.view.cx -= low.x();
    camera.view.cy -= low.y();
    camera.view.width = static_cast<int>(size.x());
    camera.view.height = static_cast<int>(size.y());
  }
}

TurnedCamera turned(const CameraModel& raw) {
  TurnedCamera camera;
  camera.raw = raw;
  camera.fold_radius = foldRadius(raw);
  camera.view.fx = raw.K(0, 0);
  camera.view.fy = raw.K(1, 1);
  camera.view.cx = raw.K(0, 2);
  camera.view.cy = raw.K(1, 2);
  return camera;
}

std::vector<TurnedCamera> turnedPair(const StereoRig& rig) {
  std::vector<TurnedCamera> cameras = {turned(rig.left), turned(*rig.right)};
  // Half of the relative rotation for each camera.
  const Eigen::AngleAxisd c2Rc1(Matrix3d(rig.c2Mc1.linear()));
  const Matrix3d half = Eigen::AngleAxisd(0.5 * c2Rc1.angle(), c2Rc1.axis()).toRotationMatrix();
  // Then x along the baseline, on the side where it points now.
  const Vector3d t = half.transpose() * rig.c2Mc1.translation();
  const Vector3d along(t.x() < 0.0 ? -1.0 : 1.0, 0.0, 0.0);
  const Matrix3d turn = shortestTurn(t, along).toRotationMatrix();
  cameras[0].rRc = turn * half;
  cameras[1].rRc = turn * half.transpose();
  const double focal =
      0.25 * (rig.left.K(0, 0) + rig.left.K(1, 1) + rig.right->K(0, 0) + rig.right->K(1, 1));
  for (TurnedCamera& camera : cameras) {
    camera.view.fx = camera.view.fy = focal;
    camera.view.cx = camera.view.cy = 0.0;
  }
  cameras[0].view.cMc1.linear() = cameras[0].rRc;
  Pose turn_right = Pose::Identity();
  turn_right.linear() = cameras[1].rRc;
  cameras[1].view.cMc1 = turn_right * rig.c2Mc1;
  return cameras;
}

}  // namespace

struct Rectifier::Side {
  explicit Side(TurnedCamera turned_camera) : camera(std::move(turned_camera)) {
    Box box;
    box.add(rectifiedBorder(camera, fullWindow(camera.raw)));
    content = intersect(box.window(1), {0, 0, camera.view.width, camera.view.height});
  }

  [[nodiscard]] const RectifyMap& map() const {
    std::call_once(map_made, [this] { made_map = std::make_unique<RectifyMap>(camera, content); });
    return *made_map;
  }

  TurnedCamera camera;
  Window content;  // rectified pixels that the full raw image reaches
  mutable std::once_flag map_made;
  mutable std::unique_ptr<const RectifyMap> made_map;
};

Rectifier::Rectifier(const StereoRig& rig) {
  checkRig(rig, "the rig");
  std::vector<TurnedCamera> cameras =
      rig.right ? turnedPair(rig) : std::vector<TurnedCamera>{turned(rig.left)};
  fitFullView(cameras);
  left_ = std::make_shared<const Side>(cameras[0]);
  if (rig.right) {
    right_ = std::make_shared<const Side>(cameras[1]);
  }
}

bool Rectifier::stereo() const { return right_ != nullptr; }

const Rectifier::Side& Rectifier::at(int side) const {
  if (side == 0) {
    return *left_;
  }
  if (side != 1 || !right_) {
    throw Error("the rig has no camera of side " + std::to_string(side));
  }
  return *right_;
}

const PinholeView& Rectifier::view(int side) const { return at(side).camera.view; }

RectifiedView Rectifier::rectifySide(int side, const GrayImage& image, const Window& window) const {
  const Side& s = at(side);
  const Window full = fullWindow(s.camera.raw);
  if (window.empty() || intersect(window, full) != window || image.width != window.width ||
      image.height != window.height) {
    throw InputError(std::string(side == 0 ? "left" : "right") + " image of " +
                     std::to_string(image.width) + "x" + std::to_string(image.height) +
                     " px for the window " + sizeText(window) +
                     " does not match the rig, whose images have " + std::to_string(full.width) +
                     "x" + std::to_string(full.height) + " px");
  }
  RectifiedView view;
  view.camera = s.camera.view;
  view.window = rectifiedWindow(side, window);
  view.image = s.map().remap(image, window, view.window);
  return view;
}

RectifiedFrame Rectifier::rectify(const StereoFrame& frame) const {
  RectifiedFrame out;
  out.time = frame.time;
  out.views.push_back(rectifySide(0, frame.left, frame.left_window));
  if (!frame.right.empty()) {
    if (!stereo()) {
      throw InputError("the frame has a right image, but the rig describes one camera");
    }
    out.views.push_back(rectifySide(1, frame.right, frame.right_window));
  }
  return out;
}

Window Rectifier::rectifiedWindow(int side, const Window& raw) const {
  const Side& s = at(side);
  const Window full = fullWindow(s.camera.raw);
  if (intersect(raw, full) == full) {
    return s.content;
  }
  const Window clipped = intersect(raw, full);
  if (clipped.empty()) {
    return {};
  }
  const auto covered = [&](int x, int y) { return s.map().covered(x, y, clipped); };
  return coveredRectangle(rectifiedBorder(s.camera, clipped), s.content, covered);
}

Window Rectifier::rawWindow(int side, const Window& rectified_window) const {
  const Side& s = at(side);
  const Window full = fullWindow(s.camera.raw);
  const Window wanted = intersect(rectified_window, s.content);
  if (wanted.empty()) {
    return {};
  }
  Box box;
  for (const Vector2d& p : borderPoints(wanted)) {
    if (const auto raw = rawPosition(s.camera, p)) {
      box.add({*raw});
    }
  }
  if (!(box.high.x() >= box.low.x())) {
    return {};
  }
  for (int margin = 2;; margin *= 2) {
    const Window raw = box.window(margin);
    const Window clipped = intersect(raw, full);
    const bool reaches_border = raw != clipped;
    if (reaches_border || intersect(rectifiedWindow(side, raw), wanted) == wanted) {
      return clipped;
    }
  }
}

Vector2d Rectifier::rectifyPoint(int side, const Vector2d& raw) const {
  const auto point = rectified(at(side).camera, raw);
  if (!point) {
    throw InputError("pixel (" + std::to_string(raw.x()) + ", " + std::to_string(raw.y()) +
                     ") lies beyond the rig's lens model");
  }
  return *point;
}

Vector2d Rectifier::distortPoint(int side, const Vector2d& rectified_px) const {
  const auto raw = rawPosition(at(side).camera, rectified_px);
  if (!raw) {
    throw InputError("rectified pixel (" + std::to_string(rectified_px.x()) + ", " +
                     std::to_string(rectified_px.y()) + ") lies beyond the rig's lens model");
  }
  return *raw;
}

}  // namespace ringhook

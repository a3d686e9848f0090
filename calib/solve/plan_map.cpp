#include "calib/solve/plan_map.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/number_text.h"
#include "rig/camera_model.h"

namespace ringhook {
namespace {

constexpr int kAcrossSteps = 40;
constexpr int kAlongSteps = 48;
constexpr double kNearest = 0.3;   // of the working distance
constexpr double kFarthest = 2.1;  // of the working distance

PlanPoint planPoint(const PlanView& view, const Eigen::Vector3d& point_m, double sigma_px) {
  const Eigen::Matrix3d C = pointCovariance(view, point_m, sigma_px);
  const Eigen::Vector3d point_c1 = view.c1Mm * point_m;
  const Eigen::Vector3d point_c2 = view.rig.c2Mc1 * point_c1;
  PlanPoint point;
  point.point_m = point_m;
  point.left_px = projectNormalised(view.rig.left, point_c1.hnormalized());
  point.right_px = projectNormalised(*view.rig.right, point_c2.hnormalized());
  point.sigma_m = C.diagonal().cwiseSqrt();
  point.total_m = std::sqrt(C.trace());
  return point;
}

Eigen::Vector3d middleOf(const StereoField& field) {
  const Eigen::Vector2d middle = 0.5 * (field.low_m + field.high_m);
  return {middle.x(), middle.y(), field.distance_m};
}

void mapAcross(const PlanView& view, PlanMap& map) {
  const Eigen::Vector2d extent = map.field.high_m - map.field.low_m;
  const Eigen::Vector3d middle = middleOf(map.field);
  map.across_step_m = 1.2 * extent.maxCoeff() / kAcrossSteps;
  for (int j = -kAcrossSteps / 2; j <= kAcrossSteps / 2; ++j) {
    for (int i = -kAcrossSteps / 2; i <= kAcrossSteps / 2; ++i) {
      const Eigen::Vector3d point = middle + map.across_step_m * Eigen::Vector3d(i, j, 0.0);
      if (view.room(point) >= 0.0) {
        map.across.push_back(planPoint(view, point, map.sigma_px));
      }
    }
  }
}

void mapAlong(const PlanView& view, PlanMap& map) {
  for (int i = 0; i <= kAlongSteps; ++i) {
    const double share = kNearest + (kFarthest - kNearest) * i / kAlongSteps;
    const StereoField field = stereoField(view, share * map.distance_m);
    if (!field.empty() && view.room(middleOf(field)) >= 0.0) {
      map.fields.push_back(field);
      map.along.push_back(planPoint(view, middleOf(field), map.sigma_px));
    }
  }
}

TagError tagError(const PlanView& view, const Eigen::Vector3d& at_m, double size_m,
                  double sigma_px) {
  Pose mMo = Pose::Identity();
  mMo.translation() = at_m;
  const Covariance6 C = targetCovariance(view, tagCornersOf(size_m), mMo, sigma_px);
  return {std::sqrt(C.topLeftCorner<3, 3>().trace()),
          std::sqrt(C.bottomRightCorner<3, 3>().trace())};
}

void addRow(std::string& text, const char* section, const PlanPoint& p) {
  text += section;
  const std::array<double, 11> numbers{
      p.point_m.x(),       p.point_m.y(),       p.point_m.z(),  p.left_px.x(),
      p.left_px.y(),       p.right_px.x(),      p.right_px.y(), 1e3 * p.sigma_m.x(),
      1e3 * p.sigma_m.y(), 1e3 * p.sigma_m.z(), 1e3 * p.total_m};
  for (const double number : numbers) {
    text += "," + exactText(number);
  }
  text += "\n";
}

}  // namespace

PlanMap mapPlan(const PlanView& view, double sigma_px, double distance_m, double tag_size_m,
                const std::optional<WorkBox>& box) {
  PlanMap map;
  map.sigma_px = sigma_px;
  map.distance_m = distance_m;
  map.field = stereoField(view, distance_m);
  if (!map.field.empty()) {
    map.middle = planPoint(view, middleOf(map.field), sigma_px);
    mapAcross(view, map);
    if (tag_size_m > 0.0) {
      map.tag = tagError(view, map.middle->point_m, tag_size_m, sigma_px);
    }
  }
  mapAlong(view, map);
  if (box) {
    map.box = box;
    map.box_error = boxError(view, *box, sigma_px);
  }
  return map;
}

std::string planTable(const PlanMap& map) {
  std::string text =
      "section,x_m,y_m,z_m,left_u_px,left_v_px,right_u_px,right_v_px,"
      "sigma_x_mm,sigma_y_mm,sigma_z_mm,sigma_mm\n";
  for (const PlanPoint& p : map.across) {
    addRow(text, "field", p);
  }
  for (const PlanPoint& p : map.along) {
    addRow(text, "distance", p);
  }
  return text;
}

}  // namespace ringhook

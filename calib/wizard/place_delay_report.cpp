#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/solve/small_statistics.h"
#include "calib/wizard/place_delays.h"

namespace ringhook {
namespace {

constexpr double kGoodSigma = 0.0003;  // asked for [s]
constexpr double kNegative = 0.0005;   // a delay below minus this cannot be [s]
constexpr double kLateScale = 1.4826;  // of the median deviation to a normal one's standard one

/// The usual lateness; a few late images do not count.
KnownDelay usual(const std::vector<double>& lateness_s) {
  const double value = median(lateness_s);
  std::vector<double> deviation;
  for (const double late : lateness_s) {
    deviation.push_back(std::abs(late - value));
  }
  const double sigma =
      1.25 * kLateScale * median(deviation) / std::sqrt(static_cast<double>(lateness_s.size()));
  return {value, sigma};
}

std::string inMilliseconds(double value_s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f ms", 1e3 * value_s);
  return text;
}

/// What speaks against a result, or nothing.
std::string objection(const DelayReport& report) {
  if (report.offset.sigma_s > kGoodSigma) {
    return "the delay is only sure to " + inMilliseconds(report.offset.sigma_s) +
           ": wiggle for longer, or where the plate is seen larger";
  }
  for (const auto* delay : {&report.robot, &report.camera}) {
    if (*delay && (*delay)->value_s < -kNegative) {
      return "a message that comes " + inMilliseconds(-(*delay)->value_s) +
             " before what it tells: a stamp is on another clock than said, or the told delay of "
             "the other side is wrong";
    }
  }
  return {};
}

void judge(DelayReport& report) {
  report.sentence = objection(report);
  report.grade = report.sentence.empty() ? DelayGrade::ok : DelayGrade::bad;
  if (report.grade == DelayGrade::ok) {
    report.sentence =
        report.robot && report.camera ? "both delays are known well enough"
        : report.robot ? "the arm's delay is known; of the camera's, stamps tell nothing"
                       : "the camera's delay is known against the arm's, which was taken as told";
  }
}

}  // namespace

Outcome<DelayReport> delaysOf(const WiggleRecord& record, const StereoRig& told) {
  const Outcome<TimeOffset> offset = findTimeOffset(record.motion);
  if (!offset) {
    return Refusal{offset.reason()};
  }
  DelayReport report;
  report.offset = *offset;
  report.frames = record.frames;
  if (record.stamps_are_mid_exposure) {
    report.robot = KnownDelay{offset->offset_s, offset->sigma_s};
    if (!record.lateness_s.empty()) {
      report.camera = usual(record.lateness_s);
    }
  } else {
    report.camera = KnownDelay{told.robot_delay_s - offset->offset_s, offset->sigma_s};
  }
  if (const auto response = findResponseDelay(record.sent, record.states)) {
    report.response = *response;
    report.arm_delay_s = response->delay_s - record.command_delay_s;
  }
  judge(report);
  return report;
}

StereoRig withDelays(StereoRig rig, const DelayReport& report) {
  if (report.robot) {
    rig.robot_delay_s = report.robot->value_s;
  }
  if (report.camera) {
    rig.camera_delay_s = report.camera->value_s;
  }
  return rig;
}

}  // namespace ringhook

#include "app/calibrate_plan_job.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/angle.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::uint64_t kCheckSeed = 1;

/// What the words of a job mean, checked.
struct Question {
  PlannedSensor sensor;
  std::optional<StereoRig> rig;
  std::optional<WorkBox> box;
  std::optional<double> distance_m;
};

void requireWithin(const std::optional<double>& value, double low, double high, const char* option,
                   const char* unit) {
  if (value && !(*value >= low && *value <= high)) {
    char text[160];
    std::snprintf(text, sizeof(text), "%s: expected a number of %s from %g to %g, got %g", option,
                  unit, low, high, *value);
    throw InputError(text);
  }
}

/// `count` positive numbers joined by x, as in 2048x2048.
std::vector<double> product(const std::string& text, int count, double high, const char* option,
                            const char* example) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size() && numbers.size() <= static_cast<std::size_t>(count)) {
    const std::size_t end = std::min(text.find('x', at), text.size());
    const std::string word = text.substr(at, end - at);
    char* rest = nullptr;
    const double value = std::strtod(word.c_str(), &rest);
    const bool whole = !word.empty() && *rest == '\0' &&
                       word.find_first_not_of("0123456789.") == std::string::npos;
    numbers.push_back(whole ? value : -1.0);
    at = end + 1;
  }
  bool good = numbers.size() == static_cast<std::size_t>(count);
  for (const double value : numbers) {
    good = good && value > 0.0 && value <= high;
  }
  if (!good) {
    throw InputError(std::string(option) + ": '" + text + "' is not of the form " + example);
  }
  return numbers;
}

PlannedSensor readSensor(const PlanJob& job) {
  requireWithin(job.focal_px, 10.0, 1e6, "--focal-px", "pixels");
  requireWithin(job.lens_mm, 0.1, 1e4, "--lens-mm", "millimetres");
  requireWithin(job.pixel_um, 0.1, 1e3, "--pixel-um", "micrometres");
  if (job.focal_px.has_value() == (job.lens_mm || job.pixel_um) ||
      job.lens_mm.has_value() != job.pixel_um.has_value()) {
    throw InputError(
        "--focal-px: expected the focal length in pixels, or instead of it both --lens-mm and "
        "--pixel-um");
  }
  const auto size =
      product(job.sensor, 2, 16384.0, "--sensor", "WIDTHxHEIGHT in pixels, as in 2048x2048");
  return {static_cast<int>(size[0]), static_cast<int>(size[1]),
          job.focal_px ? *job.focal_px : 1e3 * *job.lens_mm / *job.pixel_um};
}

void refuseBesideRig(const PlanJob& job) {
  if (job.focal_px || job.lens_mm || job.pixel_um || job.baseline_m || job.vergence_deg) {
    throw InputError(
        "--rig: the file tells focal length, baseline and vergence; expected none of --focal-px, "
        "--lens-mm, --pixel-um, --baseline-m, --vergence-deg beside it");
  }
}

PlannedSensor sensorOf(const StereoRig& rig) {
  const CameraModel& right = rig.right ? *rig.right : rig.left;
  const double focal = 0.25 * (rig.left.K(0, 0) + rig.left.K(1, 1) + right.K(0, 0) + right.K(1, 1));
  return {rig.left.width, rig.left.height, focal};
}

Question readJob(const PlanJob& job) {
  requireWithin(job.baseline_m, 1e-3, 100.0, "--baseline-m", "metres");
  requireWithin(job.vergence_deg, -60.0, 120.0, "--vergence-deg", "degrees");
  requireWithin(job.distance_m, 1e-2, 1e3, "--distance-m", "metres");
  requireWithin(job.noise_px, 1e-4, 10.0, "--noise-px", "pixels");
  requireWithin(job.wanted_mm, 1e-5, 1e4, "--wanted-mm", "millimetres");
  requireWithin(job.max_baseline_m, 1e-3, 100.0, "--max-baseline-m", "metres");
  requireWithin(job.tag_mm, 1.0, 1e4, "--tag-mm", "millimetres");
  Question question;
  question.distance_m = job.distance_m;
  if (job.rig.empty()) {
    question.sensor = readSensor(job);
  } else {
    refuseBesideRig(job);
    question.rig = loadRig(job.rig);
    question.sensor = sensorOf(*question.rig);
    if (!job.distance_m) {
      question.distance_m = PlanView(*question.rig).crossingDistance();
    }
  }
  if (!question.distance_m) {
    throw InputError("--distance-m: expected the working distance in metres" +
                     std::string(job.rig.empty() ? "" : ", since the rig's axes do not cross"));
  }
  if (!job.box.empty()) {
    const auto size = product(job.box, 3, 100.0, "--box",
                              "WIDTHxHEIGHTxDEPTH of the workspace in metres, as in 0.6x0.4x0.3");
    question.box = WorkBox{{0.0, 0.0, *question.distance_m}, {size[0], size[1], size[2]}};
    if (!(size[2] < 2.0 * *question.distance_m)) {
      throw InputError(
          "--box: a workspace this deep reaches the cameras, expected a depth below "
          "twice --distance-m");
    }
  }
  return question;
}

PlanAdvice advise(const PlanJob& job, const Question& question) {
  PlanWish wish;
  wish.sensor = question.sensor;
  wish.box = question.box.value_or(WorkBox{{0.0, 0.0, *question.distance_m}, {0.0, 0.0, 0.0}});
  wish.sigma_px = job.noise_px;
  wish.wanted_m = 1e-3 * *job.wanted_mm;
  wish.max_baseline_m = job.max_baseline_m.value_or(*question.distance_m);
  const Outcome<PlanAdvice> advice = adviseSetup(wish);
  if (!advice) {
    throw InputError("--box: " + advice.reason() +
                     ": expected a smaller workspace, a larger distance or a shorter lens");
  }
  return *advice;
}

/// The rig to draw: the file's, else what is asked for, else what the search found.
PlanView viewOf(const PlanJob& job, const Question& question,
                const std::optional<PlanAdvice>& advice) {
  if (question.rig) {
    return PlanView(*question.rig);
  }
  if (!job.baseline_m && advice) {
    return PlanView(plannedRig(advice->shortest.value_or(advice->finest).setup));
  }
  if (!job.baseline_m) {
    throw InputError(
        "--baseline-m: expected the baseline in metres, or --wanted-mm to look for it");
  }
  const double vergence = job.vergence_deg
                              ? *job.vergence_deg * kDegree
                              : crossingVergence(*job.baseline_m, *question.distance_m);
  return PlanView(plannedRig({question.sensor, *job.baseline_m, vergence}));
}

/// Some of the map's points, spread over it.
std::vector<Eigen::Vector3d> pointsToCheck(const PlanMap& map) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < map.across.size();
       i += std::max<std::size_t>(1, map.across.size() / 40)) {
    points.push_back(map.across[i].point_m);
  }
  for (const PlanPoint& point : map.along) {
    points.push_back(point.point_m);
  }
  return points;
}

PlanAnswer answerFor(const PlanJob& job, const Question& question) {
  PlanAnswer result;
  if (job.wanted_mm) {
    result.advice = advise(job, question);
  }
  result.view = viewOf(job, question, result.advice);
  result.map = mapPlan(*result.view, job.noise_px, *question.distance_m,
                       1e-3 * job.tag_mm.value_or(0.0), question.box);
  if (result.map.field.empty() || !result.map.middle) {
    throw InputError(
        "--distance-m: the cameras see nothing in common there, expected a distance "
        "near which their views meet");
  }
  if (job.check > 0) {
    result.checked =
        checkPlan(*result.view, pointsToCheck(result.map), job.noise_px, job.check, kCheckSeed);
  }
  return result;
}

}  // namespace

PlanAnswer answerPlan(const PlanJob& job) { return answerFor(job, readJob(job)); }

}  // namespace ringhook

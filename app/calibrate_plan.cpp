#include "app/calibrate_plan.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/calibrate_plan_job.h"
#include "app/options.h"
#include "core/angle.h"
#include "core/atomic_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

nlohmann::json choiceJson(const PlanChoice& c) {
  return {{"baseline_m", c.setup.baseline_m},
          {"vergence_deg", c.setup.vergence_rad / kDegree},
          {"worst_mm", 1e3 * c.error.worst_m},
          {"rms_mm", 1e3 * c.error.rms_m},
          {"room_px", c.error.room_px}};
}

nlohmann::json pointJson(const PlanPoint& p) {
  return {{"x", 1e3 * p.sigma_m.x()},
          {"y", 1e3 * p.sigma_m.y()},
          {"z", 1e3 * p.sigma_m.z()},
          {"all", 1e3 * p.total_m}};
}

void addMap(const PlanMap& map, nlohmann::json& result) {
  result["sigma_mm"] = pointJson(*map.middle);
  result["field"] = {{"width_m", map.field.high_m.x() - map.field.low_m.x()},
                     {"height_m", map.field.high_m.y() - map.field.low_m.y()},
                     {"area_m2", map.field.area_m2}};
  for (std::size_t i = 0; i < map.along.size(); ++i) {
    const StereoField& field = map.fields[i];
    result["distances"].push_back({{"distance_m", field.distance_m},
                                   {"width_m", field.high_m.x() - field.low_m.x()},
                                   {"height_m", field.high_m.y() - field.low_m.y()},
                                   {"sigma_mm", pointJson(map.along[i])}});
  }
  if (map.tag) {
    result["tag"] = {{"position_mm", 1e3 * map.tag->position_m},
                     {"rotation_deg", map.tag->rotation_rad / kDegree}};
  }
  if (map.box_error && map.box_error->room_px >= 0.0) {
    result["box"] = {{"worst_mm", 1e3 * map.box_error->worst_m},
                     {"rms_mm", 1e3 * map.box_error->rms_m},
                     {"room_px", map.box_error->room_px}};
  }
}

nlohmann::json summary(const PlanJob& job, const PlanAnswer& a) {
  const PlanView& view = *a.view;
  nlohmann::json result{{"baseline_m", view.baseline_m},
                        {"vergence_deg", view.vergence_rad / kDegree},
                        {"focal_px", view.rig.left.K(0, 0)},
                        {"distance_m", a.map.distance_m},
                        {"noise_px", job.noise_px}};
  addMap(a.map, result);
  if (a.advice) {
    result["wanted_mm"] = *job.wanted_mm;
    result["reached"] = a.advice->shortest.has_value();
    result["finest"] = choiceJson(a.advice->finest);
    if (a.advice->shortest) {
      result["shortest"] = choiceJson(*a.advice->shortest);
    }
  }
  if (!a.checked.empty()) {
    result["check"] = {{"points", a.checked.size()},
                       {"draws", job.check},
                       {"largest_disagreement_percent", 100.0 * largestDisagreement(a.checked)}};
  }
  return result;
}

void printDistances(const PlanMap& map) {
  std::printf("%10s %9s %9s %10s %10s %10s %10s\n", "distance_m", "width_m", "height_m",
              "sigma_x_mm", "sigma_y_mm", "sigma_z_mm", "sigma_mm");
  for (std::size_t i = 0; i < map.along.size(); i += 4) {
    const StereoField& f = map.fields[i];
    const PlanPoint& p = map.along[i];
    std::printf("%10.3f %9.3f %9.3f %10.4f %10.4f %10.4f %10.4f\n", f.distance_m,
                f.high_m.x() - f.low_m.x(), f.high_m.y() - f.low_m.y(), 1e3 * p.sigma_m.x(),
                1e3 * p.sigma_m.y(), 1e3 * p.sigma_m.z(), 1e3 * p.total_m);
  }
}

void printChoice(const char* what, const PlanChoice& c) {
  std::printf("%-25s baseline %.3f m, vergence %.2f deg: at worst %.4f mm, %.0f px to the border\n",
              what, c.setup.baseline_m, c.setup.vergence_rad / kDegree, 1e3 * c.error.worst_m,
              c.error.room_px);
}

void printAnswer(const PlanJob& job, const PlanAnswer& a) {
  const PlanMap& map = a.map;
  printDistances(map);
  std::printf("\n%-25s baseline %.3f m, vergence %.2f deg (%.2f deg each camera), f %.0f px\n",
              "rig", a.view->baseline_m, a.view->vergence_rad / kDegree,
              0.5 * a.view->vergence_rad / kDegree, a.view->rig.left.K(0, 0));
  std::printf("%-25s %.3f m x %.3f m (%.3f m2)\n", "both cameras see there",
              map.field.high_m.x() - map.field.low_m.x(),
              map.field.high_m.y() - map.field.low_m.y(), map.field.area_m2);
  std::printf("%-25s %.4f mm at %.3f m (x %.4f, y %.4f, z %.4f)\n", "error in the middle",
              1e3 * map.middle->total_m, map.distance_m, 1e3 * map.middle->sigma_m.x(),
              1e3 * map.middle->sigma_m.y(), 1e3 * map.middle->sigma_m.z());
  if (map.tag) {
    std::printf("%-25s %.4f mm, %.4f deg\n", "a tag there", 1e3 * map.tag->position_m,
                map.tag->rotation_rad / kDegree);
  }
  if (map.box_error && map.box_error->room_px >= 0.0) {
    std::printf("%-25s at worst %.4f mm, RMS %.4f mm, %.0f px to the border\n", "in the workspace",
                1e3 * map.box_error->worst_m, 1e3 * map.box_error->rms_m, map.box_error->room_px);
  } else if (map.box_error) {
    std::printf("%-25s not wholly in both views\n", "the workspace is");
  }
  if (a.advice && a.advice->shortest) {
    printChoice("shortest that will do", *a.advice->shortest);
  }
  if (a.advice) {
    printChoice("finest of all", a.advice->finest);
  }
  if (!a.checked.empty()) {
    std::printf("%-25s %zu points, %d measurements each: %.1f %% apart at most\n",
                "against measurements", a.checked.size(), job.check,
                100.0 * largestDisagreement(a.checked));
  }
}

/// A rig that exists and does not keep what is wanted, or a wish that no baseline fulfils.
void requireWanted(const PlanJob& job, const PlanAnswer& a) {
  char text[300];
  if (a.advice && !a.advice->shortest) {
    std::snprintf(text, sizeof(text),
                  "%g mm is out of reach: %.4f mm at worst with the best baseline of %.3f m; come "
                  "closer, or take a longer lens, finer corners or a smaller workspace",
                  *job.wanted_mm, 1e3 * a.advice->finest.error.worst_m,
                  a.advice->finest.setup.baseline_m);
    throw Error(text);
  }
}

void plan(const PlanJob& job) {
  JsonFile json(job.json);
  const PlanAnswer result = answerPlan(job);
  const std::string figures = summary(job, result).dump(2) + "\n";
  if (!job.out.empty()) {
    const std::filesystem::path folder = job.out;
    writeFileAtomically(folder / "plan.csv", planTable(result.map));
    writeFileAtomically(folder / "plan.svg", planPicture(*result.view, result.map));
    writeFileAtomically(folder / "summary.json", figures);
  }
  json.commit(figures);
  printAnswer(job, result);
  if (!job.out.empty()) {
    std::printf("wrote %s/plan.csv, plan.svg and summary.json\n", job.out.c_str());
  }
  requireWanted(job, result);
}

void addSensorOptions(CLI::App& command, PlanJob& job) {
  command.add_option("--sensor", job.sensor, "pixels of one camera")
      ->type_name("WxH")
      ->capture_default_str();
  command.add_option("--focal-px", job.focal_px, "focal length in pixels");
  command.add_option("--lens-mm", job.lens_mm, "or the lens, with --pixel-um");
  command.add_option("--pixel-um", job.pixel_um, "pixel pitch in micrometres");
  command.add_option("--rig", job.rig, "an existing rig instead of sensor, lens and baseline")
      ->type_name("FILE");
}

void addPlaceOptions(CLI::App& command, PlanJob& job) {
  command.add_option("--baseline-m", job.baseline_m, "between the cameras");
  command.add_option("--vergence-deg", job.vergence_deg,
                     "between the optical axes; default: they cross at the working distance");
  command.add_option("--distance-m", job.distance_m,
                     "working distance, from the middle of the baseline");
  command.add_option("--noise-px", job.noise_px, "corner noise per pixel axis")
      ->capture_default_str();
  command.add_option("--tag-mm", job.tag_mm, "side of a tag whose pose is of interest, too");
  command.add_option("--box", job.box, "workspace about the working distance, in metres")
      ->type_name("WxHxD");
}

}  // namespace

void addCalibratePlan(CLI::App& calibrate) {
  auto job = std::make_shared<PlanJob>();
  CLI::App& command = addCommand(
      calibrate, "plan",
      "Predict how accurately a stereo rig will measure, or find the rig for an accuracy.",
      "Examples:\n"
      "  ringhook calibrate plan --focal-px 2500 --baseline-m 0.4 --distance-m 1.3 --out plan\n"
      "  ringhook calibrate plan --lens-mm 12 --pixel-um 5.5 --distance-m 1.3 \\\n"
      "    --box 0.6x0.4x0.3 --wanted-mm 0.3 --max-baseline-m 0.8\n"
      "Exit code 1: the wanted accuracy is out of reach. How to read it: doc/stereo-planning.md");
  addSensorOptions(command, *job);
  addPlaceOptions(command, *job);
  command.add_option(
      "--wanted-mm", job->wanted_mm,
      "look for the shortest baseline whose error is nowhere larger in the workspace");
  command.add_option("--max-baseline-m", job->max_baseline_m,
                     "longest baseline allowed; default: the working distance");
  command.add_option("--check", job->check, "measure points so many times with simulated noise")
      ->check(CLI::Range(0, 100000));
  command.add_option("--out", job->out, "write plan.csv, plan.svg and summary.json there")
      ->type_name("DIR");
  addJsonOption(command, job->json, "write the figures to this file");
  command.callback([job] { plan(*job); });
}

}  // namespace ringhook

#include "app/robot_report.h"

#include <cstdio>

#include "core/angle.h"

namespace ringhook {
namespace {

nlohmann::json listOf(const Eigen::VectorXd& v, double unit = 1.0) {
  const Eigen::VectorXd scaled = v / unit;
  return std::vector<double>(scaled.begin(), scaled.end());
}

nlohmann::json quaternionOf(const Pose& pose) {
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0.0) {
    q.coeffs() = -q.coeffs();
  }
  return {q.x(), q.y(), q.z(), q.w()};
}

nlohmann::json rejectedOf(const std::vector<RejectedPair>& rejected) {
  nlohmann::json list = nlohmann::json::array();
  for (const RejectedPair& r : rejected) {
    list.push_back({{"name", r.name}, {"index", r.index}, {"reason", r.reason}});
  }
  return list;
}

nlohmann::json formsOf(const HandEyeResult& r) {
  nlohmann::json list = nlohmann::json::array();
  for (const ClosedFormResult& form : r.closed_forms) {
    nlohmann::json line{{"name", form.name}, {"solved", form.solved}};
    if (form.solved) {
      line["residual_mm"] = 1e3 * form.rms.translation_m;
      line["residual_deg"] = form.rms.rotation_rad / kDegree;
      line["from_result_mm"] = 1e3 * form.from_result_m;
    }
    list.push_back(line);
  }
  return list;
}

nlohmann::json weighingsOf(const HandEyeResult& r) {
  nlohmann::json list = nlohmann::json::array();
  for (const WeighedFit& fit : r.weighings) {
    list.push_back({{"name", toString(fit.weights)},
                    {"heldout_mm", 1e3 * fit.left_out.rms.translation_m},
                    {"heldout_deg", fit.left_out.rms.rotation_rad / kDegree}});
  }
  return list;
}

void printPose(const char* name, const Pose& pose) {
  const Eigen::Vector3d t = pose.translation();
  const Eigen::Vector3d w = thetaU(pose.linear());
  const nlohmann::json q = quaternionOf(pose);
  std::printf("%-6s position %.6f %.6f %.6f m, quaternion x y z w %.6f %.6f %.6f %.6f\n", name,
              t.x(), t.y(), t.z(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>(),
              q[3].get<double>());
  std::printf("       rotation vector %.6f %.6f %.6f rad\n", w.x(), w.y(), w.z());
}

void printRejected(const std::vector<RejectedPair>& rejected) {
  for (const RejectedPair& r : rejected) {
    std::printf("%-24s rejected: %s\n", r.name.c_str(), r.reason.c_str());
  }
}

void printForms(const HandEyeResult& r) {
  std::printf("\n%-12s %12s %12s %24s\n", "closed form", "residual_mm", "residual_deg",
              "camera from result_mm");
  for (const ClosedFormResult& form : r.closed_forms) {
    if (form.solved) {
      std::printf("%-12s %12.3f %12.3f %24.3f\n", form.name.c_str(), 1e3 * form.rms.translation_m,
                  form.rms.rotation_rad / kDegree, 1e3 * form.from_result_m);
    } else {
      std::printf("%-12s no answer\n", form.name.c_str());
    }
  }
}

void printWeights(const HandEyeResult& r) {
  std::printf("weights     %s", toString(r.weights).c_str());
  if (weightsRefuted(r)) {
    std::printf(": pairs left out are predicted clearly better by it");
  }
  std::printf("\n");
  for (const WeighedFit& fit : r.weighings) {
    std::printf("            held out %.3f mm, %.3f degrees: %s\n",
                1e3 * fit.left_out.rms.translation_m, fit.left_out.rms.rotation_rad / kDegree,
                toString(fit.weights).c_str());
  }
}

}  // namespace

nlohmann::json summaryOf(const HandEyeResult& r) {
  const bool to_hand = r.setup == EyeSetup::kEyeToHand;
  nlohmann::json json{{"setup", to_hand ? "eye-to-hand" : "eye-in-hand"},
                      {"pose", to_hand ? "fMc1" : "eMc1"},
                      {"translation_m", listOf(r.pose.camera.translation())},
                      {"quaternion_xyzw", quaternionOf(r.pose.camera)},
                      {"target_pose", to_hand ? "eMt" : "fMt"},
                      {"target_translation_m", listOf(r.pose.target.translation())},
                      {"target_quaternion_xyzw", quaternionOf(r.pose.target)},
                      {"residual_mm", 1e3 * r.residual.translation_m},
                      {"residual_deg", r.residual.rotation_rad / kDegree},
                      {"heldout_mm", 1e3 * r.heldout.translation_m},
                      {"heldout_deg", r.heldout.rotation_rad / kDegree},
                      {"solver", r.solver},
                      {"weights", toString(r.weights)},
                      {"weighings", weighingsOf(r)},
                      {"closed_forms", formsOf(r)},
                      {"pairs_used", r.used.size() - r.rejected.size()},
                      {"rejected_pairs", rejectedOf(r.rejected)},
                      {"better_convention", r.better_convention.words},
                      {"advice", r.advice},
                      {"verdict", toString(r.verdict.grade)},
                      {"verdict_sentence", r.verdict.sentence}};
  if (r.sigmas) {
    json["camera_sigma_mm"] = 1e3 * r.sigmas->camera_m;
    json["camera_sigma_deg"] = r.sigmas->camera_rad / kDegree;
    json["target_sigma_mm"] = 1e3 * r.sigmas->target_m;
    json["target_sigma_deg"] = r.sigmas->target_rad / kDegree;
    json["workspace_sigma_mm"] = 1e3 * r.sigmas->workspace_m;
  }
  return json;
}

nlohmann::json summaryOf(const PlateCalibration& c) {
  nlohmann::json json = summaryOf(c.result);
  for (const auto& blind : rejectedOf(c.blind)) {
    json["rejected_pairs"].push_back(blind);
  }
  json["corner_sigma_px"] = c.corner_sigma_px;
  json["rms_px"] = c.rms_px;
  json["arm_rms_px"] = c.arm_rms_px;
  if (c.zeros) {
    json["joint_zeros_deg"] = listOf(c.zeros->zero_rad, kDegree);
    json["joint_zeros_sigma_deg"] = listOf(c.zeros->sigma_rad, kDegree);
    json["heldout_with_joint_zeros_mm"] = 1e3 * c.zeros->heldout.translation_m;
    json["heldout_without_joint_zeros_mm"] = 1e3 * c.plain_heldout.translation_m;
    json["joint_zeros_used"] = c.zeros_used;
  }
  return json;
}

nlohmann::json summaryOf(const PointFit& fit, const std::vector<PointPair>& points) {
  return {{"setup", "eye-to-hand"},
          {"pose", "fMc1"},
          {"translation_m", listOf(fit.fMc1.translation())},
          {"quaternion_xyzw", quaternionOf(fit.fMc1)},
          {"residual_mm", 1e3 * fit.residual_m},
          {"residual_axes_mm", listOf(fit.axis_rms_m, 1e-3)},
          {"heldout_mm", 1e3 * fit.heldout_m},
          {"solver", "rigid fit of points"},
          {"pairs_used", points.size() - fit.rejected.size()},
          {"rejected_pairs", rejectedOf(fit.rejected)},
          {"scale", fit.scale},
          {"camera_sigma_mm", 1e3 * fit.camera_sigma_m},
          {"camera_sigma_deg", fit.camera_sigma_rad / kDegree},
          {"workspace_sigma_mm", 1e3 * fit.workspace_sigma_m},
          {"verdict", toString(fit.verdict.grade)},
          {"verdict_sentence", fit.verdict.sentence}};
}

void printResult(const HandEyeResult& r, const std::vector<PosePair>& pairs) {
  const bool to_hand = r.setup == EyeSetup::kEyeToHand;
  std::printf("%-24s %10s %10s\n", "pair", "error_mm", "error_deg");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::printf("%-24s %10.3f %10.3f%s\n", pairs[i].name.c_str(), 1e3 * r.errors[i].translation_m,
                r.errors[i].rotation_rad / kDegree, r.used[i] ? "" : "  rejected");
  }
  printRejected(r.rejected);
  printForms(r);
  std::printf("\n");
  printPose(to_hand ? "fMc1" : "eMc1", r.pose.camera);
  printPose(to_hand ? "eMt" : "fMt", r.pose.target);
  std::printf("pairs used  %zu, rejected %zu; started from %s\n", r.used.size() - r.rejected.size(),
              r.rejected.size(), r.solver.c_str());
  printWeights(r);
  std::printf("residual    %.3f mm, %.3f degrees (RMS length and angle)\n",
              1e3 * r.residual.translation_m, r.residual.rotation_rad / kDegree);
  if (r.sigmas) {
    std::printf("held out    %.3f mm, %.3f degrees (each pair predicted without itself)\n",
                1e3 * r.heldout.translation_m, r.heldout.rotation_rad / kDegree);
    std::printf(
        "sigma       camera %.3f mm %.4f degrees, target %.3f mm %.4f degrees, "
        "workspace %.3f mm\n",
        1e3 * r.sigmas->camera_m, r.sigmas->camera_rad / kDegree, 1e3 * r.sigmas->target_m,
        r.sigmas->target_rad / kDegree, 1e3 * r.sigmas->workspace_m);
  }
  std::printf("verdict: %s: %s\n", toString(r.verdict.grade).c_str(), r.verdict.sentence.c_str());
}

void printResult(const PlateCalibration& c) {
  printRejected(c.blind);
  if (c.rms_px > 0.0) {
    std::printf(
        "corners     %.3f px per axis with each view's own pose, %.3f px under the result "
        "(%.3f px if the arm were perfect)\n",
        c.corner_sigma_px, c.rms_px, c.arm_rms_px);
  }
  printResult(c.result, c.pairs);
  if (c.zeros) {
    std::printf("joint zeros (true minus reported, deg):");
    for (int j = 0; j < c.zeros->zero_rad.size(); ++j) {
      std::printf(" %.4f +- %.4f", c.zeros->zero_rad(j) / kDegree, c.zeros->sigma_rad(j) / kDegree);
    }
    std::printf("\n  held out %.3f mm with them, %.3f mm without: %s\n",
                1e3 * c.zeros->heldout.translation_m, 1e3 * c.plain_heldout.translation_m,
                c.zeros_used ? "they are used, and belong to fMc1" : "they are not used");
  }
}

void printResult(const PointFit& fit, const std::vector<PointPair>& points) {
  std::printf("%-24s %10s\n", "point", "error_mm");
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::printf("%-24s %10.3f%s\n", points[i].name.c_str(), 1e3 * fit.errors_m[i],
                fit.used[i] ? "" : "  rejected");
  }
  printRejected(fit.rejected);
  std::printf("\n");
  printPose("fMc1", fit.fMc1);
  std::printf("points used %zu, rejected %zu\n", points.size() - fit.rejected.size(),
              fit.rejected.size());
  std::printf("residual    %.3f mm (RMS distance); along the camera's x, y, z: %.3f %.3f %.3f mm\n",
              1e3 * fit.residual_m, 1e3 * fit.axis_rms_m.x(), 1e3 * fit.axis_rms_m.y(),
              1e3 * fit.axis_rms_m.z());
  std::printf("held out    %.3f mm (each point predicted without itself)\n", 1e3 * fit.heldout_m);
  std::printf("sigma       camera %.3f mm %.4f degrees, workspace %.3f mm\n",
              1e3 * fit.camera_sigma_m, fit.camera_sigma_rad / kDegree,
              1e3 * fit.workspace_sigma_m);
  std::printf("verdict: %s: %s\n", toString(fit.verdict.grade).c_str(),
              fit.verdict.sentence.c_str());
}

}  // namespace ringhook

#include "app/calibrate_exchange.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/calibrate_job.h"
#include "app/options.h"
#include "calib/exchange/exchange.h"
#include "core/atomic_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

struct ImportJob {
  std::string format;
  std::vector<std::string> files;
  std::string size;
  std::string unit;
  std::string out;
  std::string json;
};

struct ExportJob {
  std::string format;
  std::string rig;
  std::string out;
  double accepted_px = 0.01;
  std::string json;
};

ImportHints hintsOf(const ImportJob& job) {
  ImportHints hints;
  if (!job.size.empty()) {
    char rest = '\0';
    if (std::sscanf(job.size.c_str(), "%5dx%5d%c", &hints.width, &hints.height, &rest) != 2 ||
        hints.width <= 0 || hints.height <= 0) {
      throw InputError("--size: '" + job.size + "' is not WIDTHxHEIGHT in pixels, as in 640x480");
    }
  }
  if (job.unit == "m" || job.unit == "cm" || job.unit == "mm") {
    hints.unit_m = job.unit == "m" ? 1.0 : job.unit == "cm" ? 1e-2 : 1e-3;
  } else if (!job.unit.empty()) {
    throw InputError("--unit: expected m, cm or mm, got '" + job.unit + "'");
  }
  return hints;
}

void importFiles(const ImportJob& job) {
  const RigFormat format = rigFormat(job.format);
  const ImportHints hints = hintsOf(job);
  JsonFile json(job.json);
  StereoRig rig = importRig(format, {job.files.begin(), job.files.end()}, hints);
  rig.date = utcDate();
  rig.tool_version = RINGHOOK_VERSION;
  saveRig(job.out, rig);
  json.commit(nlohmann::json{{"format", job.format},
                             {"cameras", rig.right ? 2 : 1},
                             {"image_width_px", rig.left.width},
                             {"image_height_px", rig.left.height},
                             {"baseline_m", baseline(rig)}}
                  .dump(2) +
              "\n");
  std::printf("%s, %d x %d px", rig.right ? "two cameras" : "one camera", rig.left.width,
              rig.left.height);
  if (rig.right) {
    std::printf(", baseline %.3f mm", 1e3 * baseline(rig));
  }
  std::printf("\nwrote %s; how good it is, these files do not tell: see calibrate verify\n",
              job.out.c_str());
}

/// Nothing is dropped in silence: a loss has to be accepted.
void requireAccepted(const ExportJob& job, const RigExport& exported) {
  if (exported.loss_px <= job.accepted_px) {
    return;
  }
  char text[300];
  std::snprintf(
      text, sizeof(text),
      "--format %s: %s by up to %.2g px, which is more than --accept-px %.2g; nothing was "
      "written",
      job.format.c_str(), "its lens model cannot follow this lens and would be wrong",
      exported.loss_px, job.accepted_px);
  throw InputError(text);
}

void exportFiles(const ExportJob& job) {
  const RigFormat format = rigFormat(job.format);
  JsonFile json(job.json);
  const RigExport exported = exportRig(format, loadRig(job.rig));
  requireAccepted(job, exported);
  nlohmann::json names = nlohmann::json::array();
  for (const ExportedFile& file : exported.files) {
    const std::filesystem::path path = std::filesystem::path(job.out) / file.name;
    writeFileAtomically(path, file.text);
    names.push_back(path.string());
    std::printf("wrote %s\n", path.c_str());
  }
  for (const std::string& note : exported.notes) {
    std::printf("note: %s\n", note.c_str());
  }
  std::printf("largest difference of the lens: %.2g px\n", exported.loss_px);
  json.commit(nlohmann::json{{"format", job.format},
                             {"files", names},
                             {"largest_difference_px", exported.loss_px},
                             {"notes", exported.notes}}
                  .dump(2) +
              "\n");
}

void addImport(CLI::App& calibrate) {
  auto job = std::make_shared<ImportJob>();
  CLI::App& command = addCommand(
      calibrate, "import", "Make rig.yaml from another program's calibration.",
      "Examples:\n"
      "  ringhook calibrate import --format opencv intrinsics.yml extrinsics.yml --size 640x480 "
      "\\\n"
      "    --unit mm --out rig.yaml\n"
      "  ringhook calibrate import --format visp left.xml right.xml c2Mc1.txt --out rig.yaml\n"
      "  ringhook calibrate import --format ros left.yaml right.yaml --out rig.yaml\n"
      "  ringhook calibrate import --format kalibr camchain.yaml --out rig.yaml");
  command.add_option("--format", job->format, "opencv, visp, ros or kalibr")->required();
  command.add_option("files", job->files, "in the order of the examples, left camera first")
      ->required()
      ->expected(1, 3);
  command.add_option("--size", job->size, "of the images, where the files do not tell")
      ->type_name("WxH");
  command.add_option("--unit", job->unit, "of lengths in the files: m (default), cm or mm");
  command.add_option("--out", job->out, "rig file to write (rig.yaml)")->required();
  addJsonOption(command, job->json, "write what was read to this file");
  command.callback([job] { importFiles(*job); });
}

void addExport(CLI::App& calibrate) {
  auto job = std::make_shared<ExportJob>();
  CLI::App& command = addCommand(
      calibrate, "export", "Write a rig for another program.",
      "Example:\n"
      "  ringhook calibrate export --rig rig.yaml --format ros --out camera_info\n"
      "opencv: intrinsics.yml extrinsics.yml; visp: left.xml right.xml c2Mc1.txt;\n"
      "ros: left.yaml right.yaml; kalibr: camchain.yaml. A lens that the format cannot hold is\n"
      "refused with its error in pixels, unless --accept-px allows that much.");
  command.add_option("--rig", job->rig, "rig file to tell")->required()->type_name("FILE");
  command.add_option("--format", job->format, "opencv, visp, ros or kalibr")->required();
  command.add_option("--out", job->out, "folder to write to")->required()->type_name("DIR");
  command.add_option("--accept-px", job->accepted_px, "largest lens error that is acceptable")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  addJsonOption(command, job->json, "write the names and the loss to this file");
  command.callback([job] { exportFiles(*job); });
}

}  // namespace

void addCalibrateExchange(CLI::App& calibrate) {
  addImport(calibrate);
  addExport(calibrate);
}

}  // namespace ringhook

#include "calib/wizard/session.h"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/file_kind.h"
#include "core/yaml_fields.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr std::array kSteps = {"stereo", "robot", "time"};

/// For YAML: in double quotes, with what has a meaning there escaped.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump();  // a JSON string is a YAML string
}

}  // namespace

std::optional<WizardAnswers> Session::answers() const {
  const fs::path path = file("wizard.yaml");
  if (!isFile(path)) {
    return std::nullopt;
  }
  YamlFields fields = YamlFields::open(path);
  WizardAnswers answers;
  answers.cell = fields.text("cell");
  if (fields.has("images")) {
    answers.images = fields.text("images");
  }
  answers.board = fields.text("board");
  answers.seed = static_cast<std::uint64_t>(fields.number("seed", 0.0, 9e15));
  fields.refuseUnknown();
  return answers;
}

void Session::keep(const WizardAnswers& answers) const {
  std::string text = "# Answers of a calibration session; delete the folder to begin anew.\n";
  text += "cell: " + quoted(answers.cell.string()) + "\n";
  if (!answers.images.empty()) {
    text += "images: " + quoted(answers.images.string()) + "\n";
  }
  text += "board: " + quoted(answers.board) + "\n";
  text += "seed: " + std::to_string(answers.seed) + "\n";
  writeFileAtomically(file("wizard.yaml"), text);
}

std::optional<StereoRig> Session::rig(const std::string& step) const {
  const fs::path path = file("rig-" + step + ".yaml");
  return isFile(path) ? std::optional(loadRig(path)) : std::nullopt;
}

void Session::keepRig(const std::string& step, const StereoRig& rig) const {
  saveRig(file("rig-" + step + ".yaml"), rig);
}

void Session::forgetFrom(const std::string& step) const {
  bool from_here = false;
  for (const char* name : kSteps) {
    from_here = from_here || step == name;
    if (from_here) {
      fs::remove(file(std::string("rig-") + name + ".yaml"));
    }
  }
}

void Session::report(const std::string& step, const std::string& json) const {
  const fs::path path = file("report.json");
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  if (isFile(path)) {
    std::ifstream stream(path);
    const auto before = nlohmann::ordered_json::parse(stream, nullptr, false);
    if (before.is_object()) {
      all = before;
    }
  }
  all[step] = nlohmann::ordered_json::parse(json);
  writeFileAtomically(path, all.dump(2) + "\n");
}

}  // namespace ringhook

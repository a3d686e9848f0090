#include <yaml-cpp/yaml.h>

#include <array>
#include <cctype>
#include <fstream>

#include "calib/wizard/steps.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// Lower case letters and digits with single hyphens between.
std::string slugOf(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) {
      slug += static_cast<char>(std::tolower(letter));
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  while (!slug.empty() && slug.back() == '-') {
    slug.pop_back();
  }
  return slug.empty() ? "cell" : slug;
}

/// The same file, named from another folder.
void movePath(YAML::Node node, const fs::path& from, const fs::path& to) {
  if (node && node.IsScalar()) {
    node = fs::proximate(fs::absolute(from / node.as<std::string>()), fs::absolute(to)).string();
  }
}

/// The cell file with its paths seen from `folder` and the rig beside it.
std::string cellText(const fs::path& file, const fs::path& folder, const std::string& date) {
  try {
    YAML::Node cell = YAML::LoadFile(file.string());
    const fs::path from = file.parent_path();
    movePath(cell["devices"]["scenario"], from, folder);
    movePath(cell["hook"]["plate"], from, folder);
    movePath(cell["hook"]["model"], from, folder);
    movePath(cell["arm"]["gripper_plate"], from, folder);
    cell["rig"] = "rig.yaml";
    YAML::Emitter text;
    text << cell;
    return "# Set up by ringhook calibrate wizard, " + date + ", from " + file.filename().string() +
           "\n" + text.c_str() + "\n";
  } catch (const YAML::Exception& e) {
    throw InputError(file.string() + ": expected a cell file: " + e.msg);
  }
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A folder of this name that does not exist yet.
fs::path freeFolder(const fs::path& wanted) {
  fs::path folder = wanted;
  for (int number = 2; fs::exists(folder); ++number) {
    folder = wanted.string() + "-" + std::to_string(number);
  }
  return folder;
}

}  // namespace

void finishStep(WizardContext& context, const fs::path& accepted, const std::string& date,
                const std::string& version) {
  const Session& session = context.session;
  context.console.say("\nStep 5 of 5: the cell file.");
  StereoRig rig = session.rig("time").value();
  rig.date = date;
  rig.tool_version = version;
  saveRig(session.file("rig.yaml"), rig);
  writeFileAtomically(session.file("cell.yaml"),
                      cellText(context.cell.file, session.folder(), date));
  (void)loadCellConfig(session.file("cell.yaml"));  // what servo will say of it
  const fs::path kept =
      freeFolder(accepted / (slugOf(context.cell.name) + "-" + date.substr(0, 10)));
  saveRig(kept / "rig.yaml", rig);
  writeFileAtomically(kept / "report.json", contents(session.file("report.json")));
  context.console.say("  wrote " + session.file("cell.yaml").string() +
                      " and rig.yaml beside it\n" + "  kept with its evidence: " + kept.string() +
                      "\n" + "The cell is set up. Try it:\n  ringhook servo --cell " +
                      session.file("cell.yaml").string());
}

}  // namespace ringhook

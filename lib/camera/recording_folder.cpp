#include "camera/recording_folder.h"

#include <yaml-cpp/yaml.h>

#include <regex>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

/// What a recording consists of, as paths relative to its folder; `target` is its target's name.
bool belongsToRecording(const std::string& name, const std::string& target) {
  static const std::regex kParts(
      R"((sequence|rig)\.yaml|(frames|robot|truth)\.csv|left|right|truth|)"
      R"((left|right)/(\d{6,}|\.\d{6,}\.partial)\.(png|pgm)|)"
      R"(truth/(\.?(hooks|rings|arm|contacts)(\.partial)?\.csv|\.?cameras(\.partial)?\.yaml))");
  return (!target.empty() && name == target) || std::regex_match(name, kParts);
}

/// Name of the target that a recording tells; empty if it tells none.
std::string targetOf(const fs::path& sequence_yaml) {
  try {
    const YAML::Node target = YAML::LoadFile(sequence_yaml.string())["target"];
    return target && target.IsScalar() ? target.Scalar() : std::string();
  } catch (const YAML::Exception&) {
    return {};
  }
}

std::string inMegabytes(double bytes) {
  return std::to_string(static_cast<std::uint64_t>(1e-6 * bytes)) + " MB";
}

/// The folder, or the nearest one above it that exists.
fs::path existingPart(const fs::path& folder) {
  std::error_code failed;
  fs::path part = fs::absolute(folder, failed);
  while (!part.empty() && !isFolder(part) && part != part.root_path()) {
    part = part.parent_path();
  }
  return part;
}

}  // namespace

void checkRecordingFolder(const fs::path& folder, bool overwrite) {
  std::error_code failed;
  if (!fs::exists(folder, failed)) {
    return;
  }
  if (!isFolder(folder)) {
    throw InputError("--out " + folder.string() + ": expected a folder, and this is none");
  }
  if (fs::is_empty(folder, failed)) {
    return;
  }
  if (!overwrite) {
    throw InputError("--out " + folder.string() +
                     ": expected a new or empty folder, or --overwrite for an earlier recording");
  }
  if (!isFile(folder / "sequence.yaml")) {
    throw InputError("--overwrite: " + folder.string() + " holds no recording (sequence.yaml)");
  }
  const std::string target = targetOf(folder / "sequence.yaml");
  fs::recursive_directory_iterator entry(folder, failed);
  for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    if (!belongsToRecording(entry->path().lexically_relative(folder).generic_string(), target)) {
      throw InputError(
          "--overwrite: " + entry->path().string() +
          " does not belong to a recording; expected a folder with nothing else in it");
    }
  }
  if (failed) {
    throw InputError("--overwrite: cannot look into " + folder.string() + ": " + failed.message());
  }
}

void clearRecordingFolder(const fs::path& folder) {
  std::error_code failed;
  fs::directory_iterator entry(folder, failed);
  for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
    fs::remove_all(entry->path(), failed);
    if (failed) {
      throw Error("cannot remove " + entry->path().string() + ": " + failed.message());
    }
  }
}

void requireFreeSpace(const fs::path& folder, std::uint64_t bytes) {
  std::error_code failed;
  const fs::space_info space = fs::space(existingPart(folder), failed);
  if (!failed && space.available < bytes) {
    throw Error("the recording would take about " +
                inMegabytes(static_cast<double>(bytes) + 999999.0) + " and " +
                inMegabytes(static_cast<double>(space.available)) + " are free at " +
                folder.string() + ": expected a larger disk, fewer frames or smaller windows");
  }
}

}  // namespace ringhook

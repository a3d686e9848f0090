#include "core/atomic_file.h"

#include <utility>

#include "core/error.h"

namespace ringhook {
namespace fs = std::filesystem;

namespace {

/// "dir/name.ext" -> "dir/.name.partial.ext": the extension stays, since image and storage
/// libraries choose their format by it.
fs::path temporaryFor(const fs::path& path) {
  return path.parent_path() / ("." + path.stem().string() + ".partial" + path.extension().string());
}

/// How many folders of the path, from the lowest one upwards, do not exist yet.
int missingFolders(fs::path folder) {
  int missing = 0;
  std::error_code ignored;
  while (!folder.empty() && !fs::exists(folder, ignored)) {
    ++missing;
    folder = folder.parent_path();
  }
  return missing;
}

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), temporary_(temporaryFor(path_)) {
  std::error_code failed;
  if (path_.has_parent_path()) {
    made_folders_ = missingFolders(path_.parent_path());
    fs::create_directories(path_.parent_path(), failed);
  }
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throw InputError("cannot write " + path_.string() + ": its folder must exist and be writable");
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_) {
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    fs::path folder = path_.parent_path();
    for (; made_folders_ > 0; --made_folders_) {
      fs::remove(folder, ignored);  // does nothing to a folder in use
      folder = folder.parent_path();
    }
  }
}

void AtomicFile::commit() {
  stream_.close();
  std::error_code failed;
  if (stream_.fail()) {
    throw Error("writing " + path_.string() + " failed: is the disk full?");
  }
  fs::rename(temporary_, path_, failed);
  if (failed) {
    throw Error("writing " + path_.string() + " failed: " + failed.message());
  }
  committed_ = true;
}

void writeFileAtomically(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace ringhook

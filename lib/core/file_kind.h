#pragma once

/// \file
/// What a path names, for paths that users write: a name that no file system takes, or a folder
/// that may not be entered, is no file; nothing is thrown.

#include <filesystem>

namespace ringhook {

/// A regular file: no folder, no device.
inline bool isFile(const std::filesystem::path& path) {
  std::error_code failed;
  return std::filesystem::is_regular_file(path, failed);
}

inline bool isFolder(const std::filesystem::path& path) {
  std::error_code failed;
  return std::filesystem::is_directory(path, failed);
}

}  // namespace ringhook

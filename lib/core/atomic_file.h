#pragma once

/// \file
/// Output files that are either whole or absent: written to a temporary name beside the target
/// and renamed by commit(). Destroyed without commit() the temporary is removed, and the folders
/// that were made for it, so bad input or an exception leaves nothing behind and an older file
/// untouched.

#include <filesystem>
#include <fstream>
#include <string>

namespace ringhook {

class AtomicFile {
 public:
  /// Opens `path`.partial; makes parent folders. Throws InputError naming the path if it cannot.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Name to hand to a library that writes files itself; same folder and extension as the target.
  [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporary_; }
  /// Flushes, closes and renames. Throws Error naming the path (disk full, folder vanished).
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  int made_folders_ = 0;  ///< the lowest ones of the path
  bool committed_ = false;
};

/// Writes a whole small text at once, atomically.
void writeFileAtomically(const std::filesystem::path& path, const std::string& text);

}  // namespace ringhook

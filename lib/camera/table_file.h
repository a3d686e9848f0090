#pragma once

/// \file
/// A table that grows on disk row by row. Each row is handed to the system at once and in one
/// piece, so that a program that is killed leaves whole rows; a row that does not fit on a full
/// disk is taken back, so that the table stays as it was before.

#include <cstdint>
#include <filesystem>
#include <string>

namespace ringhook {

class TableFile {
 public:
  /// Makes or replaces the file; it begins with the line `header`. Throws Error if it cannot.
  TableFile(std::filesystem::path path, const std::string& header);
  ~TableFile();
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  /// Adds whole lines. Throws Error, with the file as it was, if the disk refuses.
  void append(const std::string& lines);
  /// Waits until the disk has it all; nothing may be added afterwards. Throws Error.
  void close();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;  ///< of the whole rows [bytes]
};

}  // namespace ringhook

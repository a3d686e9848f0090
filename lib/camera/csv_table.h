#pragma once

/// \file
/// A small comma-separated table with a header line, as all stored data here is: columns are
/// found by name, their order is free, unknown ones are ignored. Lines that are empty or begin
/// with '#' after the header are skipped; a leading '#' of the header itself is dropped (the
/// EuRoC/ASL habit). Every refusal is an InputError that names file, line and column.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ringhook {

class CsvTable {
 public:
  /// Reads a whole file. Throws InputError for a missing or empty file, or for a row whose number
  /// of fields differs from the header's.
  explicit CsvTable(const std::filesystem::path& path);

  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] bool has(const std::string& column) const;

  /// Index of a column for the calls below. Throws InputError listing the columns present.
  [[nodiscard]] std::size_t column(const std::string& name) const;

  /// Field as written, without surrounding blanks. Precondition: indices in range.
  [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const {
    return rows_[row].fields[column];
  }
  /// Field as a finite number. Throws InputError naming line and column otherwise.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// Field as a whole number. Throws InputError naming line and column otherwise.
  [[nodiscard]] long long integer(std::size_t row, std::size_t column) const;

  /// "FILE line N, column NAME", to begin a message with.
  [[nodiscard]] std::string where(std::size_t row, std::size_t column) const;

 private:
  struct Row {
    std::size_t line;  ///< in the file, counted from 1
    std::vector<std::string> fields;
  };
  std::filesystem::path path_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

/// A finite number written in full, as in "1.5e-3"; nothing if `text` is anything else.
[[nodiscard]] std::optional<double> numberFromText(const std::string& text);

/// The numbers of a line without separators but blanks. Throws InputError that begins with `where`
/// and names the word that is none.
[[nodiscard]] std::vector<double> numbersOfLine(const std::string& line, const std::string& where);

/// `text` cut at `separator`, blanks around each piece removed.
[[nodiscard]] std::vector<std::string> splitText(const std::string& text, char separator);

}  // namespace ringhook

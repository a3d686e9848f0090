#include "camera/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

std::string trimmed(const std::string& text) {
  const auto* blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> headerNames(const std::string& line) {
  std::string names = line;
  constexpr auto kByteOrderMark = "\xEF\xBB\xBF";
  if (names.starts_with(kByteOrderMark)) {
    names.erase(0, 3);
  }
  if (names.starts_with("#")) {
    names.erase(0, 1);
  }
  return splitText(names, ',');
}

}  // namespace

std::vector<std::string> splitText(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  std::istringstream stream(text);
  std::string piece;
  while (std::getline(stream, piece, separator)) {
    pieces.push_back(trimmed(piece));
  }
  if (!text.empty() && text.back() == separator) {
    pieces.emplace_back();
  }
  return pieces;
}

std::optional<double> numberFromText(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') {
    ++begin;
  }
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::vector<double> numbersOfLine(const std::string& line, const std::string& where) {
  std::istringstream stream(line);
  std::vector<double> numbers;
  std::string word;
  while (stream >> word) {
    const auto number = numberFromText(word);
    if (!number) {
      throw InputError(where + ": expected a number, found '" + word + "'");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

CsvTable::CsvTable(const std::filesystem::path& path) : path_(path) {
  std::ifstream file(path);
  if (!file || isFolder(path)) {
    throw InputError("cannot read " + path.string() + ": expected a comma-separated table");
  }
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (trimmed(line).empty() || (!header_.empty() && line.starts_with("#"))) {
      continue;
    }
    if (header_.empty()) {
      header_ = headerNames(trimmed(line));
      continue;
    }
    Row row{number, splitText(trimmed(line), ',')};
    if (row.fields.size() != header_.size()) {
      throw InputError(path.string() + " line " + std::to_string(number) + ": expected " +
                       std::to_string(header_.size()) + " fields as in the header, found " +
                       std::to_string(row.fields.size()));
    }
    rows_.push_back(std::move(row));
  }
  if (header_.empty()) {
    throw InputError(path.string() + " is empty: expected a header line with column names");
  }
}

bool CsvTable::has(const std::string& column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t CsvTable::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) {
    std::string present;
    for (const auto& column : header_) {
      present += (present.empty() ? "" : ", ") + column;
    }
    throw InputError(path_.string() + " line 1: expected a column " + name + ", found " + present);
  }
  return static_cast<std::size_t>(found - header_.begin());
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const auto value = numberFromText(text(row, column));
  if (!value) {
    throw InputError(where(row, column) + ": expected a number, found '" + text(row, column) + "'");
  }
  return *value;
}

long long CsvTable::integer(std::size_t row, std::size_t column) const {
  const std::string& field = text(row, column);
  long long value = 0;
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || stop != field.data() + field.size()) {
    throw InputError(where(row, column) + ": expected a whole number, found '" + field + "'");
  }
  return value;
}

std::string CsvTable::where(std::size_t row, std::size_t column) const {
  return path_.string() + " line " + std::to_string(rows_[row].line) + ", column " +
         header_[column];
}

}  // namespace ringhook

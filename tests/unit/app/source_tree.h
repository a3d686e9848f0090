#pragma once

/// \file
/// The source tree as text, for promises about what names what.

#include <filesystem>
#include <string>
#include <vector>

namespace ringhook::test {

struct SourceFile {
  std::filesystem::path path;      ///< relative to the source tree
  std::vector<std::string> lines;  ///< as they stand
  [[nodiscard]] bool isHeader() const { return path.extension() == ".h"; }
};

/// An #include and where it stands.
struct Include {
  std::string name;  ///< between quotes or brackets
  bool quoted = false;
  std::string where;  ///< path:line
};

/// Headers and sources below a folder of the source tree, in order of their paths.
std::vector<SourceFile> sourcesBelow(const std::filesystem::path& folder);

/// Folders directly below a folder of the source tree, in order.
std::vector<std::string> foldersIn(const std::filesystem::path& folder);

std::vector<Include> includesOf(const SourceFile& file);

/// "core" of "core/pose.h"; empty without a folder.
std::string moduleOf(const std::string& include);

}  // namespace ringhook::test

#include "source_tree.h"

#include <algorithm>
#include <fstream>
#include <regex>

namespace ringhook::test {

namespace fs = std::filesystem;

std::vector<SourceFile> sourcesBelow(const fs::path& folder) {
  const fs::path root = RINGHOOK_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) {
      continue;
    }
    SourceFile file;
    file.path = entry.path().lexically_relative(root);
    std::ifstream text(entry.path());
    for (std::string line; std::getline(text, line);) {
      file.lines.push_back(line);
    }
    files.push_back(std::move(file));
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> foldersIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(RINGHOOK_SOURCE_DIR) / folder)) {
    if (entry.is_directory()) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Include> includesOf(const SourceFile& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<Include> includes;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.lines[i], match, pattern)) {
      includes.push_back(
          {match[2], match[1] == "\"", file.path.string() + ":" + std::to_string(i + 1)});
    }
  }
  return includes;
}

std::string moduleOf(const std::string& include) {
  const std::size_t slash = include.find('/');
  return slash == std::string::npos ? std::string() : include.substr(0, slash);
}

}  // namespace ringhook::test

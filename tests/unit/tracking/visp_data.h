#pragma once

/// \file
/// Image sequences that Debian's visp-images-data installs, for tests that skip without them.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/image.h"

namespace ringhook::test {

inline std::filesystem::path vispData() { return "/usr/share/visp-images-data/ViSP-images"; }

/// Path of the n-th file of a numbered series, such as "image%04d.pgm".
inline std::filesystem::path numbered(const std::filesystem::path& folder,
                                      const std::string& prefix, int digits, int number,
                                      const std::string& ending) {
  std::string n = std::to_string(number);
  n.insert(0,
           static_cast<std::size_t>(digits) - std::min(n.size(), static_cast<std::size_t>(digits)),
           '0');
  return folder / (prefix + n + ending);
}

/// Binary 8-bit PGM without comments in its header; an empty image if it cannot be read.
inline GrayImage readPgm(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0;
  int height = 0;
  int largest = 0;
  const auto skipComments = [&] {
    while (file >> std::ws && file.peek() == '#') {
      std::string line;
      std::getline(file, line);
    }
  };
  file >> magic;
  skipComments();
  file >> width;
  skipComments();
  file >> height;
  skipComments();
  file >> largest;
  if (!file || magic != "P5" || largest != 255) {
    return {};
  }
  file.get();
  GrayImage image(width, height);
  file.read(reinterpret_cast<char*>(image.pixels.data()),
            static_cast<std::streamsize>(image.pixels.size()));
  return file ? image : GrayImage{};
}

}  // namespace ringhook::test

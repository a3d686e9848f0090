#pragma once

/// \file
/// Readers of files under any bytes: the bytes go to a file in memory (/dev/shm where there is
/// one), the reader reads it, and nothing but an InputError with words may come out.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "fuzz/script.h"

namespace ringhook::fuzz {

/// A folder of this process, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code failed;
    const std::filesystem::path memory = "/dev/shm";
    const bool there = std::filesystem::is_directory(memory, failed);
    path_ = (there ? memory : std::filesystem::temp_directory_path()) /
            ("ringhook-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code failed;
    std::filesystem::remove_all(path_, failed);
  }

  /// Writes a file; its path.
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
    return file;
  }
  void remove(const std::string& name) const { std::filesystem::remove(path_ / name); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline const ScratchFolder& scratch() {
  static const ScratchFolder folder;
  return folder;
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Files in one input, parted by lines "=====".
inline std::vector<std::string_view> filesIn(std::string_view text) {
  constexpr std::string_view kBorder = "=====\n";
  std::vector<std::string_view> files;
  for (std::size_t end = text.find(kBorder); end != std::string_view::npos;
       end = text.find(kBorder)) {
    files.push_back(text.substr(0, end));
    text.remove_prefix(end + kBorder.size());
  }
  files.push_back(text);
  return files;
}

/// Writes the files of one input under these names, one after the other; names that it has no file
/// for are not there.
inline void writeFiles(const ScratchFolder& folder, std::span<const char* const> names,
                       std::string_view input) {
  const auto files = filesIn(input);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i < files.size()) {
      folder.write(names[i], files[i]);
    } else {
      folder.remove(names[i]);
    }
  }
}

/// Runs `read`; whatever but an InputError with words comes out of it ends the program.
template <class Read>
int understoodOrRefused(Read read) {
  try {
    read();
  } catch (const InputError& e) {
    require(*e.what() != '\0', "a refusal has words");
  }
  return 0;
}

}  // namespace ringhook::fuzz

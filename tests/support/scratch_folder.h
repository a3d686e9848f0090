#pragma once

/// \file
/// A fresh folder for one test, removed afterwards, and small text files in it. No other test has
/// it, run at the same time or by somebody else.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace ringhook {

class ScratchFolder {
 public:
  ScratchFolder() {
    static int count = 0;  // a test may want two
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("ringhook-") + test->test_suite_name() + "-" + test->name() +
                       "-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
    std::replace(name.begin(), name.end(), '/', '-');  // in the names of parametrised tests
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// A file's bytes; that it can be read is part of the test.
inline std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Message of the Error that `job` throws; empty if it throws none.
template <class Exception, class Job>
std::string messageOf(Job job) {
  try {
    job();
  } catch (const Exception& e) {
    return e.what();
  }
  return {};
}

}  // namespace ringhook

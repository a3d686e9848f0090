#pragma once

/// \file
/// Runs the built program as an operator does, as a process of its own.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace ringhook::test {

struct ProgramResult {
  int exit_code = -1;  ///< -1 if it did not end by itself
  std::string out;
  std::string err;
};

/// A started program whose output goes to files in `folder`.
class Program {
 public:
  /// `ringhook ARGUMENTS...` with `folder` as its working folder.
  Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// What it has written to standard output so far.
  [[nodiscard]] std::string outSoFar() const;
  [[nodiscard]] std::string errSoFar() const;
  [[nodiscard]] bool running();
  void signal(int number);
  /// Waits for its end.
  ProgramResult wait();

 private:
  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

/// Runs to the end.
ProgramResult runProgram(const std::filesystem::path& folder,
                         const std::vector<std::string>& arguments);

}  // namespace ringhook::test

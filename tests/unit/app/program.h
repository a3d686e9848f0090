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

/// A started program. Its standard output goes to a file in `folder`, its standard error is read as
/// it comes.
class Program {
 public:
  /// `ringhook ARGUMENTS...` with `folder` as its working folder.
  Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits until it says `text` on standard error; false if it ends without.
  bool waitUntilItSays(const std::string& text);
  /// Waits until there is such a file; false if it ends without.
  bool waitUntilThereIs(const std::filesystem::path& file);
  /// On standard error.
  [[nodiscard]] const std::string& saidSoFar() const { return err_; }
  void signal(int number);
  /// Waits for its end.
  ProgramResult wait();

 private:
  bool readMore();

  std::filesystem::path out_file_;
  std::string err_;    ///< so far
  int err_pipe_ = -1;  ///< reading end
  pid_t pid_ = -1;     ///< -1 once it ended
};

/// Runs to the end.
ProgramResult runProgram(const std::filesystem::path& folder,
                         const std::vector<std::string>& arguments);

}  // namespace ringhook::test

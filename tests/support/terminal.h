#pragma once

/// \file
/// Runs the built program on a pseudo-terminal, as somebody who sits before it does: reads what it
/// says, types answers, pulls the plug.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace ringhook::test {

class Terminal {
 public:
  /// `ringhook ARGUMENTS...` with `folder` as its working folder.
  Terminal(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Reads until it says `text`, behind what was waited for before; false if it ends without.
  bool waitFor(const std::string& text);
  /// Types a line.
  void type(const std::string& line);
  void signal(int number);
  /// Reads to its end. \returns its exit code, or -1 if a signal ended it.
  int wait();
  /// Everything it said, line ends as the terminal makes them.
  [[nodiscard]] const std::string& said() const { return said_; }

 private:
  bool readMore();

  std::string said_;
  std::size_t heard_ = 0;  ///< up to here it was waited for
  int terminal_ = -1;
  pid_t pid_ = -1;
};

}  // namespace ringhook::test

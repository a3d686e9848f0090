#pragma once

/// \file
/// Progress of a long job on standard error: one line that is rewritten, with the time left, on a
/// terminal; a quiet line every tenth of the work in a pipe.

#include <chrono>
#include <functional>
#include <string>

namespace ringhook {

class Progress {
 public:
  /// \param what what is being done, as in "tracking".
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// \param fraction of the work done, 0 to 1. \param note short state, shown behind it.
  void show(double fraction, const std::string& note = {});
  /// Ends the line that is being rewritten, if any, so that other text can follow.
  void clear();

 private:
  std::string what_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
  bool terminal_;
  bool line_open_ = false;
  int last_tenth_ = 0;
};

/// A hook that shows progress (0 to 1, and a short state) and, between steps, throws Interrupted
/// when the operator asks for it. `progress` must outlive the hook.
std::function<void(double, const std::string&)> hookFor(Progress& progress);

}  // namespace ringhook

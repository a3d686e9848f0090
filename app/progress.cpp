#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/interrupt.h"
#include "core/error.h"

namespace ringhook {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), start_(Clock::now()), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::show(double fraction, const std::string& note) {
  const double f = std::clamp(fraction, 0.0, 1.0);
  const int percent = static_cast<int>(std::floor(100.0 * f));
  if (!terminal_) {
    if (percent / 10 > last_tenth_) {
      last_tenth_ = percent / 10;
      std::fprintf(stderr, "%s: %d %%%s%s\n", what_.c_str(), percent, note.empty() ? "" : ", ",
                   note.c_str());
    }
    return;
  }
  if (secondsSince(last_) < 0.2 && f < 1.0) {
    return;
  }
  last_ = Clock::now();
  const double elapsed = secondsSince(start_);
  const double left = f > 0.0 ? elapsed * (1.0 - f) / f : 0.0;
  std::fprintf(stderr, "\r\033[K%s: %d %%, %.0f s left  %s", what_.c_str(), percent, left,
               note.c_str());
  std::fflush(stderr);
  line_open_ = true;
}

void Progress::clear() {
  if (line_open_) {
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
    line_open_ = false;
  }
}

std::function<void(double, const std::string&)> hookFor(Progress& progress) {
  return [&progress](double fraction, const std::string& note) {
    if (interruptRequested()) {
      progress.clear();
      throw Interrupted("stopped by the operator, nothing was written");
    }
    progress.show(fraction, note);
  };
}

}  // namespace ringhook

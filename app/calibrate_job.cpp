#include "app/calibrate_job.h"

#include <array>
#include <ctime>

#include "app/interrupt.h"
#include "core/error.h"

namespace ringhook {

StepHook hookFor(Progress& progress) {
  return [&progress](double fraction, const std::string& note) {
    if (interruptRequested()) {
      progress.clear();
      throw Interrupted("stopped by the operator, nothing was written");
    }
    progress.show(fraction, note);
  };
}

std::string utcDate() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace ringhook

#include "app/interrupt.h"

#include <csignal>

namespace ringhook {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the handler may only touch lock-free data");

extern "C" void onSignal(int signal) {
  requested.store(true);
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

const std::atomic<bool>& interruptRequested() { return requested; }

}  // namespace ringhook

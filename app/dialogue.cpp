#include "app/dialogue.h"

#include <memory>

#include "app/interrupt.h"
#include "app/progress.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kInput = 0;   // standard input
constexpr int kOutput = 1;  // standard output

}  // namespace

Console terminal() { return {kInput, kOutput, leaveIfAsked}; }

void leaveIfAsked() {
  if (interruptRequested()) {
    throw Interrupted("stopped by the operator; the same command goes on from here");
  }
}

StepHook progressOf(const std::string& what) {
  auto progress = std::make_shared<Progress>(what);
  return [progress, hook = hookFor(*progress)](double fraction, const std::string& note) {
    hook(fraction, note);
  };
}

}  // namespace ringhook

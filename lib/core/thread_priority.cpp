#include "core/thread_priority.h"

#include <sched.h>
#include <sys/resource.h>

namespace ringhook {
namespace {

constexpr int kNiceValue = -11;

}  // namespace

const char* nameOf(ThreadPriority priority) {
  switch (priority) {
    case ThreadPriority::kRealTime:
      return "real time";
    case ThreadPriority::kNice:
      return "nice";
    case ThreadPriority::kOrdinary:
      break;
  }
  return "ordinary";
}

RaisedPriority::RaisedPriority(int rank) : nice_before_(getpriority(PRIO_PROCESS, 0)) {
  sched_param parameters{};
  parameters.sched_priority = rank;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0) {
    reached_ = ThreadPriority::kRealTime;
  } else if (setpriority(PRIO_PROCESS, 0, kNiceValue) == 0) {  // per thread on Linux
    reached_ = ThreadPriority::kNice;
  }
}

RaisedPriority::~RaisedPriority() { giveBack(); }

/// Giving back is always permitted, as long as threads to be started stay ordinary.
void RaisedPriority::giveBack() {
  const sched_param ordinary{};
  if (reached_ == ThreadPriority::kRealTime) {
    static_cast<void>(sched_setscheduler(0, SCHED_OTHER | SCHED_RESET_ON_FORK, &ordinary));
  } else if (reached_ == ThreadPriority::kNice) {
    static_cast<void>(setpriority(PRIO_PROCESS, 0, nice_before_));
  }
  reached_ = ThreadPriority::kOrdinary;
}

}  // namespace ringhook

#pragma once

/// \file
/// Threads that have to answer within a few milliseconds: the one that speaks with an arm, the one
/// that plays a controller, those that empty a camera's socket. Linux runs a thread of the policy
/// SCHED_FIFO before all ordinary ones (sched(7)); that may be asked for by root, with the
/// capability CAP_SYS_NICE, or up to the limit RLIMIT_RTPRIO (doc/rx60.md tells how to permit it).
/// Where it is not permitted a negative nice value is tried, and where that is not, all stays as it
/// was: raising never fails, it tells how far it came.
///
/// A real-time thread that never waits starves its processor. So this is for threads that work much
/// less than they wait; threads that they start begin as ordinary ones; and one that finds itself
/// at work without a pause gives its priority back.

namespace ringhook {

enum class ThreadPriority {
  kOrdinary,  ///< like any other thread
  kNice,      ///< ordinary, with a larger share of the processor
  kRealTime   ///< before all ordinary ones
};

/// In words, as for reports: "ordinary", "nice", "real time".
const char* nameOf(ThreadPriority priority);

/// Which real-time thread goes first where several want to run. All below the kernel's own 50.
inline constexpr int kCameraRank = 10;  ///< empties sockets, which may fill a little
inline constexpr int kTickRank = 20;    ///< plays a controller
inline constexpr int kLinkRank = 30;    ///< speaks with an arm

/// The calling thread's priority, raised from here to the end of the scope. To be made and ended on
/// one thread.
class RaisedPriority {
 public:
  /// As far as is permitted.
  explicit RaisedPriority(int rank);
  ~RaisedPriority();
  RaisedPriority(const RaisedPriority&) = delete;
  RaisedPriority& operator=(const RaisedPriority&) = delete;

  /// How far that was; kOrdinary once it was given back.
  [[nodiscard]] ThreadPriority reached() const { return reached_; }
  /// Before the end of the scope.
  void giveBack();

 private:
  int nice_before_ = 0;
  ThreadPriority reached_ = ThreadPriority::kOrdinary;
};

}  // namespace ringhook

#pragma once

/// \file
/// The controller takes one message a tick. After a hiccup of network or scheduler two commands may
/// reach it within one tick: the second waits, and from then on every command acts a tick late, for
/// ever, since one is taken and one is sent in each tick. Such a standing backlog shows as commands
/// that always wait for their reply; but so does a long wire, on which they are merely under way.
///
/// The two are told apart by a trial: one command is left out. A backlog is shorter by one from
/// then on; on a long wire as many as before are soon under way again, and that number is accepted.

#include <algorithm>

namespace ringhook::rx60 {

class BacklogGuard {
 public:
  /// Commands that may wait at all.
  explicit BacklogGuard(int most) : most_(most) {}

  /// Whether the command that is due now is to be left out, while `unanswered` ones wait for their
  /// reply. To be asked once a period.
  bool leaveOut(int unanswered) {
    if (unanswered >= most_) {
      return true;
    }
    if (periods_ >= kSettling) {
      least_ = std::min(least_, unanswered);
    }
    if (++periods_ < kWindow) {
      return false;
    }
    const bool in_vain = tried_ && least_ >= least_before_;
    if (in_vain || least_ < accepted_) {
      accepted_ = least_;
    }
    tried_ = least_ > accepted_;
    least_before_ = least_;
    least_ = most_;
    periods_ = 0;
    return tried_;
  }

 private:
  static constexpr int kWindow = 50;    ///< periods: 0.2 s
  static constexpr int kSettling = 15;  ///< of these, in which the gap of a trial passes by

  int most_;
  int least_ = most_;     ///< waiting, in this window
  int least_before_ = 0;  ///< in the window before the trial
  int accepted_ = 0;      ///< as many are under way on this wire
  int periods_ = 0;       ///< of this window
  bool tried_ = false;    ///< one was left out at the end of the window before
};

}  // namespace ringhook::rx60

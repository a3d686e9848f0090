#pragma once

/// \file
/// Mishaps of a simulated controller and its lines at given times, as a user writes them:
/// NAME@SECONDS or NAME@SECONDS:DURATION, both in seconds; without a duration it lasts for good.
///
/// | name | what happens |
/// |---|---|
/// | e-stop | pressed; at the end released, and the drives switched on again |
/// | error | the motion task dies; at the end it runs again |
/// | drives-off | drives lose power; at the end they have it again |
/// | delay | everything 20 ms late, both ways |
/// | jitter | everything 0 to 10 ms late, both ways |
/// | loss | every tenth frame is never sent by the controller, on average |
/// | split | the controller's frames arrive in pieces, 1 ms apart |
/// | merge | the controller's frames arrive together, every 20 ms |
/// | stall | nothing arrives, either way; at the end all at once |
/// | half-open | nothing arrives any more, either way, and nobody closes |
/// | refuse-points | every trajectory point is refused |
/// | cut | the controller closes every connection; with a duration, new ones too: a storm |

#include <optional>
#include <string>
#include <vector>

#include "sim/rx60_lines.h"

namespace ringhook {

enum class MishapKind {
  kEStop,
  kError,
  kDrivesOff,
  kDelay,
  kJitter,
  kLoss,
  kSplit,
  kMerge,
  kStall,
  kHalfOpen,
  kRefusePoints,
  kCut,
};
const char* nameOf(MishapKind kind);

struct Mishap {
  MishapKind kind = MishapKind::kCut;
  double start = 0.0;              ///< since the controller's start [s]
  std::optional<double> duration;  ///< [s]; for good without
};

/// Throws InputError that quotes the text and says what was expected.
Mishap parseMishap(const std::string& text);

class MishapScript {
 public:
  /// Controller and lines must outlive the script.
  MishapScript(const std::vector<Mishap>& mishaps, Rx60Controller& controller, Rx60Lines& lines);

  /// Begins and ends what is due; to be called at the beginning of every tick. What began or ended,
  /// in words.
  std::vector<std::string> tick(Time now);

 private:
  enum class Stage { kAhead, kActive, kOver };
  struct Entry {
    Mishap mishap;
    Stage stage = Stage::kAhead;
  };
  void set(const Mishap& mishap, bool active, Time now);
  void setLines(MishapKind kind, bool active);
  void cutAll();

  std::vector<Entry> entries_;
  Rx60Controller& controller_;
  Rx60Lines& lines_;
};

}  // namespace ringhook

#pragma once

/// \file
/// What can go wrong between a program, the RX60's client, the wire, the controller and the
/// operator, dealt out at random from a seed in virtual time, while a watch looks at every command
/// on the wire and at what the controller tells its arm. Used by the campaign and, shorter, by a
/// test.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ringhook::test {

enum class Mishap {
  kEStop,
  kError,
  kDrivesOff,
  kCutMotion,
  kCutState,
  kCutIo,
  kStallToClient,
  kStallToController,
  kHalfOpenMotion,
  kHalfOpenState,
  kDelay,
  kJitter,
  kLostFeedback,
  kLostCommands,
  kSplit,
  kMerge,
  kNonsense,        ///< bytes that are no message
  kForeignMessage,  ///< a good message on the wrong connection
  kManualMode,
  kSilentVision,
  kNotANumber,
  kTooFast,
  kOperatorStop,
  kRefusedPoints,
  kReconnectStorm,
  kCount,
};
const char* nameOf(Mishap mishap);

struct MishapTally {
  int dealt = 0;
  int client_faults = 0;         ///< times that the client stopped with a reason
  double longest_to_zero_s = 0;  ///< from the mishap to zero commanded speed, where it must be zero
};

struct MishapResult {
  int episodes = 0;
  int rearms = 0;
  double virtual_s = 0.0;
  std::int64_t commands = 0;  ///< velocities on the wire
  std::map<Mishap, MishapTally> tallies;
  std::vector<std::string> violations;  ///< with seed and time; none expected
};

/// One arm, connected, served with targets of 50 Hz, and `mishaps` mishaps one after the other,
/// each mended and followed by a re-arm.
void runMishaps(std::uint64_t seed, int mishaps, MishapResult& result);

}  // namespace ringhook::test

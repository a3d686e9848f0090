#pragma once

/// \file
/// RX60 messages as a script wants them: whole ones of every type, and damaged ones.

#include <vector>

#include "fuzz/script.h"
#include "robot/rx60/messages.h"

namespace ringhook::fuzz {

/// Every field from the script. `comm` and reply code are lawful.
rx60::Message scriptedMessage(Script& script);

/// The frame of a scripted message with one byte changed, then cut short or not.
std::vector<std::byte> damagedFrame(Script& script);

}  // namespace ringhook::fuzz

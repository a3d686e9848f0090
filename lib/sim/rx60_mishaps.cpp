#include "sim/rx60_mishaps.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kForGood = 1e9;     // [s]
constexpr std::int32_t kError = 40;  // any VAL3 runtime error

constexpr std::array<std::pair<MishapKind, const char*>, 12> kNames = {{
    {MishapKind::kEStop, "e-stop"},
    {MishapKind::kError, "error"},
    {MishapKind::kDrivesOff, "drives-off"},
    {MishapKind::kDelay, "delay"},
    {MishapKind::kJitter, "jitter"},
    {MishapKind::kLoss, "loss"},
    {MishapKind::kSplit, "split"},
    {MishapKind::kMerge, "merge"},
    {MishapKind::kStall, "stall"},
    {MishapKind::kHalfOpen, "half-open"},
    {MishapKind::kRefusePoints, "refuse-points"},
    {MishapKind::kCut, "cut"},
}};

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw InputError("fault '" + text + "': expected " + expected);
}

double seconds(const std::string& text, const std::string& number) {
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (number.empty() || *end != '\0' || !(value >= 0.0) || value > kForGood) {
    refuse(text, "NAME@SECONDS or NAME@SECONDS:DURATION, as in e-stop@5:2, not '" + number +
                     "' for a time");
  }
  return value;
}

MishapKind kindOf(const std::string& text, const std::string& name) {
  std::string known;
  for (const auto& [kind, its_name] : kNames) {
    if (name == its_name) {
      return kind;
    }
    known += (known.empty() ? "" : ", ") + std::string(its_name);
  }
  refuse(text, "one of " + known);
}

}  // namespace

const char* nameOf(MishapKind kind) { return kNames.at(static_cast<std::size_t>(kind)).second; }

Mishap parseMishap(const std::string& text) {
  const std::size_t at = text.find('@');
  Mishap mishap;
  mishap.kind = kindOf(text, text.substr(0, at));
  if (at == std::string::npos) {
    refuse(text, "a time behind the name, as in " + text + "@5");
  }
  const std::size_t colon = text.find(':', at);
  mishap.start =
      seconds(text, text.substr(at + 1, colon == std::string::npos ? colon : colon - at - 1));
  if (colon != std::string::npos) {
    mishap.duration = seconds(text, text.substr(colon + 1));
  }
  return mishap;
}

MishapScript::MishapScript(const std::vector<Mishap>& mishaps, Rx60Controller& controller,
                           Rx60Lines& lines)
    : controller_(controller), lines_(lines) {
  for (const Mishap& mishap : mishaps) {
    entries_.push_back({mishap});
  }
}

std::vector<std::string> MishapScript::tick(Time now) {
  std::vector<std::string> events;
  for (auto& [mishap, stage] : entries_) {
    const double end = mishap.start + mishap.duration.value_or(kForGood);
    if (stage == Stage::kAhead && now.seconds() >= mishap.start) {
      stage = Stage::kActive;
      set(mishap, true, now);
      events.push_back(std::string(nameOf(mishap.kind)) + " begins");
    }
    if (stage == Stage::kActive && now.seconds() >= end) {
      stage = Stage::kOver;
      set(mishap, false, now);
      events.push_back(std::string(nameOf(mishap.kind)) + " ends");
    }
    if (stage == Stage::kActive && mishap.kind == MishapKind::kCut && mishap.duration) {
      cutAll();
    }
  }
  return events;
}

void MishapScript::set(const Mishap& mishap, bool active, Time now) {
  switch (mishap.kind) {
    case MishapKind::kEStop:
      if (active) {
        controller_.pressEStop();
      } else {
        controller_.releaseEStop();
        controller_.setDrives(true);
      }
      break;
    case MishapKind::kError:
      controller_.setError(active ? kError : 0);
      break;
    case MishapKind::kDrivesOff:
      controller_.setDrives(!active);
      break;
    case MishapKind::kRefusePoints:
      controller_.refuseNextPoints(active ? std::numeric_limits<int>::max() : 0);
      break;
    case MishapKind::kCut:
      if (active) {
        cutAll();
      }
      break;
    case MishapKind::kStall:
      for (const Rx60Socket socket : kRx60Sockets) {
        const double duration = active ? mishap.duration.value_or(kForGood) : 0.0;
        lines_.toClient(socket).stall(now, duration);
        lines_.toController(socket).stall(now, duration);
      }
      break;
    default:
      setLines(mishap.kind, active);
  }
}

/// Faults of the lines that are switched on and off; others that are on stay on.
void MishapScript::setLines(MishapKind kind, bool active) {
  for (const Rx60Socket socket : kRx60Sockets) {
    for (const bool outgoing : {true, false}) {
      FaultyLine& line = outgoing ? lines_.toClient(socket) : lines_.toController(socket);
      LineFaults faults = line.faults();
      if (kind == MishapKind::kDelay) {
        faults.delay = active ? 0.020 : 0.0;
      } else if (kind == MishapKind::kJitter) {
        faults.jitter = active ? 0.010 : 0.0;
      } else if (kind == MishapKind::kHalfOpen) {
        faults.half_open = active;
      } else if (outgoing && kind == MishapKind::kLoss) {
        faults.loss = active ? 0.1 : 0.0;
      } else if (outgoing && kind == MishapKind::kSplit) {
        faults.split_gap = active ? 0.001 : 0.0;
      } else if (outgoing && kind == MishapKind::kMerge) {
        faults.merge = active ? 0.020 : 0.0;
      }
      line.setFaults(faults);
    }
  }
}

void MishapScript::cutAll() {
  for (const Rx60Socket socket : kRx60Sockets) {
    lines_.cut(socket);
  }
}

}  // namespace ringhook

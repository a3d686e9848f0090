#pragma once

/// \file
/// What both measurements of the link share: where the arm stands, what vision wants of it.

#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "robot/rx60/rx60_arm.h"

namespace ringhook::bench {

using Clock = std::chrono::steady_clock;
inline constexpr auto kTick = std::chrono::milliseconds(4);
inline constexpr auto kVisionPeriod = std::chrono::milliseconds(20);

/// [rad]
inline JointVector startPosition() { return JointVector{{0.3, 0.4, 0.9, -0.2, 0.8, 0.1}}; }

/// A moving target [rad/s] at time t [s].
inline JointVector targetAt(double t) {
  JointVector v;
  for (int i = 0; i < 6; ++i) {
    v[i] = 0.2 * std::sin((1.0 + 0.2 * i) * t + i) + 0.01;
  }
  return v;
}

/// Gives the arm its target; a fault (this machine stood still for too long) is told and cleared.
inline void command(Rx60Arm& arm, const JointVector& target) {
  try {
    arm.commandVelocity(target);
  } catch (const DeviceError&) {
    std::printf("fault: %s\n", arm.report().last_fault.c_str());
    arm.rearm();
  }
}

}  // namespace ringhook::bench

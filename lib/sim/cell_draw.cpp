#include "sim/cell_draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/hook_body.h"

namespace ringhook {
namespace {

class Dice {
 public:
  /// \param stream 0, 1, ...: independent draws from one seed.
  explicit Dice(std::uint64_t seed, std::uint64_t stream = 0)
      : bits_(seed + stream * 0x9e3779b97f4a7c15ULL) {}

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }
  /// 1 + uniform(-spread, +spread).
  double factor(double spread) { return 1.0 + spread * (2.0 * unit() - 1.0); }
  double within(const Range& range) { return range.low + (range.high - range.low) * unit(); }
  double phase() { return 2.0 * std::numbers::pi * unit(); }
  /// Standard normal (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(2.0 * std::numbers::pi * unit());
  }

 private:
  std::mt19937_64 bits_;
};

HookDraw drawHook(const HookOptions& options, Dice& dice, Dice& amplitudes) {
  HookDraw hook;
  hook.pivot_height = HookShape{}.shank_length * dice.factor(options.length_spread);
  hook.friction = options.pivot_friction * dice.factor(options.damping_spread);
  hook.damping = options.pivot_damping * dice.factor(options.damping_spread);
  const double largest[2] = {options.swing_about_x, options.swing_about_y};
  for (int axis = 0; axis < 2; ++axis) {
    const double phase = dice.phase();
    const double amplitude = largest[axis] * amplitudes.within({options.swing_least, 1.0});
    hook.angle[axis] = amplitude * std::cos(phase);
    hook.rate[axis] = -amplitude * swingFrequency(hook.pivot_height, axis) * std::sin(phase);
  }
  return hook;
}

BeltProfile drawBelt(const BeltOptions& options, double speed, Dice& dice) {
  if (options.profile) {
    return *options.profile;
  }
  BeltProfile belt;
  belt.acceleration = options.acceleration;
  belt.jerk = options.jerk;
  belt.pitch = options.pitch;
  for (const double fraction : options.ripple) {
    belt.ripple.push_back({fraction, dice.phase()});
  }
  const double ramp_s = changeDuration(belt, speed);
  double start_s = options.start_s;
  if (start_s > 0.0) {
    belt.changes.push_back({start_s, speed});
  } else {
    belt.initial_speed = speed;
  }
  for (int i = 0; i < options.stops; ++i) {
    const double stop_s = start_s + std::max(ramp_s, dice.within(options.run_s));
    start_s = stop_s + std::max(ramp_s, dice.within(options.stand_s));
    belt.changes.push_back({stop_s, 0.0});
    belt.changes.push_back({start_s, speed});
  }
  return belt;
}

}  // namespace

CellDraw drawCell(const CellOptions& options) {
  Dice dice(options.seed);
  Dice amplitudes(options.seed, 1);
  Dice belt(options.seed, 2);
  CellDraw draw;
  draw.belt_speed = options.belt.speed * dice.factor(options.belt.speed_spread);
  draw.belt = drawBelt(options.belt, draw.belt_speed, belt);
  for (int i = 0; i < 6; ++i) {
    draw.zero_error[i] = options.arm.zero_error_sigma * dice.normal();
  }
  for (int i = 0; i < options.hook.count; ++i) {
    draw.hooks.push_back(drawHook(options.hook, dice, amplitudes));
  }
  return draw;
}

}  // namespace ringhook

#include "sim/cell_draw.h"

#include <cmath>
#include <numbers>
#include <random>

#include "sim/hook_body.h"

namespace ringhook {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }
  /// 1 + uniform(-spread, +spread).
  double factor(double spread) { return 1.0 + spread * (2.0 * unit() - 1.0); }
  /// Standard normal (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(2.0 * std::numbers::pi * unit());
  }

 private:
  std::mt19937_64 bits_;
};

HookDraw drawHook(const HookOptions& options, Dice& dice) {
  HookDraw hook;
  hook.pivot_height = HookShape{}.shank_length * dice.factor(options.length_spread);
  hook.friction = options.pivot_friction * dice.factor(options.damping_spread);
  hook.damping = options.pivot_damping * dice.factor(options.damping_spread);
  const double amplitude[2] = {options.swing_about_x, options.swing_about_y};
  for (int axis = 0; axis < 2; ++axis) {
    const double phase = 2.0 * std::numbers::pi * dice.unit();
    hook.angle[axis] = amplitude[axis] * std::cos(phase);
    hook.rate[axis] = -amplitude[axis] * swingFrequency(hook.pivot_height, axis) * std::sin(phase);
  }
  return hook;
}

}  // namespace

CellDraw drawCell(const CellOptions& options) {
  Dice dice(options.seed);
  CellDraw draw;
  draw.belt_speed = options.belt.speed * dice.factor(options.belt.speed_spread);
  for (int i = 0; i < 6; ++i) {
    draw.zero_error[i] = options.arm.zero_error_sigma * dice.normal();
  }
  for (int i = 0; i < options.hook.count; ++i) {
    draw.hooks.push_back(drawHook(options.hook, dice));
  }
  return draw;
}

double beltSpeed(const CellOptions& options, const CellDraw& draw, double time_s) {
  if (options.belt.profile) {
    return draw.belt_speed * options.belt.profile(time_s);
  }
  const double phase = 2.0 * std::numbers::pi * time_s / options.belt.variation_period;
  return draw.belt_speed * (1.0 + options.belt.variation * std::sin(phase));
}

}  // namespace ringhook

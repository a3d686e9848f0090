#include "core/number_text.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace ringhook {

std::string exactText(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string secondsText(Time time) {
  std::array<char, 48> text{};
  const long long ns = time.nanoseconds();
  std::snprintf(text.data(), text.size(), "%s%lld.%09lld", ns < 0 ? "-" : "",
                std::llabs(ns / 1'000'000'000), std::llabs(ns % 1'000'000'000));
  return text.data();
}

}  // namespace ringhook

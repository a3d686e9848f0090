#pragma once

/// \file
/// What a fuzzer's bytes are read as: a script of small decisions. A script that is over goes on
/// with zeros, so that every prefix of one is one.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace ringhook::fuzz {

/// A promise that no input may break; the fuzzer keeps the input that does.
inline void require(bool kept, const char* promise) {
  if (!kept) {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
  }
}

class Script {
 public:
  explicit Script(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  [[nodiscard]] bool over() const { return left_.empty(); }

  std::uint8_t byte() {
    if (left_.empty()) {
      return 0;
    }
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }

  /// 0 to count - 1.
  std::size_t choice(std::size_t count) { return byte() % count; }

  std::int32_t int32() {
    std::uint32_t bits = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bits |= static_cast<std::uint32_t>(byte()) << shift;
    }
    return static_cast<std::int32_t>(bits);
  }

  /// Any float: infinities, NaN and denormals too.
  float real() { return std::bit_cast<float>(int32()); }

  /// -1 to 1.
  double share() { return static_cast<double>(static_cast<std::int8_t>(byte())) / 128.0; }

  /// At most `count` bytes as they stand.
  std::span<const std::byte> raw(std::size_t count) {
    const auto taken = left_.first(std::min(count, left_.size()));
    left_ = left_.subspan(taken.size());
    return std::as_bytes(taken);
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace ringhook::fuzz

#pragma once

/// \file
/// A value, or the reason why there is none. For ordinary outcomes at frame rate (hook not seen,
/// measurement gated, rays parallel): the caller must look, nothing is thrown.

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace ringhook {

/// Why a stage has no value this time, as a short phrase that can stand in a table ("no tag seen").
struct Refusal {
  std::string reason;
};

template <class T>
class [[nodiscard]] Outcome {
 public:
  Outcome(T value) : held_(std::move(value)) {}
  Outcome(Refusal refusal) : held_(std::move(refusal)) {}

  [[nodiscard]] bool hasValue() const { return std::holds_alternative<T>(held_); }
  explicit operator bool() const { return hasValue(); }

  /// Precondition of the three: hasValue().
  [[nodiscard]] const T& value() const {
    assert(hasValue());
    return *std::get_if<T>(&held_);
  }
  const T& operator*() const { return value(); }
  const T* operator->() const { return &value(); }

  /// Precondition: !hasValue().
  [[nodiscard]] const std::string& reason() const {
    assert(!hasValue());
    return std::get_if<Refusal>(&held_)->reason;
  }

 private:
  std::variant<T, Refusal> held_;
};

}  // namespace ringhook

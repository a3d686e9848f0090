#pragma once

/// \file
/// When the world breaks (socket, file, calibration) an exception of one base is thrown at the
/// edge where it breaks; third-party exceptions are translated in the adapter that meets them.
/// Ordinary outcomes at frame rate are values instead: see outcome.h. Each message is one
/// sentence that names the file, line or field and what was expected.

#include <stdexcept>
#include <string>

namespace ringhook {

/// Base of everything the project throws; `main` prints what() once and exits with exitCode().
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence, int exit_code = 1)
      : std::runtime_error(sentence), exit_code_(exit_code) {}
  [[nodiscard]] int exitCode() const { return exit_code_; }

 private:
  int exit_code_;
};

/// Wrong use or bad input: a file, a line, a field, an option. Exit code 2.
class InputError : public Error {
 public:
  explicit InputError(const std::string& sentence) : Error(sentence, 2) {}
};

/// A device failed or vanished. Exit code 1.
class DeviceError : public Error {
 public:
  explicit DeviceError(const std::string& sentence) : Error(sentence, 1) {}
};

/// The operator asked to stop (Ctrl-C). Exit code 1; partial results were kept.
class Interrupted : public Error {
 public:
  explicit Interrupted(const std::string& sentence) : Error(sentence, 1) {}
};

}  // namespace ringhook

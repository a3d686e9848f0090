#pragma once

/// \file
/// Reading a YAML mapping field by field, strictly: the one reader of cell files, scenarios and tag
/// plates. A missing field, a wrong type, a number out of range, a field that stands twice or a
/// misspelt one each give an InputError in one sentence that names file, line and field and says
/// what was expected:
///
///     cell.yaml, line 12: field task.gain_per_s: expected a number from 0.1 to 50
///
/// Fields of a mapping in a list are named layout[0].size. Copies share what was asked for.

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/pose.h"

namespace ringhook {

class YamlFields {
 public:
  static constexpr double kAny = std::numeric_limits<double>::max();

  /// The document's top mapping. Throws InputError if the file cannot be read or is no mapping.
  static YamlFields open(const std::filesystem::path& file);

  /// A mapping below this one.
  YamlFields section(const std::string& key);
  /// A list of at least one mapping.
  std::vector<YamlFields> list(const std::string& key);

  /// Whether a field is there; asking makes it a known one.
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] bool isMapping(const std::string& key) const;

  // Required fields.
  std::string text(const std::string& key);
  /// A path, relative to the file that names it.
  std::filesystem::path path(const std::string& key);
  /// A finite number within [low, high].
  double number(const std::string& key, double low = -kAny, double high = kAny);
  int integer(const std::string& key, int low, int high);
  /// `size` finite numbers.
  Eigen::VectorXd vector(const std::string& key, int size);
  /// Seven numbers x, y, z [m], qx, qy, qz, qw.
  Pose pose(const std::string& key);
  /// Index of one of the texts in `allowed`.
  std::size_t choice(const std::string& key, const std::vector<std::string>& allowed);

  // Fields that may be left out: `value` is then kept.
  /// \param unit of the file in SI units; low and high are in the file's unit.
  void update(const std::string& key, double& value, double low, double high, double unit = 1.0);
  void update(const std::string& key, int& value, int low, int high);
  void update(const std::string& key, bool& value);
  /// At most `most` numbers within [low, high].
  void update(const std::string& key, std::vector<double>& values, int most, double low,
              double high);

  /// Throws an InputError that names file, line and field of a present `key`, and `expected`.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;
  /// Likewise of this mapping as a whole.
  [[noreturn]] void refuseWhole(const std::string& expected) const;
  /// Refuses keys that nobody asked for, and names those that were. Call it last.
  void refuseUnknown() const;

 private:
  struct State;  // yaml-cpp stays behind it
  explicit YamlFields(std::shared_ptr<State> state);

  std::shared_ptr<State> state_;
};

}  // namespace ringhook

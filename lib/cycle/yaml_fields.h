#pragma once

/// \file
/// Reading a YAML mapping field by field, strictly: a missing field, a wrong type, a number out of
/// range or a misspelt key each give an InputError that names file, line and field.

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

namespace ringhook {

class YamlFields {
 public:
  /// The document's top mapping. Throws InputError if the file cannot be read or is no mapping.
  static YamlFields open(const std::filesystem::path& file);

  /// A mapping below this one.
  YamlFields section(const std::string& key);

  [[nodiscard]] bool has(const std::string& key) const;
  std::string text(const std::string& key);
  /// A path, relative to the file that names it.
  std::filesystem::path path(const std::string& key);
  /// A finite number within [low, high].
  double number(const std::string& key, double low = -std::numeric_limits<double>::max(),
                double high = std::numeric_limits<double>::max());
  int integer(const std::string& key, int low, int high);
  /// `size` finite numbers.
  Eigen::VectorXd vector(const std::string& key, int size);

  /// Throws an InputError that names file, line and field of a present `key`, and `expected`.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

  /// Refuses keys that nobody asked for. Call it last.
  void refuseUnknown() const;

 private:
  YamlFields(std::filesystem::path file, std::string name, const YAML::Node& node);
  YAML::Node require(const std::string& key);

  std::filesystem::path file_;
  std::string name_;  ///< of this mapping, with a dot behind it; empty at the top
  YAML::Node node_;
  std::set<std::string> asked_;
};

}  // namespace ringhook

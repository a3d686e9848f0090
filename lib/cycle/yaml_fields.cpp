#include "cycle/yaml_fields.h"

#include <cmath>
#include <ios>
#include <sstream>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

std::string shortNumber(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// " from 0 to 5", or one-sided.
std::string rangeInWords(double low, double high) {
  constexpr double kNone = std::numeric_limits<double>::max();
  const std::string from = low > -kNone ? " from " + shortNumber(low) : "";
  return high < kNone ? from + " to " + shortNumber(high) : from + " on";
}

}  // namespace

YamlFields::YamlFields(std::filesystem::path file, std::string name, const YAML::Node& node)
    : file_(std::move(file)), name_(std::move(name)), node_(node) {}

YamlFields YamlFields::open(const std::filesystem::path& file) {
  YAML::Node node;
  try {
    node = YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    throw InputError("cannot read " + file.string() + ": expected a YAML file");
  } catch (const YAML::Exception& e) {
    throw InputError(file.string() + ", line " + std::to_string(e.mark.line + 1) +
                     ": not valid YAML: " + e.msg);
  } catch (const std::ios_base::failure&) {  // a folder opens but cannot be read
    throw InputError("cannot read " + file.string() + ": expected a YAML file");
  }
  if (!node.IsMap()) {
    throw InputError(file.string() + ": expected a mapping of fields at the top");
  }
  return {file, "", node};
}

YamlFields YamlFields::section(const std::string& key) {
  const YAML::Node node = require(key);
  if (!node.IsMap()) {
    refuse(key, "a mapping of fields");
  }
  return {file_, name_ + key + ".", node};
}

bool YamlFields::has(const std::string& key) const { return static_cast<bool>(node_[key]); }

std::string YamlFields::text(const std::string& key) {
  const YAML::Node node = require(key);
  if (!node.IsScalar() || node.Scalar().empty()) {
    refuse(key, "a text");
  }
  return node.Scalar();
}

std::filesystem::path YamlFields::path(const std::string& key) {
  const std::filesystem::path named = text(key);
  return named.is_absolute() ? named : (file_.parent_path() / named).lexically_normal();
}

double YamlFields::number(const std::string& key, double low, double high) {
  const YAML::Node node = require(key);
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    refuse(key, "a number");
  }
  if (value < low || value > high) {
    refuse(key, "a number" + rangeInWords(low, high));
  }
  return value;
}

int YamlFields::integer(const std::string& key, int low, int high) {
  const YAML::Node node = require(key);
  int value = 0;
  if (!node.IsScalar() || !YAML::convert<int>::decode(node, value) || value < low || value > high) {
    refuse(key, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return value;
}

Eigen::VectorXd YamlFields::vector(const std::string& key, int size) {
  const YAML::Node node = require(key);
  const std::string expected = std::to_string(size) + " numbers in [ ]";
  if (!node.IsSequence() || static_cast<int>(node.size()) != size) {
    refuse(key, expected);
  }
  Eigen::VectorXd values(size);
  for (int i = 0; i < size; ++i) {
    const YAML::Node element = node[i];
    if (!element.IsScalar() || !YAML::convert<double>::decode(element, values[i]) ||
        !std::isfinite(values[i])) {
      refuse(key, expected);
    }
  }
  return values;
}

void YamlFields::refuseUnknown() const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (!asked_.contains(key)) {
      throw InputError(file_.string() + ", line " + std::to_string(entry.first.Mark().line + 1) +
                       ": unknown field " + name_ + key);
    }
  }
}

YAML::Node YamlFields::require(const std::string& key) {
  asked_.insert(key);
  const YAML::Node node = std::as_const(node_)[key];
  if (!node) {
    throw InputError(file_.string() + ", line " + std::to_string(node_.Mark().line + 1) +
                     ": field " + name_ + key + " is missing");
  }
  return node;
}

void YamlFields::refuse(const std::string& key, const std::string& expected) const {
  throw InputError(file_.string() + ", line " + std::to_string(node_[key].Mark().line + 1) +
                   ": field " + name_ + key + ": expected " + expected);
}

}  // namespace ringhook

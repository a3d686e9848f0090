#include "core/yaml_fields.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <ios>
#include <set>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

std::string shortNumber(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// "a number from 0 to 5", or one-sided, or just a number.
std::string numberInWords(double low, double high) {
  const std::string from = low > -YamlFields::kAny ? " from " + shortNumber(low) : "";
  if (high < YamlFields::kAny) {
    return "a number" + from + " to " + shortNumber(high);
  }
  return "a number" + (from.empty() ? from : from + " on");
}

std::string wholeInWords(int low, int high) {
  return "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
}

bool isNumber(const YAML::Node& node, double& value) {
  return node.IsScalar() && YAML::convert<double>::decode(node, value) && std::isfinite(value);
}

YAML::Node load(const std::filesystem::path& file) {
  if (isFolder(file)) {  // opens, cannot be read, and yaml-cpp 0.7 then leaks
    throw InputError("cannot read " + file.string() + ": expected a YAML file");
  }
  try {
    return YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    throw InputError("cannot read " + file.string() + ": expected a YAML file");
  } catch (const YAML::Exception& e) {
    throw InputError(file.string() + ", line " + std::to_string(e.mark.line + 1) +
                     ": not valid YAML: " + e.msg);
  } catch (const std::ios_base::failure&) {  // opens but cannot be read
    throw InputError("cannot read " + file.string() + ": expected a YAML file");
  }
}

}  // namespace

struct YamlFields::State {
  State(std::filesystem::path file_in, std::string name_in, const YAML::Node& node_in)
      : file(std::move(file_in)), name(std::move(name_in)), node(node_in) {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      if (!seen.insert(entry.first.Scalar()).second) {
        fail(entry.first,
             "field " + name + entry.first.Scalar() + " stands twice: expected each field once");
      }
    }
  }

  [[noreturn]] void fail(const YAML::Node& at, const std::string& sentence) const {
    throw InputError(file.string() + ", line " + std::to_string(at.Mark().line + 1) + ": " +
                     sentence);
  }
  [[noreturn]] void refuse(const YAML::Node& at, const std::string& key,
                           const std::string& expected) const {
    fail(at, "field " + name + key + ": expected " + expected);
  }

  [[nodiscard]] YAML::Node find(const std::string& key) const { return std::as_const(node)[key]; }

  YAML::Node require(const std::string& key) {
    asked.insert(key);
    YAML::Node found = find(key);
    if (!found) {
      fail(node, "field " + name + key + " is missing");
    }
    return found;
  }

  /// Whether a field is there; it is known from now on.
  bool ask(const std::string& key) {
    asked.insert(key);
    return static_cast<bool>(find(key));
  }

  std::filesystem::path file;
  std::string name;  ///< of this mapping, with a dot behind it; empty at the top
  YAML::Node node;
  std::set<std::string> asked;
};

YamlFields::YamlFields(std::shared_ptr<State> state) : state_(std::move(state)) {}

YamlFields YamlFields::open(const std::filesystem::path& file) {
  const YAML::Node node = load(file);
  if (!node.IsMap()) {
    throw InputError(file.string() + ": expected a mapping of named fields at the top");
  }
  return YamlFields(std::make_shared<State>(file, "", node));
}

YamlFields YamlFields::section(const std::string& key) {
  const YAML::Node node = state_->require(key);
  if (!node.IsMap()) {
    refuse(key, "a mapping of fields");
  }
  return YamlFields(std::make_shared<State>(state_->file, state_->name + key + ".", node));
}

std::vector<YamlFields> YamlFields::list(const std::string& key) {
  const YAML::Node node = state_->require(key);
  if (!node.IsSequence() || node.size() == 0) {
    refuse(key, "a list of at least one mapping of fields");
  }
  std::vector<YamlFields> entries;
  for (const YAML::Node& entry : node) {
    const std::string name = key + "[" + std::to_string(entries.size()) + "]";
    if (!entry.IsMap()) {
      state_->refuse(entry, name, "a mapping of fields");
    }
    entries.push_back(
        YamlFields(std::make_shared<State>(state_->file, state_->name + name + ".", entry)));
  }
  return entries;
}

bool YamlFields::has(const std::string& key) const { return state_->ask(key); }

bool YamlFields::isMapping(const std::string& key) const {
  return has(key) && state_->find(key).IsMap();
}

std::string YamlFields::text(const std::string& key) {
  const YAML::Node node = state_->require(key);
  if (!node.IsScalar() || node.Scalar().empty()) {
    refuse(key, "a text");
  }
  return node.Scalar();
}

std::filesystem::path YamlFields::path(const std::string& key) {
  const std::filesystem::path named = text(key);
  return named.is_absolute() ? named : (state_->file.parent_path() / named).lexically_normal();
}

double YamlFields::number(const std::string& key, double low, double high) {
  double value = 0.0;
  if (!isNumber(state_->require(key), value) || value < low || value > high) {
    refuse(key, numberInWords(low, high));
  }
  return value;
}

int YamlFields::integer(const std::string& key, int low, int high) {
  const YAML::Node node = state_->require(key);
  int value = 0;
  if (!node.IsScalar() || !YAML::convert<int>::decode(node, value) || value < low || value > high) {
    refuse(key, wholeInWords(low, high));
  }
  return value;
}

Eigen::VectorXd YamlFields::vector(const std::string& key, int size) {
  const YAML::Node node = state_->require(key);
  const std::string expected = std::to_string(size) + " numbers in [ ]";
  if (!node.IsSequence() || static_cast<int>(node.size()) != size) {
    refuse(key, expected);
  }
  Eigen::VectorXd values(size);
  for (int i = 0; i < size; ++i) {
    if (!isNumber(node[i], values[i])) {
      refuse(key, expected);
    }
  }
  return values;
}

Pose YamlFields::pose(const std::string& key) {
  const Eigen::Matrix<double, 7, 1> v = vector(key, 7);
  if (std::abs(v.tail<4>().norm() - 1.0) > 0.01) {
    refuse(key, "x, y, z and a quaternion qx, qy, qz, qw of length 1");
  }
  return makePose(v.head<3>(), Eigen::Quaterniond(v[6], v[3], v[4], v[5]));
}

std::size_t YamlFields::choice(const std::string& key, const std::vector<std::string>& allowed) {
  const std::string said = text(key);
  const auto at = std::find(allowed.begin(), allowed.end(), said);
  if (at == allowed.end()) {
    std::string names;
    for (const std::string& name : allowed) {
      names += (names.empty() ? "" : ", ") + name;
    }
    refuse(key, (allowed.size() > 1 ? "one of " : "") + names + ", got " + said);
  }
  return static_cast<std::size_t>(at - allowed.begin());
}

void YamlFields::update(const std::string& key, double& value, double low, double high,
                        double unit) {
  value = state_->ask(key) ? number(key, low, high) * unit : value;
}

void YamlFields::update(const std::string& key, int& value, int low, int high) {
  value = state_->ask(key) ? integer(key, low, high) : value;
}

void YamlFields::update(const std::string& key, bool& value) {
  if (state_->ask(key) && !YAML::convert<bool>::decode(state_->find(key), value)) {
    refuse(key, "true or false");
  }
}

void YamlFields::update(const std::string& key, std::vector<double>& values, int most, double low,
                        double high) {
  if (!state_->ask(key)) {
    return;
  }
  const YAML::Node node = state_->find(key);
  const std::string expected =
      "at most " + std::to_string(most) + " numbers in [ ], each " + numberInWords(low, high);
  if (!node.IsSequence() || static_cast<int>(node.size()) > most) {
    refuse(key, expected);
  }
  values.clear();
  for (const YAML::Node& element : node) {
    double value = 0.0;
    if (!isNumber(element, value) || value < low || value > high) {
      refuse(key, expected);
    }
    values.push_back(value);
  }
}

void YamlFields::refuse(const std::string& key, const std::string& expected) const {
  state_->refuse(state_->find(key), key, expected);
}

void YamlFields::refuseWhole(const std::string& expected) const {
  const std::string& name = state_->name;
  state_->fail(state_->node,
               (name.empty() ? "" : "field " + name.substr(0, name.size() - 1) + ": ") +
                   "expected " + expected);
}

void YamlFields::refuseUnknown() const {
  std::string known;
  for (const std::string& key : state_->asked) {
    known += (known.empty() ? "" : ", ") + key;
  }
  const auto unknown = std::find_if(state_->node.begin(), state_->node.end(), [&](const auto& e) {
    return !state_->asked.contains(e.first.Scalar());
  });
  if (unknown != state_->node.end()) {
    const YAML::Node key = unknown->first;
    state_->fail(key, "unknown field " + state_->name + key.Scalar() + "; expected " + known);
  }
}

}  // namespace ringhook

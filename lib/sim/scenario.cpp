#include "sim/scenario.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kAny = std::numeric_limits<double>::max();

/// One key of a section: where its value goes, its unit, its range in the unit of the file.
struct Field {
  const char* key;
  double* value;
  double unit = 1.0;
  double lowest = 0.0;
  double highest = kAny;
};

struct CountField {
  const char* key;
  int* value;
  int lowest;
  int highest;
};

struct Section {
  const char* name;
  std::vector<Field> fields;
  std::vector<CountField> counts;
};

std::vector<Section> sections(CellOptions& c) {
  return {
      {"belt",
       {{"speed_m_s", &c.belt.speed, 1.0, 0.0, 1.0},
        {"speed_spread", &c.belt.speed_spread, 1.0, 0.0, 0.5},
        {"start_y_m", &c.belt.start_y, 1.0, -10.0, 10.0},
        {"entry_y_m", &c.belt.entry_y, 1.0, -10.0, 10.0}},
       {}},
      {"hook",
       {{"spacing_m", &c.hook.spacing, 1.0, 0.2, 10.0},
        {"swing_about_x_deg", &c.hook.swing_about_x, kDegree, 0.0, 30.0},
        {"swing_about_y_deg", &c.hook.swing_about_y, kDegree, 0.0, 30.0},
        {"length_spread", &c.hook.length_spread, 1.0, 0.0, 0.1},
        {"pivot_friction_N_m", &c.hook.pivot_friction, 1.0, 0.0, 0.1},
        {"pivot_damping_N_m_s", &c.hook.pivot_damping, 1.0, 0.0, 0.1},
        {"damping_spread", &c.hook.damping_spread, 1.0, 0.0, 0.9}},
       {{"count", &c.hook.count, 1, 100}}},
      {"ring",
       {{"clearance_m", &c.ring.clearance, 1.0, 0.0005, 0.05},
        {"friction", &c.ring.friction, 1.0, 0.0, 2.0}},
       {{"count", &c.ring.count, 1, 100}}},
      {"arm", {{"zero_error_sigma_deg", &c.arm.zero_error_sigma, kDegree, 0.0, 1.0}}, {}},
      {"gripper", {{"feeder_clearance_m", &c.gripper.feeder_clearance, 1.0, 0.0, 1.0}}, {}},
      {"air",
       {{"density_kg_m3", &c.air_density, 1.0, 0.0, 10.0},
        {"viscosity_Pa_s", &c.air_viscosity, 1.0, 0.0, 1.0}},
       {}},
  };
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {}

  Scenario read() {
    Scenario scenario;
    const YAML::Node root = load();
    if (!root.IsMap()) {
      refuse(root, "the file", "a map with the key name");
    }
    std::vector<Section> known = sections(scenario.cell);
    for (const auto& entry : root) {
      const std::string key = entry.first.Scalar();
      if (key == "name") {
        scenario.name = entry.second.IsScalar() ? entry.second.Scalar() : "";
      } else if (Section* section = find(known, key)) {
        readSection(entry.second, *section);
      } else {
        refuse(entry.first, key, "name, belt, hook, ring, arm, gripper or air");
      }
    }
    if (scenario.name.empty()) {
      refuse(root, "name", "the scenario's name as text");
    }
    return scenario;
  }

 private:
  YAML::Node load() {
    try {
      return YAML::LoadFile(path_.string());
    } catch (const YAML::BadFile&) {
      throw InputError(path_.string() + ": cannot be read; expected a scenario in YAML.");
    } catch (const YAML::Exception& e) {
      throw InputError(path_.string() + " line " + std::to_string(e.mark.line + 1) +
                       ": is not valid YAML (" + e.msg + ").");
    }
  }

  static Section* find(std::vector<Section>& known, const std::string& name) {
    for (Section& section : known) {
      if (name == section.name) {
        return &section;
      }
    }
    return nullptr;
  }

  void readSection(const YAML::Node& node, const Section& section) {
    if (!node.IsMap()) {
      refuse(node, section.name, "a map");
    }
    for (const auto& entry : node) {
      if (!readField(entry.first.Scalar(), entry.second, section)) {
        refuse(entry.first, std::string(section.name) + "." + entry.first.Scalar(),
               "a known key of " + std::string(section.name));
      }
    }
  }

  bool readField(const std::string& key, const YAML::Node& node, const Section& section) {
    const std::string name = std::string(section.name) + "." + key;
    for (const Field& field : section.fields) {
      if (key == field.key) {
        *field.value = number(node, name, field.lowest, field.highest) * field.unit;
        return true;
      }
    }
    for (const CountField& field : section.counts) {
      if (key == field.key) {
        const double value = number(node, name, field.lowest, field.highest);
        if (value != std::floor(value)) {
          refuse(node, name, "a whole number");
        }
        *field.value = static_cast<int>(value);
        return true;
      }
    }
    return false;
  }

  double number(const YAML::Node& node, const std::string& name, double lowest, double highest) {
    double value = 0.0;
    const std::string range =
        "a number from " + shortest(lowest) +
        (highest < kAny ? std::string(" to ").append(shortest(highest)) : " upwards");
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
        !(value >= lowest && value <= highest)) {
      refuse(node, name, range);
    }
    return value;
  }

  static std::string shortest(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& field,
                           const std::string& expected) {
    throw InputError(path_.string() + " line " + std::to_string(node.Mark().line + 1) + ": field " +
                     field + " is not usable here; expected " + expected + ".");
  }

  std::filesystem::path path_;
};

}  // namespace

Scenario loadScenario(const std::filesystem::path& path) { return Reader(path).read(); }

}  // namespace ringhook

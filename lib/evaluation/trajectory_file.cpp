#include "evaluation/trajectory_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "camera/csv_table.h"
#include "core/error.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

const Names kAngles = {"angle_rad", "angle2_rad"};
const Names kPoint = {"x", "y", "z"};
const Names kPivot = {"pivot_x", "pivot_y", "pivot_z"};
constexpr auto kTimeName = "time_s";

bool isKnown(const std::string& name) {
  const auto among = [&name](const Names& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return among(kAngles) || among(kPoint) || among(kPivot) || name == kTimeName;
}

/// The format's names as this file spells them.
class Columns {
 public:
  Columns(const CsvTable& table, const std::map<std::string, std::string>& spelled,
          std::string file)
      : table_(table), spelled_(spelled), file_(std::move(file)) {
    for (const auto& [name, column] : spelled) {
      if (!isKnown(name)) {
        throw InputError("--columns " + name + "=" + column +
                         ": expected one of time_s, angle_rad, angle2_rad, x, y, z, pivot_x, "
                         "pivot_y, pivot_z before the =");
      }
      static_cast<void>(table.column(column));
    }
  }

  [[nodiscard]] bool has(const std::string& name) const { return table_.has(columnOf(name)); }
  [[nodiscard]] bool hasAny(const Names& names) const {
    return std::any_of(names.begin(), names.end(), [this](const auto& name) { return has(name); });
  }
  /// Throws if a part of them is missing.
  [[nodiscard]] bool hasAll(const Names& names) const {
    for (const auto& name : names) {
      if (hasAny(names) && !has(name)) {
        throw InputError(file_ + " line 1: expected a column " + columnOf(name) + " beside " +
                         "the others of its point");
      }
    }
    return hasAny(names);
  }
  [[nodiscard]] std::size_t index(const std::string& name) const {
    return table_.column(columnOf(name));
  }

 private:
  [[nodiscard]] std::string columnOf(const std::string& name) const {
    const auto found = spelled_.find(name);
    return found == spelled_.end() ? name : found->second;
  }
  const CsvTable& table_;
  const std::map<std::string, std::string>& spelled_;
  std::string file_;
};

TrajectoryKind kindOf(const Columns& columns, const std::string& file) {
  const bool angles = columns.hasAny(kAngles);
  const bool point = columns.hasAll(kPoint);
  const bool pivot = columns.hasAll(kPivot);
  if (angles == point) {
    throw InputError(file + " line 1: expected either angle_rad[,angle2_rad] or x,y,z in the " +
                     "header, found " + (angles ? "both" : "neither"));
  }
  if (point) {
    return pivot ? TrajectoryKind::kPointAndPivot : TrajectoryKind::kPoint;
  }
  if (!columns.has(kAngles.front())) {
    throw InputError(file + " line 1: expected a column angle_rad beside angle2_rad");
  }
  return columns.has(kAngles.back()) ? TrajectoryKind::kTwoAngles : TrajectoryKind::kAngle;
}

Names namesOf(TrajectoryKind kind) {
  Names names = predictedNames(kind);
  if (kind == TrajectoryKind::kPointAndPivot) {
    names.insert(names.end(), kPivot.begin(), kPivot.end());
  }
  return names;
}

std::vector<Time> timesOf(const CsvTable& table, const Columns& columns,
                          const std::optional<double>& rate_hz, const std::string& file) {
  if (columns.has(kTimeName) == rate_hz.has_value()) {
    throw InputError(file + " line 1: expected " +
                     (rate_hz ? "no column time_s beside --rate"
                              : "a column time_s, or --rate for a file without"));
  }
  std::vector<Time> times;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (rate_hz) {
      times.push_back(Time::fromSeconds(static_cast<double>(row) / *rate_hz));
      continue;
    }
    const std::size_t column = columns.index(kTimeName);
    const double seconds = table.number(row, column);
    if (std::abs(seconds) > 9e9) {  // the clock's nanoseconds end there
      throw InputError(table.where(row, column) + ": expected a time in seconds");
    }
    times.push_back(Time::fromSeconds(seconds));
    if (row > 0 && times[row] <= times[row - 1]) {
      throw InputError(table.where(row, column) + ": time must grow from line to line");
    }
  }
  return times;
}

double sampleNumber(const CsvTable& table, std::size_t row, std::size_t column) {
  constexpr double kBeyond = 1e6;
  const double number = table.number(row, column);
  if (std::abs(number) > kBeyond) {
    throw InputError(table.where(row, column) +
                     ": expected radians or metres, at most 1e6, found " + table.text(row, column));
  }
  return number;
}

}  // namespace

Names predictedNames(TrajectoryKind kind) {
  return isAngular(kind) ? Names(kAngles.begin(), kAngles.begin() + predictedSize(kind)) : kPoint;
}

Trajectory readTrajectory(const fs::path& file, const TrajectoryFileOptions& options) {
  if (options.rate_hz && !(*options.rate_hz > 0.0 && *options.rate_hz <= 1e6)) {
    throw InputError("--rate: expected samples per second, above 0 and at most 1e6");
  }
  const CsvTable table(file);
  const Columns columns(table, options.columns, file.string());
  Trajectory trajectory;
  trajectory.name = file.stem().string();
  trajectory.kind = kindOf(columns, file.string());
  trajectory.times = timesOf(table, columns, options.rate_hz, file.string());
  if (trajectory.times.size() < 2) {
    throw InputError(file.string() + " holds fewer than two samples");
  }
  const Names names = namesOf(trajectory.kind);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Eigen::VectorXd value(static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      value(static_cast<Eigen::Index>(i)) = sampleNumber(table, row, columns.index(names[i]));
    }
    trajectory.values.push_back(std::move(value));
  }
  return trajectory;
}

std::size_t repeatedSamples(const Trajectory& trajectory) {
  return trajectory.values.size() - withoutRepeated(trajectory).values.size();
}

Trajectory withoutRepeated(const Trajectory& trajectory) {
  Trajectory fresh{trajectory.name, trajectory.kind, {}, {}};
  for (std::size_t i = 0; i < trajectory.values.size(); ++i) {
    if (i == 0 || trajectory.values[i] != trajectory.values[i - 1]) {
      fresh.times.push_back(trajectory.times[i]);
      fresh.values.push_back(trajectory.values[i]);
    }
  }
  return fresh;
}

double medianStep(const Trajectory& trajectory) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < trajectory.times.size(); ++i) {
    steps.push_back(trajectory.times[i] - trajectory.times[i - 1]);
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace ringhook

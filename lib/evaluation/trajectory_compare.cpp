#include "evaluation/trajectory_compare.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "camera/csv_table.h"
#include "core/error.h"
#include "evaluation/trajectory_io.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTum = 8;
constexpr std::size_t kKitti = 12;

bool isBlank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with("#");
}

std::size_t wordsIn(const std::string& line) {
  std::istringstream stream(line);
  std::string word;
  std::size_t count = 0;
  while (stream >> word) {
    ++count;
  }
  return count;
}

/// Of the first line that has any; throws if there is none.
std::size_t numbersInLine(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError("cannot read " + file.string() + ": expected a TUM or KITTI trajectory");
  }
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (isBlank(line)) {
      continue;
    }
    const std::size_t count = wordsIn(line);
    if (count != kTum && count != kKitti) {
      throw InputError(file.string() + " line " + std::to_string(number) +
                       ": expected the 8 numbers of TUM or the 12 of KITTI, found " +
                       std::to_string(count));
    }
    return count;
  }
  throw InputError(file.string() + " holds no pose: expected a TUM or KITTI trajectory");
}

Eigen::Vector3d kittiPosition(const std::string& line, const std::string& where) {
  const std::vector<double> v = numbersOfLine(line, where);
  if (v.size() != kKitti) {
    throw InputError(where + ": expected 12 numbers as in the first line, found " +
                     std::to_string(v.size()));
  }
  Eigen::Matrix3d R;
  R << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
  if (!((R.transpose() * R).isApprox(Eigen::Matrix3d::Identity(), 0.01) && R.determinant() > 0.0)) {
    throw InputError(where + ": expected a rotation in columns 1 to 3 of the three rows");
  }
  return {v[3], v[7], v[11]};
}

PositionTrack readKitti(const fs::path& file) {
  std::ifstream stream(file);
  PositionTrack track;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!isBlank(line)) {
      track.positions.push_back(
          kittiPosition(line, file.string() + " line " + std::to_string(number)));
    }
  }
  return track;
}

PositionTrack readTimed(const fs::path& file) {
  PositionTrack track;
  track.timed = true;
  for (const StampedPose& pose : readTum(file)) {
    track.times.push_back(pose.time);
    track.positions.emplace_back(pose.pose.translation());
  }
  return track;
}

/// Index of the time nearest to `time`. Precondition: times not empty.
std::size_t nearest(const std::vector<Time>& times, Time time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) {
    return 0;
  }
  if (after == times.end() || *after - time > time - *(after - 1)) {
    return static_cast<std::size_t>(after - times.begin()) - 1;
  }
  return static_cast<std::size_t>(after - times.begin());
}

using Indices = std::vector<std::pair<std::size_t, std::size_t>>;  // reference, estimate

Indices nearestPairs(const PositionTrack& reference, const PositionTrack& estimate,
                     double tolerance_s) {
  Indices pairs;
  for (std::size_t i = 0; i < estimate.times.size(); ++i) {
    const std::size_t j = nearest(reference.times, estimate.times[i]);
    const bool close = std::abs(reference.times[j] - estimate.times[i]) <= tolerance_s;
    if (close && nearest(estimate.times, reference.times[j]) == i) {
      pairs.emplace_back(j, i);
    }
  }
  return pairs;
}

/// 4x4 that lays the estimate on the reference.
Eigen::Matrix4d alignmentOf(const PositionPairs& pairs, Alignment alignment) {
  if (alignment == Alignment::kNone) {
    return Eigen::Matrix4d::Identity();
  }
  for (const Eigen::Matrix3Xd& points : {pairs.reference, pairs.estimate}) {
    const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
    const Eigen::Matrix3d spread = centred * centred.transpose();
    const Eigen::Vector3d sizes =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread, Eigen::EigenvaluesOnly)
            .eigenvalues();
    if (!(sizes(1) > 1e-12 * sizes(2))) {
      throw InputError(
          "--align: the positions stand in one place or line and leave it open; use "
          "--align none");
    }
  }
  return Eigen::umeyama(pairs.estimate, pairs.reference, alignment == Alignment::kSim3);
}

}  // namespace

PositionTrack readPositionTrack(const fs::path& file) {
  PositionTrack track = numbersInLine(file) == kTum ? readTimed(file) : readKitti(file);
  constexpr double kBeyond = 1e9;
  for (const Eigen::Vector3d& position : track.positions) {
    if (!position.allFinite() || position.cwiseAbs().maxCoeff() > kBeyond) {
      throw InputError(file.string() + ": expected positions in metres, at most 1e9");
    }
  }
  return track;
}

PositionPairs pairTracks(const PositionTrack& reference, const PositionTrack& estimate,
                         double tolerance_s) {
  if (reference.timed != estimate.timed) {
    throw InputError("expected two trajectories of one format, found a TUM and a KITTI one");
  }
  Indices indices;
  if (reference.timed) {
    indices = nearestPairs(reference, estimate, tolerance_s);
  } else if (reference.positions.size() != estimate.positions.size()) {
    throw InputError("expected as many lines in both KITTI files, found " +
                     std::to_string(reference.positions.size()) + " and " +
                     std::to_string(estimate.positions.size()));
  }
  for (std::size_t i = 0; !reference.timed && i < reference.positions.size(); ++i) {
    indices.emplace_back(i, i);
  }
  constexpr std::size_t kFewest = 3;
  if (indices.size() < kFewest) {
    throw InputError("expected at least 3 poses of the same instants, found " +
                     std::to_string(indices.size()));
  }
  PositionPairs pairs{Eigen::Matrix3Xd(3, indices.size()), Eigen::Matrix3Xd(3, indices.size())};
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    pairs.reference.col(column) = reference.positions[indices[i].first];
    pairs.estimate.col(column) = estimate.positions[indices[i].second];
  }
  return pairs;
}

Alignment alignmentFromText(const std::string& text) {
  if (text == "none") {
    return Alignment::kNone;
  }
  if (text == "se3") {
    return Alignment::kSe3;
  }
  if (text == "sim3") {
    return Alignment::kSim3;
  }
  throw InputError("--align " + text + ": expected none, se3 or sim3");
}

TrackError trackError(const PositionPairs& pairs, Alignment alignment) {
  const Eigen::Matrix4d M = alignmentOf(pairs, alignment);
  const Eigen::Matrix3Xd aligned =
      (M.topLeftCorner<3, 3>() * pairs.estimate).colwise() + M.topRightCorner<3, 1>();
  Eigen::VectorXd distances = (aligned - pairs.reference).colwise().norm();
  std::sort(distances.begin(), distances.end());
  const Eigen::Index n = distances.size();
  TrackError error;
  error.pairs = static_cast<std::size_t>(n);
  error.scale = M.topLeftCorner<3, 1>().norm();
  error.rmse_m = std::sqrt(distances.squaredNorm() / static_cast<double>(n));
  error.mean_m = distances.mean();
  error.median_m = 0.5 * (distances((n - 1) / 2) + distances(n / 2));
  error.std_m = std::sqrt((distances.array() - error.mean_m).square().mean());
  error.min_m = distances(0);
  error.max_m = distances(n - 1);
  return error;
}

std::string trackErrorJson(const TrackError& error, Alignment alignment) {
  constexpr const char* kNames[] = {"none", "se3", "sim3"};
  nlohmann::ordered_json json{{"rmse_m", error.rmse_m},     {"mean_m", error.mean_m},
                              {"median_m", error.median_m}, {"std_m", error.std_m},
                              {"min_m", error.min_m},       {"max_m", error.max_m},
                              {"pairs", error.pairs}};
  json["alignment"] = kNames[static_cast<int>(alignment)];
  if (alignment == Alignment::kSim3) {
    json["scale"] = error.scale;
  }
  return json.dump(2) + "\n";
}

}  // namespace ringhook

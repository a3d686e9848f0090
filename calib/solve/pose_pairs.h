#pragma once

/// \file
/// Pairs of poses from which a camera and a robot are brought together: where the robot says its
/// flange is, and where the camera sees a target, at one instant of standstill.
///
/// One law serves both set-ups. Call the camera's holder h (eye-to-hand: the robot reference f;
/// eye-in-hand: the flange e) and the target's holder j (the other one). Then for every pair
///   cMt = hMc^-1 * hMj * jMt,   hMj = fMe (eye-to-hand) or fMe^-1 (eye-in-hand),
/// with two constant unknowns, hMc (wanted) and jMt (comes out too): the equation A X = Z B of
/// Zhuang, Roth, Sudhakar (IEEE Trans. Robotics and Automation 10, 1994). Seen this way a wrong
/// set-up and inverted robot poses are one and the same mistake.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"

namespace ringhook {

enum class EyeSetup {
  kEyeToHand,  ///< camera fixed, target on the flange
  kEyeInHand,  ///< camera on the flange, target fixed
};

/// Reads eye-to-hand or eye-in-hand. Throws InputError saying what was expected.
EyeSetup parseSetup(const std::string& text);

struct PosePair {
  std::string name;  ///< for messages: "pairs.csv line 5", an image's file name
  Pose fMe;          ///< flange in the robot reference
  Pose cMt;          ///< target in the (left) camera
  /// Of the small twist d in cMt * exp(d), at and in t, if vision told [m^2, rad^2].
  std::optional<Covariance6> covariance;
};

/// Both unknowns.
struct HandEye {
  Pose camera = Pose::Identity();  ///< fMc1 (eye-to-hand) or eMc1 (eye-in-hand)
  Pose target = Pose::Identity();  ///< eMt (eye-to-hand) or fMt (eye-in-hand)
};

/// hMj of the law above.
Pose holderPose(const PosePair& pair, EyeSetup setup);

/// Where the camera should see the target of this pair: cMt.
Pose predictedTarget(const HandEye& pose, const PosePair& pair, EyeSetup setup);

/// A position farther away than this is taken for millimetres [m].
constexpr double kFarthestPosition = 20.0;

/// Reads pairs.csv (doc/formats.md). Throws InputError naming file, line and column: what CsvTable
/// refuses, no rows, quaternions not of length 1, positions that look like millimetres, angles in
/// place of quaternions.
std::vector<PosePair> readPosePairs(const std::filesystem::path& file);

}  // namespace ringhook

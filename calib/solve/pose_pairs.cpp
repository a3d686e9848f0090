#include "calib/solve/pose_pairs.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "calib/solve/pose_table.h"
#include "core/error.h"

namespace ringhook {

EyeSetup parseSetup(const std::string& text) {
  if (text == "eye-to-hand") {
    return EyeSetup::kEyeToHand;
  }
  if (text == "eye-in-hand") {
    return EyeSetup::kEyeInHand;
  }
  throw InputError("--setup " + text +
                   ": expected eye-to-hand (camera fixed, target on the flange) or eye-in-hand "
                   "(camera on the flange, target fixed)");
}

Pose holderPose(const PosePair& pair, EyeSetup setup) {
  return setup == EyeSetup::kEyeToHand ? pair.fMe : pair.fMe.inverse();
}

Pose predictedTarget(const HandEye& pose, const PosePair& pair, EyeSetup setup) {
  return pose.camera.inverse() * holderPose(pair, setup) * pose.target;
}

std::vector<PosePair> readPosePairs(const std::filesystem::path& file) {
  const CsvTable table(file);
  const PoseColumns robot(table, "robot_");
  const PoseColumns target(table, "target_");
  requireRows(table, file);
  std::vector<PosePair> pairs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    PosePair pair;
    pair.fMe = robot.read(row);
    pair.cMt = target.read(row);
    pair.name = rowName(table, row);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace ringhook

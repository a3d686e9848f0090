#include "pair_scene.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace ringhook {
namespace {

using Eigen::Vector3d;

Vector3d uniform(std::mt19937_64& dice, double most) {
  std::uniform_real_distribution<double> draw(-most, most);
  return {draw(dice), draw(dice), draw(dice)};
}

Vector3d normal(std::mt19937_64& dice) {
  std::normal_distribution<double> draw;
  return {draw(dice), draw(dice), draw(dice)};
}

Pose turned(const Vector3d& position, const Eigen::Matrix3d& rotation) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation;
  pose.translation() = position;
  return pose;
}

// Noise of the seen target: its position along and across the line of sight, its orientation.
Pose disturbed(const Pose& cMt, const PairScene& scene, std::mt19937_64& dice) {
  const Vector3d sight = cMt.translation().normalized();
  const Vector3d n = scene.translation_m * normal(dice);
  const Vector3d shift = n + (scene.depth_factor - 1.0) * sight * sight.dot(n);
  const Vector3d turn = scene.rotation_rad * normal(dice);
  return turned(cMt.translation() + shift,
                cMt.linear() * makePoseThetaU(Vector3d::Zero(), turn).linear());
}

}  // namespace

double mahalanobis2(const HandEye& pose, const Eigen::Matrix<double, 12, 12>& covariance,
                    const HandEye& truth) {
  Eigen::Matrix<double, 12, 1> e;
  e << logSe3(pose.camera.inverse() * truth.camera), logSe3(pose.target.inverse() * truth.target);
  return e.dot(covariance.ldlt().solve(e));
}

Eigen::Matrix3d randomRotation(std::mt19937_64& dice, double most) {
  std::uniform_real_distribution<double> draw(0.0, most);
  const Vector3d axis = normal(dice).normalized();
  return makePoseThetaU(Vector3d::Zero(), draw(dice) * axis).linear();
}

MadePairs makePairs(const PairScene& scene, std::mt19937_64& dice) {
  MadePairs made;
  const bool to_hand = scene.setup == EyeSetup::kEyeToHand;
  made.truth.camera =
      to_hand ? turned({1.5, 0.1, 0.8}, randomRotation(dice, 3.0))
              : turned(Vector3d(0.05, 0.0, 0.1) + uniform(dice, 0.05), randomRotation(dice, 3.0));
  // The target hangs about a metre in front of the camera in the first pose.
  const Pose cMt_first =
      turned(Vector3d(0, 0, 1.0) + uniform(dice, 0.15), randomRotation(dice, 0.6));
  const Pose fMe_first =
      turned(Vector3d(0.4, 0.0, 0.6) + uniform(dice, 0.1), randomRotation(dice, 3.0));
  const PosePair first{"", fMe_first, cMt_first, std::nullopt};
  made.truth.target = holderPose(first, scene.setup).inverse() * made.truth.camera * cMt_first;
  const Eigen::Matrix3d main_axis = randomRotation(dice, 3.0);
  for (int i = 0; i < scene.pairs; ++i) {
    Vector3d turn = uniform(dice, scene.turn_rad);
    turn.head<2>() *= scene.axis_spread;
    PosePair pair;
    pair.name = "pair " + std::to_string(i);
    pair.fMe = fMe_first * turned(uniform(dice, scene.travel_m),
                                  makePoseThetaU(Vector3d::Zero(), main_axis * turn).linear());
    pair.cMt = disturbed(predictedTarget(made.truth, pair, scene.setup), scene, dice);
    made.pairs.push_back(pair);
  }
  made.wrong.assign(made.pairs.size(), false);
  const auto wrong = static_cast<std::size_t>(std::lround(scene.wrong_share * scene.pairs));
  for (std::size_t i = 0; i < wrong; ++i) {
    made.wrong[i] = true;
    made.pairs[i].cMt = turned(made.pairs[i].cMt.translation() + uniform(dice, 0.1),
                               made.pairs[i].cMt.linear() * randomRotation(dice, 0.5));
  }
  for (int i = 0; i < scene.swapped; ++i) {
    const auto k = made.pairs.size() - 1 - 2 * static_cast<std::size_t>(i);
    std::swap(made.pairs[k].cMt, made.pairs[k - 1].cMt);
    made.wrong[k] = made.wrong[k - 1] = true;
  }
  return made;
}

}  // namespace ringhook

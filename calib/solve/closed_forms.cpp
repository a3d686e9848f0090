#include "calib/solve/closed_forms.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <opencv2/calib3d.hpp>

namespace ringhook {
namespace {

struct Motions {
  std::vector<cv::Mat> rotation;
  std::vector<cv::Mat> translation;

  void add(const Pose& aMb) {
    const Eigen::Matrix3d R = aMb.linear();
    const Eigen::Vector3d t = aMb.translation();
    rotation.push_back((cv::Mat_<double>(3, 3) << R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1),
                        R(1, 2), R(2, 0), R(2, 1), R(2, 2)));
    translation.push_back((cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z()));
  }
};

// The rotation nearest to what a solver returned; nothing if that is none.
std::optional<Pose> poseFrom(const cv::Mat& rotation, const cv::Mat& translation) {
  if (rotation.rows != 3 || rotation.cols != 3 || translation.total() != 3) {
    return std::nullopt;
  }
  cv::Mat_<double> R(rotation);
  cv::Mat_<double> t(translation);
  Eigen::Matrix3d m;
  for (int i = 0; i < 9; ++i) {
    m(i / 3, i % 3) = R(i / 3, i % 3);
  }
  const Eigen::Vector3d p(t(0), t(1), t(2));
  if (!m.allFinite() || !p.allFinite()) {
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  if (nearest.determinant() < 0.0 || (nearest - m).norm() > 0.5) {
    return std::nullopt;
  }
  Pose pose = Pose::Identity();
  pose.linear() = nearest;
  pose.translation() = p;
  return pose;
}

// jMt as every pair tells it, given the camera; the mean rotation by its chordal distance.
Pose meanTarget(const Pose& camera, const std::vector<PosePair>& pairs, EyeSetup setup) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    const Pose jMt = holderPose(pair, setup).inverse() * camera * pair.cMt;
    sum += jMt.linear();
    position += jMt.translation() / static_cast<double>(pairs.size());
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d turn(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  Pose target = Pose::Identity();
  target.linear() = svd.matrixU() * turn.asDiagonal() * svd.matrixV().transpose();
  target.translation() = position;
  return target;
}

// X of A_i X B_i = constant: the camera in its holder.
std::optional<HandEye> cameraFirst(cv::HandEyeCalibrationMethod method,
                                   const std::vector<PosePair>& pairs, EyeSetup setup) {
  Motions robot;
  Motions target;
  for (const PosePair& pair : pairs) {
    robot.add(holderPose(pair, setup).inverse());
    target.add(pair.cMt);
  }
  cv::Mat R;
  cv::Mat t;
  cv::calibrateHandEye(robot.rotation, robot.translation, target.rotation, target.translation, R, t,
                       method);
  const auto camera = poseFrom(R, t);
  if (!camera) {
    return std::nullopt;
  }
  return HandEye{*camera, meanTarget(*camera, pairs, setup)};
}

// Both at once: cMt * (tMj) = (cMh) * hMj, OpenCV's world = t, cam = c, base = j, gripper = h.
std::optional<HandEye> bothAtOnce(cv::RobotWorldHandEyeCalibrationMethod method,
                                  const std::vector<PosePair>& pairs, EyeSetup setup) {
  Motions robot;
  Motions target;
  for (const PosePair& pair : pairs) {
    robot.add(holderPose(pair, setup));
    target.add(pair.cMt);
  }
  cv::Mat Rt;
  cv::Mat tt;
  cv::Mat Rc;
  cv::Mat tc;
  cv::calibrateRobotWorldHandEye(target.rotation, target.translation, robot.rotation,
                                 robot.translation, Rt, tt, Rc, tc, method);
  const auto tMj = poseFrom(Rt, tt);
  const auto cMh = poseFrom(Rc, tc);
  if (!tMj || !cMh) {
    return std::nullopt;
  }
  return HandEye{cMh->inverse(), tMj->inverse()};
}

}  // namespace

const std::vector<ClosedForm>& closedForms() {
  static const std::vector<ClosedForm> all{
      ClosedForm::kTsai,       ClosedForm::kPark, ClosedForm::kHoraud, ClosedForm::kAndreff,
      ClosedForm::kDaniilidis, ClosedForm::kShah, ClosedForm::kLi};
  return all;
}

std::string toString(ClosedForm form) {
  static const std::array<const char*, 7> names{"Tsai",       "Park", "Horaud", "Andreff",
                                                "Daniilidis", "Shah", "Li"};
  return names.at(static_cast<std::size_t>(form));
}

std::optional<HandEye> solveClosedForm(ClosedForm form, const std::vector<PosePair>& pairs,
                                       EyeSetup setup) {
  if (pairs.size() < 3) {
    return std::nullopt;
  }
  try {
    switch (form) {
      case ClosedForm::kTsai:
        return cameraFirst(cv::CALIB_HAND_EYE_TSAI, pairs, setup);
      case ClosedForm::kPark:
        return cameraFirst(cv::CALIB_HAND_EYE_PARK, pairs, setup);
      case ClosedForm::kHoraud:
        return cameraFirst(cv::CALIB_HAND_EYE_HORAUD, pairs, setup);
      case ClosedForm::kAndreff:
        return cameraFirst(cv::CALIB_HAND_EYE_ANDREFF, pairs, setup);
      case ClosedForm::kDaniilidis:
        return cameraFirst(cv::CALIB_HAND_EYE_DANIILIDIS, pairs, setup);
      case ClosedForm::kShah:
        return bothAtOnce(cv::CALIB_ROBOT_WORLD_HAND_EYE_SHAH, pairs, setup);
      case ClosedForm::kLi:
        return bothAtOnce(cv::CALIB_ROBOT_WORLD_HAND_EYE_LI, pairs, setup);
    }
  } catch (const cv::Exception&) {
    return std::nullopt;  // singular inside: this solver has no answer
  }
  return std::nullopt;
}

}  // namespace ringhook

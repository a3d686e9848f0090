#include "servo/visp_law.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpAdaptiveGain.h>
#include <visp3/vs/vpServo.h>

#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

vpHomogeneousMatrix toVisp(const Pose& aMb) {
  vpHomogeneousMatrix m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      m[static_cast<unsigned int>(row)][column] = aMb(row, column);
    }
  }
  return m;
}

}  // namespace

/// vpServo keeps pointers to its features: they live and die together.
struct VispLaw::Task {
  vpFeatureTranslation translation{vpFeatureTranslation::cdMc};
  vpFeatureThetaU rotation{vpFeatureThetaU::cdRc};
  vpServo servo;

  explicit Task(const vpAdaptiveGain& gain) {
    servo.setServo(vpServo::EYEINHAND_CAMERA);
    servo.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
    servo.setLambda(gain);
    servo.addFeature(translation);
    servo.addFeature(rotation);
  }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
  ~Task() { servo.kill(); }
};

VispLaw::VispLaw(double gain_at_zero, double gain_at_infinity, double slope_at_zero) {
  try {
    task_ = std::make_unique<Task>(vpAdaptiveGain(gain_at_zero, gain_at_infinity, slope_at_zero));
  } catch (const vpException& failure) {
    throw Error(std::string("ViSP refused the servo task: ") + failure.what());
  }
}

VispLaw::~VispLaw() = default;
VispLaw::VispLaw(VispLaw&&) noexcept = default;
VispLaw& VispLaw::operator=(VispLaw&&) noexcept = default;

VispLaw::Feedback VispLaw::feedback(const Pose& dMr) {
  try {
    const vpHomogeneousMatrix cdMc = toVisp(dMr);
    task_->translation.buildFrom(cdMc);
    task_->rotation.buildFrom(cdMc);
    const vpColVector v = task_->servo.computeControlLaw();
    return {Eigen::Map<const Twist>(v.data), task_->servo.lambda.getLastValue()};
  } catch (const vpException& failure) {
    throw Error(std::string("ViSP's servo law failed: ") + failure.what());
  }
}

}  // namespace ringhook

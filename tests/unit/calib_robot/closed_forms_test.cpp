// Closed forms against made-up truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/solve/closed_forms.h"
#include "calib/solve/hand_eye_fit.h"
#include "pair_scene.h"

namespace ringhook {
namespace {

PairScene exactScene(EyeSetup setup) {
  PairScene scene;
  scene.setup = setup;
  scene.translation_m = 0.0;
  scene.rotation_rad = 0.0;
  return scene;
}

TEST(ClosedForms, EachIsExactOnExactPairsInBothSetups) {
  for (const EyeSetup setup : {EyeSetup::kEyeToHand, EyeSetup::kEyeInHand}) {
    std::mt19937_64 dice(3);
    const MadePairs made = makePairs(exactScene(setup), dice);
    for (const ClosedForm form : closedForms()) {
      const auto pose = solveClosedForm(form, made.pairs, setup);
      ASSERT_TRUE(pose) << toString(form);
      EXPECT_LT((pose->camera.matrix() - made.truth.camera.matrix()).norm(), 1e-6)
          << toString(form);
      EXPECT_LT((pose->target.matrix() - made.truth.target.matrix()).norm(), 1e-6)
          << toString(form);
    }
  }
}

TEST(ClosedForms, NoneSurvivesAFewWrongPairs) {
  PairScene scene;
  scene.wrong_share = 0.2;
  std::mt19937_64 dice(5);
  const MadePairs made = makePairs(scene, dice);
  for (const ClosedForm form : closedForms()) {
    const auto pose = solveClosedForm(form, made.pairs, scene.setup);
    if (pose) {
      EXPECT_GT((pose->camera.translation() - made.truth.camera.translation()).norm(), 0.005)
          << toString(form);
    }
  }
}

TEST(ClosedForms, RefuseTwoPairs) {
  std::mt19937_64 dice(3);
  MadePairs made = makePairs(exactScene(EyeSetup::kEyeToHand), dice);
  made.pairs.resize(2);
  for (const ClosedForm form : closedForms()) {
    EXPECT_FALSE(solveClosedForm(form, made.pairs, EyeSetup::kEyeToHand)) << toString(form);
  }
}

}  // namespace
}  // namespace ringhook

#include "calib/solve/hand_eye_starts.h"

#include <algorithm>
#include <array>
#include <functional>
#include <random>

namespace ringhook {
namespace {

constexpr int kSubsetsPerConvention = 20;
constexpr std::size_t kSubset = 4;
constexpr double kExactFit = 1e-7;  // [m]; below it ratios of errors are ratios of roundings

std::vector<PosePair> drawSubset(const std::vector<PosePair>& pairs, std::mt19937_64& dice) {
  std::vector<std::size_t> order(pairs.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::vector<PosePair> subset;
  for (std::size_t i = 0; i < std::min(kSubset, order.size()); ++i) {
    std::swap(order[i], order[i + dice() % (order.size() - i)]);
    subset.push_back(pairs[order[i]]);
  }
  return subset;
}

// The pose that a quaternion in the order w, x, y, z gives when it is read as x, y, z, w.
Pose otherOrder(const Pose& aMb) {
  const Eigen::Quaterniond q(aMb.linear());
  return makePose(aMb.translation(), Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()));
}

struct Reading {
  std::string words;
  bool inverts = false;
  std::function<Pose(const Pose&)> read;
};

std::vector<Reading> readings(const std::string& whose, const std::string& inverse) {
  const auto same = [](const Pose& M) { return M; };
  const auto inverted = [](const Pose& M) { return M.inverse(); };
  const auto both = [](const Pose& M) { return otherOrder(M).inverse(); };
  const std::string order = whose + " quaternions are in the order w, x, y, z";
  return {{"", false, same},
          {inverse, true, inverted},
          {order, false, otherOrder},
          {order + " and " + inverse, true, both}};
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() ? b : (b.empty() ? a : a + " and " + b);
}

void consider(const std::vector<PosePair>& pairs, EyeSetup setup, const std::string& words,
              Convention& best) {
  const auto starts = handEyeStarts(pairs, setup, {ClosedForm::kPark}, kSubsetsPerConvention);
  if (!starts.empty() && starts.front().median_m < best.median_m) {
    best = {words, starts.front().median_m};
  }
}

void considerShift(const std::vector<PosePair>& pairs, EyeSetup setup, bool earlier,
                   Convention& best) {
  std::vector<PosePair> shifted(pairs.begin(), pairs.end() - 1);
  for (std::size_t i = 0; i < shifted.size(); ++i) {
    shifted[i].fMe = pairs[earlier ? i : i + 1].fMe;
    shifted[i].cMt = pairs[earlier ? i + 1 : i].cMt;
  }
  consider(shifted, setup,
           std::string("each target pose belongs to the robot pose one row ") +
               (earlier ? "before" : "after") + " it",
           best);
}

}  // namespace

std::vector<Start> handEyeStarts(const std::vector<PosePair>& pairs, EyeSetup setup,
                                 const std::vector<ClosedForm>& forms, int subsets) {
  std::vector<Start> starts;
  for (const ClosedForm form : forms) {
    if (const auto pose = solveClosedForm(form, pairs, setup)) {
      starts.push_back({*pose, medianError(*pose, pairs, setup), toString(form)});
    }
  }
  std::mt19937_64 dice(1);
  for (int i = 0; i < subsets && pairs.size() > kSubset; ++i) {
    if (const auto pose = solveClosedForm(ClosedForm::kPark, drawSubset(pairs, dice), setup)) {
      starts.push_back({*pose, medianError(*pose, pairs, setup), "Park on four pairs"});
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.median_m < b.median_m; });
  return starts;
}

Convention betterConvention(const std::vector<PosePair>& pairs, EyeSetup setup, double median_m) {
  Convention best{"", std::max(median_m, kExactFit) / kConventionGain};
  const std::string swapped = setup == EyeSetup::kEyeToHand ? "eye-in-hand" : "eye-to-hand";
  const auto robot =
      readings("the robot's", "the robot poses are inverted (or the set-up is " + swapped + ")");
  const auto target = readings("the target's", "the target poses are inverted");
  for (const Reading& r : robot) {
    for (const Reading& t : target) {
      std::vector<PosePair> changed = pairs;
      for (PosePair& pair : changed) {
        pair.fMe = r.read(pair.fMe);
        pair.cMt = t.read(pair.cMt);
      }
      const std::string words = joined(r.words, t.words);
      // Both inverted is the same problem with camera and target exchanged: no pairs can tell.
      if (!words.empty() && !(r.inverts && t.inverts)) {
        consider(changed, setup, words, best);
      }
    }
  }
  considerShift(pairs, setup, true, best);
  considerShift(pairs, setup, false, best);
  return best.words.empty() ? Convention{"", median_m} : best;
}

}  // namespace ringhook

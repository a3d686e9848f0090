// Robot-camera calibration on made-up sets of every difficulty, against the truth: how often an
// accepted answer is wrong, how often a good one is refused, and how each closed form fares alone.
//   hand_eye_campaign --seeds 1000

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>

#include "../unit/calib_robot/pair_scene.h"
#include "calib/solve/hand_eye.h"
#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kWrong = 0.005;  // [m]

struct Tally {
  int sets = 0;
  int accepted = 0;
  int accepted_wrong = 0;
  int refused = 0;
  int refused_though_right = 0;  // the refused pose was within 5 mm
  int pairs_wrong = 0;
  int pairs_wrong_used = 0;
  int pairs_right_rejected = 0;
  std::vector<double> errors_m;  // of accepted
  std::map<std::string, int> form_wrong;
};

struct Difficulty {
  const char* name;
  void (*apply)(PairScene& scene, std::mt19937_64& dice);
};

double pick(std::mt19937_64& dice, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(dice);
}

const std::vector<Difficulty>& difficulties() {
  static const std::vector<Difficulty> all{
      {"ordinary", [](PairScene&, std::mt19937_64&) {}},
      {"noisy",
       [](PairScene& s, std::mt19937_64& d) {
         s.translation_m = pick(d, 0.001, 0.004);
         s.rotation_rad = pick(d, 0.005, 0.02);
         s.depth_factor = pick(d, 1.0, 4.0);
       }},
      {"few pairs",
       [](PairScene& s, std::mt19937_64& d) { s.pairs = 4 + static_cast<int>(d() % 4); }},
      {"wrong pairs",
       [](PairScene& s, std::mt19937_64& d) { s.wrong_share = pick(d, 0.05, 0.40); }},
      {"swapped rows",
       [](PairScene& s, std::mt19937_64& d) { s.swapped = 1 + static_cast<int>(d() % 4); }},
      {"small motion",
       [](PairScene& s, std::mt19937_64& d) {
         s.turn_rad = pick(d, 0.005, 0.1);
         s.travel_m = pick(d, 0.002, 0.05);
       }},
      {"near-parallel axes",
       [](PairScene& s, std::mt19937_64& d) { s.axis_spread = pick(d, 0.0, 0.1); }},
      {"few and wrong",
       [](PairScene& s, std::mt19937_64& d) {
         s.pairs = 5 + static_cast<int>(d() % 5);
         s.wrong_share = pick(d, 0.1, 0.5);
       }},
      {"small and wrong",
       [](PairScene& s, std::mt19937_64& d) {
         s.turn_rad = pick(d, 0.02, 0.15);
         s.travel_m = pick(d, 0.01, 0.05);
         s.wrong_share = pick(d, 0.05, 0.3);
         s.translation_m = pick(d, 0.0003, 0.002);
       }},
      {"everything", [](PairScene& s, std::mt19937_64& d) {
         s.pairs = 4 + static_cast<int>(d() % 20);
         s.turn_rad = pick(d, 0.02, 0.5);
         s.travel_m = pick(d, 0.005, 0.3);
         s.axis_spread = pick(d, 0.0, 1.0);
         s.translation_m = pick(d, 0.0001, 0.003);
         s.rotation_rad = pick(d, 0.0005, 0.01);
         s.depth_factor = pick(d, 1.0, 5.0);
         s.wrong_share = pick(d, 0.0, 0.4);
       }}};
  return all;
}

void count(const MadePairs& made, const HandEyeResult& result, unsigned seed, const char* name,
           Tally& tally) {
  const double error_m =
      (result.pose.camera.translation() - made.truth.camera.translation()).norm();
  if (result.verdict.grade == Grade::kPoor) {
    ++tally.refused;
    tally.refused_though_right += error_m < kWrong ? 1 : 0;
  } else {
    ++tally.accepted;
    tally.errors_m.push_back(error_m);
    if (error_m > kWrong) {
      ++tally.accepted_wrong;
      std::printf("WRONG %s seed %u: %.2f mm, %s\n", name, seed, 1e3 * error_m,
                  result.verdict.sentence.c_str());
    }
    for (std::size_t i = 0; i < made.wrong.size(); ++i) {
      tally.pairs_wrong += made.wrong[i] ? 1 : 0;
      tally.pairs_wrong_used += made.wrong[i] && result.used[i] ? 1 : 0;
      tally.pairs_right_rejected += !made.wrong[i] && !result.used[i] ? 1 : 0;
    }
  }
}

void countForms(const MadePairs& made, EyeSetup setup, Tally& tally) {
  for (const ClosedForm form : closedForms()) {
    const auto pose = solveClosedForm(form, made.pairs, setup);
    const bool right =
        pose && (pose->camera.translation() - made.truth.camera.translation()).norm() <= kWrong;
    tally.form_wrong[toString(form)] += right ? 0 : 1;
  }
}

void runOne(unsigned seed, std::map<std::string, Tally>& tallies) {
  std::mt19937_64 dice(seed);
  const Difficulty& difficulty = difficulties()[seed % difficulties().size()];
  PairScene scene;
  scene.setup =
      (seed / difficulties().size()) % 2 == 0 ? EyeSetup::kEyeToHand : EyeSetup::kEyeInHand;
  difficulty.apply(scene, dice);
  const MadePairs made = makePairs(scene, dice);
  Tally& tally = tallies[difficulty.name];
  ++tally.sets;
  countForms(made, scene.setup, tally);
  try {
    const auto result =
        calibrateRobotCamera(made.pairs, scene.setup, [](double, const std::string&) {});
    count(made, result, seed, difficulty.name, tally);
  } catch (const Error& e) {
    ++tally.refused;
  }
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void printTally(const char* name, const Tally& t) {
  std::printf("%-20s %5d %8d %6d %8d %8d %8.2f %8.2f", name, t.sets, t.accepted, t.accepted_wrong,
              t.refused, t.refused_though_right, 1e3 * percentile(t.errors_m, 0.5),
              1e3 * percentile(t.errors_m, 1.0));
  for (const ClosedForm form : closedForms()) {
    const auto found = t.form_wrong.find(toString(form));
    std::printf(" %5d", found == t.form_wrong.end() ? 0 : found->second);
  }
  std::printf("\n");
}

void addTo(Tally& sum, const Tally& t) {
  sum.sets += t.sets;
  sum.accepted += t.accepted;
  sum.accepted_wrong += t.accepted_wrong;
  sum.refused += t.refused;
  sum.refused_though_right += t.refused_though_right;
  sum.pairs_wrong += t.pairs_wrong;
  sum.pairs_wrong_used += t.pairs_wrong_used;
  sum.pairs_right_rejected += t.pairs_right_rejected;
  sum.errors_m.insert(sum.errors_m.end(), t.errors_m.begin(), t.errors_m.end());
  for (const auto& [name, wrong] : t.form_wrong) {
    sum.form_wrong[name] += wrong;
  }
}

int campaign(unsigned seeds, unsigned first) {
  std::map<std::string, Tally> tallies;
  const std::clock_t start = std::clock();
  for (unsigned seed = first; seed < first + seeds; ++seed) {
    runOne(seed, tallies);
  }
  std::printf("\n%-20s %5s %8s %6s %8s %8s %8s %8s   closed form alone wrong by > 5 mm:\n", "", "",
              "", "", "", "refused", "median", "worst");
  std::printf("%-20s %5s %8s %6s %8s %8s %8s %8s", "sets", "", "accepted", "wrong", "refused",
              "< 5 mm", "mm", "mm");
  for (const ClosedForm form : closedForms()) {
    std::printf(" %5.5s", toString(form).c_str());
  }
  std::printf("\n");
  Tally all;
  for (const Difficulty& difficulty : difficulties()) {
    printTally(difficulty.name, tallies[difficulty.name]);
    addTo(all, tallies[difficulty.name]);
  }
  printTally("all", all);
  std::printf("in accepted sets: %d wrong pairs, %d of them not found; %d right ones rejected\n",
              all.pairs_wrong, all.pairs_wrong_used, all.pairs_right_rejected);
  std::printf("CPU time %.1f s\n",
              static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC));
  return all.accepted_wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("Robot-camera calibration on made-up sets of every difficulty.");
  unsigned seeds = 1000;
  unsigned first = 1;
  app.add_option("--seeds", seeds, "how many sets")->capture_default_str();
  app.add_option("--first", first, "first seed")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return ringhook::campaign(seeds, first);
}

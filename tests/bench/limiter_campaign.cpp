/// \file
/// Sends many random inputs through the limiter and counts what leaves beyond a limit:
///   limiter_campaign --count 10000000 --seed 1
/// Exits with 1 if anything did.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "../unit/robot/limiter_trial.h"

int main(int argc, char** argv) {
  constexpr long kLife = 1000;  // inputs of one trial
  long count = 10000000;
  unsigned long seed = 1;
  CLI::App app{"Random inputs through the arm's limiter; exits with 1 if a limit ever breaks."};
  app.add_option("--count", count, "inputs")->check(CLI::Range(kLife, 1000000000000L));
  app.add_option("--seed", seed, "of the first trial");
  CLI11_PARSE(app, argc, argv);

  ringhook::WatchResult all;
  const long trials = (count + kLife - 1) / kLife;
  const auto start = std::chrono::steady_clock::now();
  for (long trial = 0; trial < trials; ++trial) {
    all.add(ringhook::LimiterTrial(seed + static_cast<unsigned long>(trial)).run(kLife));
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%ld inputs in %ld trials, %ld violations\n", trials * kLife, trials, all.total());
  for (std::size_t i = 0; i < all.broken.size(); ++i) {
    std::printf("  %-12s %ld broken, most used %.9f\n", ringhook::kWatchedNames[i], all.broken[i],
                all.most[i]);
  }
  std::printf("%.0f s, %.0f inputs per second\n", took.count(),
              static_cast<double>(trials * kLife) / took.count());
  return all.total() == 0 ? 0 : 1;
}

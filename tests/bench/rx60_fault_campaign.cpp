// Thousands of seeded mishaps between the RX60's client and the simulated controller, in virtual
// time: 0 crashes, 0 hangs, 0 motions without a re-arm, 0 limits broken are expected.
//   rx60_fault_campaign --count 10000 --seed 1

#include <CLI/CLI.hpp>
#include <cstdio>

#include "../support/arm_mishaps.h"

int main(int argc, char** argv) {
  int count = 10000;
  std::uint64_t seed = 1;
  CLI::App app{"Deals mishaps to the RX60's client"};
  app.add_option("--count", count, "Mishaps")->check(CLI::Range(1, 100000000));
  app.add_option("--seed", seed, "Of the first episode");
  CLI11_PARSE(app, argc, argv);

  constexpr int kInAnEpisode = 5;
  ringhook::test::MishapResult result;
  for (int done = 0; done < count; done += kInAnEpisode) {
    ringhook::test::runMishaps(seed++, kInAnEpisode, result);
  }
  int dealt = 0;
  std::printf("%-18s %8s %14s %22s\n", "mishap", "dealt", "client faults", "longest to zero [ms]");
  for (const auto& [mishap, tally] : result.tallies) {
    dealt += tally.dealt;
    std::printf("%-18s %8d %14d %22.1f\n", nameOf(mishap), tally.dealt, tally.client_faults,
                1e3 * tally.longest_to_zero_s);
  }
  std::printf(
      "%d mishaps in %d episodes, %.0f s of virtual time, %lld velocities on the wire, "
      "%d re-arms\n",
      dealt, result.episodes, result.virtual_s, static_cast<long long>(result.commands),
      result.rearms);
  std::printf("violations: %zu\n", result.violations.size());
  for (std::size_t k = 0; k < result.violations.size() && k < 20; ++k) {
    std::printf("  %s\n", result.violations[k].c_str());
  }
  return result.violations.empty() ? 0 : 1;
}

#pragma once

/// \file
/// The files that an evaluation of a sequence leaves (doc/formats.md, "Written by every
/// evaluation"): estimate.tum and frames.csv of the first method, the same with the method's name
/// for each further one, summary.json and report.html. Each is whole or absent.

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/sequence_summary.h"

namespace ringhook {

struct SequenceOutputs {
  std::string sequence;  ///< its name
  std::string target;    ///< file name, for the report
  std::string notes;
  double gate_mm = 0.0;                    ///< of a false pose
  bool interrupted = false;                ///< ended before the sequence did
  std::vector<MethodRun> runs;             ///< at least one
  std::vector<SequenceSummary> summaries;  ///< of the same methods
};

/// Writes all of them and returns their paths. Throws Error.
std::vector<std::filesystem::path> writeSequenceOutputs(const std::filesystem::path& folder,
                                                        const SequenceOutputs& outputs);

/// frames.csv as text.
[[nodiscard]] std::string framesCsv(const MethodRun& run);

}  // namespace ringhook

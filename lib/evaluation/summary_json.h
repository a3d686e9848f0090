#pragma once

/// \file
/// summary.json of `evaluate sequence` (doc/formats.md). The first method's results stand at the
/// top level, every method's under `methods`.

#include <string>
#include <vector>

#include "evaluation/sequence_summary.h"

namespace ringhook {

/// Precondition: at least one summary.
[[nodiscard]] std::string summaryJson(const std::vector<SequenceSummary>& summaries,
                                      const std::string& sequence, double gate_mm,
                                      bool interrupted);

}  // namespace ringhook

#pragma once

/// \file
/// What the servo task tells people and programs: a table, and summary.json (doc/formats.md).
/// For a simulated cell nothing in it depends on the machine's speed, so the same seed gives the
/// same file.

#include <string>

#include "evaluation/servo_run.h"

namespace ringhook {

/// The table's head, and its row of one attempt: printed while the job goes on.
std::string servoTableHead();
std::string servoTableRow(int attempt, const ServoAttempt& result);

std::string servoSummaryJson(const ServoJob& job, const ServoReport& report);

/// Rings that hang by physics; none where nobody judges.
int ringsHung(const ServoReport& report);
/// Rings that were let go over the tip.
int ringsReleased(const ServoReport& report);

}  // namespace ringhook

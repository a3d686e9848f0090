#pragma once

/// \file
/// The report page of `ringhook evaluate trajectory`: errors over time, errors against the horizon,
/// and what the models believe of length and damping, with their doubt.

#include "evaluation/report_page.h"
#include "evaluation/trajectory_result.h"

namespace ringhook {

[[nodiscard]] ReportPage trajectoryPage(const TrajectoryResult& result);

}  // namespace ringhook

#include "cycle/loop_statistics.h"

namespace ringhook {

void LoopStatistics::merge(const LoopStatistics& other) {
  prediction_error_m.merge(other.prediction_error_m);
  frame_age_s.merge(other.frame_age_s);
  fix_error_m.merge(other.fix_error_m);
  nis.merge(other.nis);
  frames += other.frames;
  frames_without_fix += other.frames_without_fix;
  limited_commands += other.limited_commands;
  limit_violations += other.limit_violations;
}

void countFrame(const VisionReport& report, double age_s, LoopStatistics& statistics) {
  if (report.state != VisionState::kSearching) {
    ++statistics.frames;
    statistics.frames_without_fix += report.fix ? 0 : 1;
  }
  if (report.fix) {
    statistics.nis.add(report.nis);
    statistics.frame_age_s.add(age_s);
  }
  if (report.error_100ms_m) {
    statistics.prediction_error_m.add(*report.error_100ms_m);
  }
}

void countCommand(const ArmState& state, const TaskCommand& command, const JointLimits& limits,
                  LoopStatistics& statistics) {
  statistics.limited_commands += command.limited ? 1 : 0;
  const bool outside = ((state.position - limits.lower).array() < 0.0).any() ||
                       ((limits.upper - state.position).array() < 0.0).any();
  // Velocity is differentiated position: allow its rounding.
  const bool fast = (state.velocity.cwiseAbs() - limits.velocity).maxCoeff() > 1e-6;
  statistics.limit_violations += outside || fast ? 1 : 0;
}

}  // namespace ringhook

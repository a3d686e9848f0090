#include "evaluation/sequence_evaluation.h"

#include <utility>

#include "core/error.h"
#include "evaluation/pose_error.h"

namespace ringhook {
namespace {

/// What prediction remembers of one method's past.
struct Past {
  std::optional<StampedPose> before;  ///< fix before the last one, only while tracked throughout
  std::optional<StampedPose> last;    ///< last fix, or the start pose

  [[nodiscard]] std::optional<Pose> predict(Time time) const {
    if (last && before) {
      return predictConstantVelocity(*before, *last, time);
    }
    return last ? std::optional(last->pose) : std::nullopt;
  }
  void tracked(const HookFix& fix, bool continuous) {
    before = continuous ? last : std::nullopt;
    last = StampedPose{fix.time, fix.c1Mo};
  }
};

/// One method at work.
struct Runner {
  EvaluationMethod& method;
  MethodRun run;
  Past past;
  bool tracking = false;
};

struct Sight {
  HookView view;
  HookFix fix;
};

Outcome<Sight> sightOf(Runner& runner, const RectifiedFrame& frame,
                       const std::optional<Pose>& start, const std::function<double()>& clock_s,
                       FrameRecord& record) {
  const double begin = clock_s();
  const auto view = runner.method.tracker->track(frame, start);
  const double seen = clock_s();
  record.track_s += seen - begin;
  if (!view) {
    return Refusal{view.reason()};
  }
  const auto fix = runner.method.fix(*view);
  record.fix_s += clock_s() - seen;
  if (!fix) {
    return Refusal{fix.reason()};
  }
  return Sight{*view, *fix};
}

void judge(FrameRecord& record, const std::vector<StampedPose>& c1Mo_truth) {
  const auto truth = poseAt(c1Mo_truth, record.time);
  if (record.fix && truth) {
    record.position_error = positionError(record.fix->c1Mo, *truth);
    record.rotation_error = rotationError(record.fix->c1Mo, *truth);
  }
}

void keepSnapshot(MethodRun& run, const RectifiedFrame& frame, const Sight& sight) {
  Snapshot snapshot{frame.views.front(), sight.view, sight.fix};
  if (!run.first) {
    run.first = snapshot;
  }
  run.last = std::move(snapshot);
}

void step(Runner& runner, const RectifiedFrame& frame, const SequenceRunOptions& options,
          FrameRecord record, bool keep) {
  const auto predicted = runner.past.predict(frame.time);
  auto sight = sightOf(runner, frame, predicted, options.clock_s, record);
  if (!sight && runner.method.needs_start && runner.tracking) {
    sight = sightOf(runner, frame, runner.past.last->pose, options.clock_s, record);
  }
  if (sight) {
    record.fix = sight->fix;
    runner.past.tracked(sight->fix, runner.tracking);
    if (keep) {
      keepSnapshot(runner.run, frame, *sight);
    }
  } else {
    record.reason = sight.reason();
    runner.past.before.reset();
  }
  runner.tracking = sight.hasValue();
  judge(record, options.c1Mo_truth);
  runner.run.frames.push_back(std::move(record));
}

std::vector<Runner> makeRunners(std::vector<EvaluationMethod>& methods,
                                const SequenceRunOptions& options) {
  std::vector<Runner> runners;
  for (auto& method : methods) {
    if (method.needs_start && !options.c1Mo_start) {
      throw InputError("method " + method.name +
                       " needs a start pose: expected --start or the key start in sequence.yaml");
    }
    Runner runner{method, {}, {}, false};
    runner.run.name = method.name;
    if (options.c1Mo_start) {
      runner.past.last = StampedPose{Time(), *options.c1Mo_start};
    }
    runners.push_back(std::move(runner));
  }
  return runners;
}

RectifiedFrame leftOf(const RectifiedFrame& frame) { return {frame.time, {frame.views.front()}}; }

}  // namespace

Pose predictConstantVelocity(const StampedPose& a, const StampedPose& b, Time time) {
  const Twist motion = logSe3(a.pose.inverse() * b.pose);
  return b.pose * expSe3(motion * ((time - b.time) / (b.time - a.time)));
}

std::vector<MethodRun> runSequence(StereoCamera& camera, const Rectifier& rectifier,
                                   std::vector<EvaluationMethod>& methods,
                                   const SequenceRunOptions& options) {
  auto runners = makeRunners(methods, options);
  for (std::size_t done = 0; !camera.finished();) {
    const double begin = options.clock_s();
    const auto frame = camera.grab(0.0);
    if (!frame) {
      continue;
    }
    FrameRecord record;
    record.frame = frame->index;
    record.time = frame->time;
    record.left_window = frame->left_window;
    record.right_window = frame->right_window;
    const double read = options.clock_s();
    const RectifiedFrame rectified = rectifier.rectify(*frame);
    record.read_s = read - begin;
    record.rectify_s = options.clock_s() - read;
    for (auto& runner : runners) {
      step(runner, runner.method.left_only ? leftOf(rectified) : rectified, options, record,
           &runner == &runners.front());
    }
    if (!options.proceed(++done)) {
      break;
    }
  }
  std::vector<MethodRun> runs;
  runs.reserve(runners.size());
  for (auto& runner : runners) {
    runs.push_back(std::move(runner.run));
  }
  return runs;
}

}  // namespace ringhook

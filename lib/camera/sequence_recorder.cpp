#include "camera/sequence_recorder.h"

#include <utility>

namespace ringhook {

SequenceRecorder::SequenceRecorder(std::unique_ptr<SequenceWriter> writer,
                                   std::size_t frames_at_most, WhenFull when_full)
    : writer_(std::move(writer)),
      frames_at_most_(frames_at_most),
      when_full_(when_full),
      thread_([this] { work(); }) {}

SequenceRecorder::~SequenceRecorder() {
  try {
    close();
  } catch (const std::exception&) {
    failed_ = true;
  }
}

bool SequenceRecorder::addFrame(StereoFrame frame, const std::optional<Pose>& c1Mo) {
  // Shared, since what a std::function holds must be copyable.
  const auto held = std::make_shared<StereoFrame>(std::move(frame));
  return push(
      [held, c1Mo](SequenceWriter& writer) {
        writer.addFrame(*held);
        if (c1Mo) {
          writer.addTruth(held->time, *c1Mo);
        }
      },
      true);
}

void SequenceRecorder::addRobot(Time time, const JointVector& position, const Pose& fMe) {
  push([=](SequenceWriter& writer) { writer.addRobot(time, position, fMe); }, false);
}

std::size_t SequenceRecorder::framesStored() const {
  const std::lock_guard lock(mutex_);
  return frames_stored_;
}

bool SequenceRecorder::push(Job job, bool is_frame) {
  std::unique_lock lock(mutex_);
  const auto room = [this] { return frames_waiting_ < frames_at_most_ || failed_; };
  if (is_frame && when_full_ == WhenFull::kWait) {
    changed_.wait(lock, room);
  }
  rethrowFailure();
  if (is_frame && !room()) {
    return false;
  }
  jobs_.emplace_back(std::move(job), is_frame);
  frames_waiting_ += is_frame ? 1 : 0;
  changed_.notify_all();
  return true;
}

void SequenceRecorder::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
    if (jobs_.empty()) {
      return;
    }
    const auto [job, is_frame] = std::move(jobs_.front());
    jobs_.pop_front();
    if (!failed_) {
      lock.unlock();
      std::exception_ptr failure;
      try {
        job(*writer_);
      } catch (const std::exception&) {
        failure = std::current_exception();
      }
      lock.lock();
      failed_ = failed_ || failure;
      failure_ = failure;
      frames_stored_ = writer_->frames();
    }
    frames_waiting_ -= is_frame ? 1 : 0;
    changed_.notify_all();
  }
}

void SequenceRecorder::rethrowFailure() {
  if (failure_) {
    std::rethrow_exception(std::exchange(failure_, nullptr));
  }
}

void SequenceRecorder::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) {
    thread_.join();
  }
  rethrowFailure();
  writer_->close();
}

}  // namespace ringhook

#pragma once

/// \file
/// A sequence writer on a thread of its own, behind a bounded queue: compressing a full pair of
/// images takes 0.2 s, more than a camera waits. In virtual time a full queue makes the recording
/// wait; on a real camera the newest frame is then left out and counted, since waiting would lose
/// frames elsewhere. What is written depends on the order of the calls only.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "camera/sequence_writer.h"

namespace ringhook {

class SequenceRecorder {
 public:
  enum class WhenFull { kWait, kLeaveOut };

  /// \param frames_at_most waiting to be written
  SequenceRecorder(std::unique_ptr<SequenceWriter> writer, std::size_t frames_at_most,
                   WhenFull when_full);
  /// Writes what waits; a failure is then silent, so call close() to hear of it.
  ~SequenceRecorder();
  SequenceRecorder(const SequenceRecorder&) = delete;
  SequenceRecorder& operator=(const SequenceRecorder&) = delete;

  /// A frame and, where it is known, the target in the left camera at its time. False if the queue
  /// was full and the frame is left out. Throws what the disk said about an earlier one.
  bool addFrame(StereoFrame frame, const std::optional<Pose>& c1Mo);
  /// The arm's joints [rad] and its flange. Throws likewise.
  void addRobot(Time time, const JointVector& position, const Pose& fMe);

  /// Frames whole on the disk by now.
  [[nodiscard]] std::size_t framesStored() const;

  /// Writes what waits and closes the tables. Throws the first failure, once.
  void close();

 private:
  using Job = std::function<void(SequenceWriter&)>;

  bool push(Job job, bool is_frame);
  void work();
  void rethrowFailure();

  std::unique_ptr<SequenceWriter> writer_;
  std::size_t frames_at_most_;
  WhenFull when_full_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<Job, bool>> jobs_;  ///< with whether it is a frame
  std::size_t frames_waiting_ = 0;
  std::size_t frames_stored_ = 0;
  bool closing_ = false;
  bool failed_ = false;
  std::exception_ptr failure_;  ///< not yet told
  std::thread thread_;
};

}  // namespace ringhook

#pragma once

/// \file
/// A controller played by the test: it hands a Link the frames that the test wants it to see, at
/// times that the test chooses, and collects what the Link sends.

#include <cstddef>
#include <vector>

#include "robot/rx60/link.h"

namespace ringhook::test {

class ScriptedController {
 public:
  static constexpr double kPeriod = 0.004;  ///< [s]

  explicit ScriptedController(const rx60::LinkSettings& settings = {}) : link(settings) {}

  /// Opens the connections and lets the first feedback and a good status come: idle and armed.
  void connect();
  /// ... and brings the link into velocity mode with a target of zeros.
  void connectAndServe();

  /// Time goes on by `seconds`, without a message.
  void pass(double seconds);
  /// Hands a message over without waking the link.
  void give(rx60::Channel channel, const rx60::Message& message);
  void giveBytes(rx60::Channel channel, std::span<const std::byte> bytes);
  void giveStatus(const rx60::RobotStatus& status);
  /// One period later a feedback arrives and the link answers; what it sent.
  std::vector<rx60::Message> feedback();
  /// Takes what the link has to send, and replies to every request (unless `silent`).
  std::vector<rx60::Message> collect();

  static rx60::RobotStatus good();

  rx60::Link link;
  Time now = Time::fromSeconds(100.0);
  JointVector position = JointVector::Constant(0.4);  ///< reported [rad]
  bool silent = false;                                ///< requests are not replied to
  rx60::ReplyCode verdict = rx60::ReplyCode::kSuccess;
  int feedbacks = 0;

 private:
  void reply(const rx60::Link::Outgoing& out);
};

/// A velocity well within every limit [rad/s].
inline JointVector slow() { return JointVector{{0.01, -0.01, 0.02, 0.0, 0.01, -0.02}}; }
/// The largest difference of two joints' values.
inline double off(const JointVector& a, const JointVector& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// The velocity commands among messages, stops left out [rad/s].
std::vector<JointVector> velocitiesIn(const std::vector<rx60::Message>& messages);
/// How many messages stop the arm.
int stopsIn(const std::vector<rx60::Message>& messages);

}  // namespace ringhook::test

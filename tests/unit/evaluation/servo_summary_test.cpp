#include "evaluation/servo_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ringhook {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

ServoAttempt hung() {
  ServoAttempt attempt;
  attempt.loop.released = true;
  attempt.loop.started = Time::fromSeconds(2.0);
  attempt.loop.met = Time::fromSeconds(5.0);
  attempt.loop.released_at = Time::fromSeconds(8.5);
  attempt.loop.ended = Time::fromSeconds(12.0);
  attempt.loop.tracking_error_m.add(1e-3);
  attempt.loop.tracking_error_m.add(3e-3);
  attempt.truth.emplace();
  attempt.truth->hanging = true;
  attempt.truth->peak_contact_n = 1.5;
  attempt.truth->insertion_error_m.add(5e-4);
  return attempt;
}

ServoAttempt aborted(const std::string& reason) {
  ServoAttempt attempt;
  attempt.loop.abort_reason = reason;
  attempt.loop.started = Time::fromSeconds(12.0);
  attempt.loop.ended = Time::fromSeconds(18.0);
  attempt.truth.emplace();
  attempt.truth->peak_contact_n = 2.5;
  return attempt;
}

ServoAttempt fell() {
  ServoAttempt attempt = hung();
  attempt.truth->hanging = false;
  return attempt;
}

json summaryOf(const ServoReport& report) {
  ServoJob job;
  job.cycles = 9;
  job.seed = 42;
  job.tracker = TrackerKind::kEdges;
  return json::parse(servoSummaryJson(job, report));
}

TEST(ServoSummary, CountsOnlyRingsThatPhysicsSaysHang) {
  ServoReport report;
  report.attempts = {hung(), aborted("hook lost"), fell(), hung()};
  EXPECT_EQ(ringsHung(report), 2);
  const json summary = summaryOf(report);
  EXPECT_EQ(summary.at("rings_hung"), 2);
  EXPECT_EQ(summary.at("cycles"), 4);
  EXPECT_EQ(summary.at("cycles_asked"), 9);
  EXPECT_EQ(summary.at("seed"), 42);
  EXPECT_EQ(summary.at("tracker"), "edges");
  EXPECT_EQ(summary.at("interrupted"), false);
  EXPECT_EQ(summary.at("attempts").at(2).at("outcome"), "ring fell");
}

TEST(ServoSummary, CountsAbortsByTheirReasonAndNothingElse) {
  ServoReport report;
  report.attempts = {aborted("hook lost"), hung(), aborted("no hook came"), aborted("hook lost")};
  EXPECT_EQ(summaryOf(report).at("aborts"), json({{"hook lost", 2}, {"no hook came", 1}}));
}

TEST(ServoSummary, GivesMillimetresAndSeconds) {
  ServoReport report;
  report.attempts = {hung(), aborted("hook lost")};
  report.statistics.frame_age_s.add(0.016);
  const json summary = summaryOf(report);
  EXPECT_DOUBLE_EQ(summary.at("cycle_time_s"), 8.0);
  EXPECT_DOUBLE_EQ(summary.at("peak_contact_n"), 2.5);
  EXPECT_NEAR(summary.at("tracking_error_mm").at("mean"), 2.0, 1e-12);
  EXPECT_NEAR(summary.at("tracking_error_mm").at("max"), 3.0, 1e-12);
  EXPECT_NEAR(summary.at("latency_ms").at("mean"), 16.0, 1e-12);
  const json& attempt = summary.at("attempts").at(0);
  EXPECT_NEAR(attempt.at("approach_to_release_s"), 3.5, 1e-12);
  EXPECT_NEAR(attempt.at("true_insertion_error_mm").at("max"), 0.5, 1e-12);
}

TEST(ServoSummary, WhatWasNeverMeasuredIsNullAndNotZero) {
  ServoReport report;
  report.attempts = {aborted("hook lost")};
  const json summary = summaryOf(report);
  EXPECT_TRUE(summary.at("tracking_error_mm").is_null());
  EXPECT_TRUE(summary.at("prediction_error_mm").is_null());
  EXPECT_FALSE(summary.at("attempts").at(0).contains("approach_to_release_s"));
}

TEST(ServoSummary, OfNothingIsStillValid) {
  ServoReport report;
  report.interrupted = true;
  const json summary = summaryOf(report);
  EXPECT_EQ(summary.at("interrupted"), true);
  EXPECT_EQ(summary.at("cycles"), 0);
}

TEST(ServoSummary, WhereNobodyJudgesNoRingIsSaidToHang) {
  ServoReport report;
  report.live.emplace();
  report.live->cameras.pairs = 250;
  report.live->cameras.unpaired_left = 1;
  report.live->arm.commands = 5000;
  report.attempts = {hung(), aborted("hook lost")};
  report.attempts[0].truth.reset();
  report.attempts[1].truth.reset();
  EXPECT_EQ(ringsHung(report), 0);
  EXPECT_EQ(ringsReleased(report), 1);
  const json summary = summaryOf(report);
  EXPECT_TRUE(summary.at("rings_hung").is_null());
  EXPECT_TRUE(summary.at("peak_contact_n").is_null());
  EXPECT_EQ(summary.at("rings_released"), 1);
  EXPECT_THAT(summary.at("judged_by"), HasSubstr("nobody"));
  EXPECT_FALSE(summary.contains("simulated"));
  EXPECT_EQ(summary.at("cameras").at("pairs"), 250);
  EXPECT_EQ(summary.at("cameras").at("unpaired_left"), 1);
  EXPECT_EQ(summary.at("arm").at("commands"), 5000);
  EXPECT_EQ(summary.at("attempts").at(0).at("outcome"), "ring released");
  EXPECT_THAT(servoTableRow(0, report.attempts[0]), HasSubstr("ring released"));
}

TEST(ServoSummary, ADeviceThatFailedIsNamedBesideWhatWasFinished) {
  ServoReport report;
  report.live.emplace();
  report.live->link_priority = ThreadPriority::kRealTime;
  report.live->frame_interval_s.add(0.08);
  report.attempts = {hung()};
  EXPECT_TRUE(summaryOf(report).at("failure").is_null());
  report.failure = "The RX60 stopped: no feedback.";
  const json summary = summaryOf(report);
  EXPECT_EQ(summary.at("failure"), "The RX60 stopped: no feedback.");
  EXPECT_EQ(summary.at("rings_released"), 1);
  EXPECT_EQ(summary.at("arm").at("thread_priority"), "real time");
  EXPECT_NEAR(summary.at("frame_interval_ms").at("mean"), 80.0, 1e-12);
}

TEST(ServoSummary, TellsThatAHookNeededAnotherTry) {
  ServoAttempt attempt = hung();
  attempt.truth.reset();
  attempt.loop.tries = 2;
  EXPECT_THAT(servoTableRow(0, attempt), HasSubstr("ring released, try 2"));
  ServoReport report;
  report.attempts = {attempt};
  EXPECT_EQ(summaryOf(report).at("attempts").at(0).at("tries"), 2);
}

TEST(ServoSummary, TableCountsHooksFromOneAndSaysWhy) {
  EXPECT_THAT(servoTableRow(0, hung()), HasSubstr("   1  ring hangs"));
  EXPECT_THAT(servoTableRow(2, aborted("hook lost")), HasSubstr("   3  aborted: hook lost"));
}

}  // namespace
}  // namespace ringhook

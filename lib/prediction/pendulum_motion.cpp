#include "prediction/pendulum_motion.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "prediction/exact_pendulum.h"
#include "prediction/linear_motion.h"
#include "prediction/pendulum.h"
#include "prediction/pendulum_start.h"
#include "prediction/van_loan.h"

namespace ringhook {
namespace {

enum class Way { kReport, kExact };

// Before the first sample, mean 0.
constexpr double kFar = 1e3;     // pivot [m]
constexpr double kFast = 20.0;   // pivot [m/s], swing [rad/s]
constexpr double kHasty = 20.0;  // pivot [m/s^2]
constexpr double kWide = 3.0;    // swing [rad]; a pivot that is not measured leaves half a radian
constexpr double kAmple = 0.5;

const char* nameOf(Way way) { return way == Way::kReport ? "report-pendulum" : "exact-pendulum"; }

PendulumRates ratesOf(const PendulumMotionOptions& options) {
  return pendulumRates(*options.length_m, options.damping_per_s, options.gravity);
}

/// The report's walk, on (phi, L phi'). `density`: white acceleration of phi [rad^2/s^3].
AxisStep<2> reportStep(const PendulumMotionOptions& options, double density, double dt) {
  PendulumParameters pendulum;
  pendulum.length_m = *options.length_m;
  pendulum.damping_kg_per_s = options.damping_per_s;  // of 1 kg
  pendulum.gravity = options.gravity;
  pendulum.step_s = options.frame_s;
  const PendulumWalk walk = walkPendulum(pendulum, dt, density);
  return {walk.transition, walk.noise};
}

/// Two models side by side, nothing in the transition joins them.
template <int N, int M>
AxisStep<N + M> beside(const AxisStep<N>& one, const AxisStep<M>& other) {
  AxisStep<N + M> both;
  both.transition.setZero();
  both.noise.setZero();
  both.transition.template topLeftCorner<N, N>() = one.transition;
  both.transition.template bottomRightCorner<M, M>() = other.transition;
  both.noise.template topLeftCorner<N, N>() = one.noise;
  both.noise.template bottomRightCorner<M, M>() = other.noise;
  return both;
}

AxisLaw<2, 1> angleLaw(Way way, const PendulumMotionOptions& options) {
  AxisLaw<2, 1> law;
  const double rate = way == Way::kReport ? *options.length_m : 1.0;  // v = L phi', or phi'
  law.step = [way, options](double dt) -> AxisStep<2> {
    if (way == Way::kReport) {
      return reportStep(options, options.swing_density, dt);
    }
    const PendulumRates rates = ratesOf(options);
    return {exactPendulumTransition(rates, dt),
            sampleLaw(pendulumDrift(rates), pendulumDensity(options.swing_density), dt).noise};
  };
  law.measured << 1.0, 0.0;
  law.wanted = law.measured;
  law.prior_sigma << kWide, rate * kFast;
  law.sample_sigma = options.sample_sigma;
  return law;
}

/// A point whose pivot is measured: (pivot, point).
AxisLaw<5, 2> travellingLaw(Way way, const PendulumMotionOptions& options) {
  const double L = *options.length_m;
  const double unit = way == Way::kReport ? L : 1.0;  // the report's state is phi, s = L phi
  AxisLaw<5, 2> law;
  law.step = [way, options, L](double dt) -> AxisStep<5> {
    const double q = options.pivot_density;
    if (way == Way::kReport) {
      return beside(accelerationStep(dt, q),
                    reportStep(options, options.swing_density / L / L, dt));
    }
    const PendulumRates rates = ratesOf(options);
    return {
        exactTravellingTransition(rates, dt),
        sampleLaw(travellingDrift(rates), travellingDensity(q, options.swing_density), dt).noise};
  };
  law.measured << 1.0, 0.0, 0.0, 0.0, 0.0,  //
      1.0, 0.0, 0.0, unit, 0.0;
  law.wanted = law.measured.row(1);
  law.prior_sigma << kFar, kFast, kHasty, kWide * L / unit, kFast * L;
  law.sample_sigma = options.sample_sigma;
  return law;
}

/// A point alone.
AxisLaw<4, 1> driftingLaw(Way way, const PendulumMotionOptions& options) {
  const double L = *options.length_m;
  const double unit = way == Way::kReport ? L : 1.0;
  AxisLaw<4, 1> law;
  law.step = [way, options, L](double dt) -> AxisStep<4> {
    const double q = options.pivot_density;
    if (way == Way::kReport) {
      return beside(velocityStep(dt, q), reportStep(options, options.swing_density / L / L, dt));
    }
    const PendulumRates rates = ratesOf(options);
    return {exactDriftingTransition(rates, dt),
            sampleLaw(driftingDrift(rates), driftingDensity(q, options.swing_density), dt).noise};
  };
  law.measured << 1.0, 0.0, unit, 0.0;
  law.wanted = law.measured;
  law.prior_sigma << kFar, kFast, kAmple * L / unit, kAmple * std::sqrt(options.gravity * L);
  law.sample_sigma = options.sample_sigma;
  return law;
}

std::vector<std::unique_ptr<AxisGroup>> groupsOf(Way way, TrajectoryKind kind,
                                                 const PendulumMotionOptions& options) {
  std::vector<std::unique_ptr<AxisGroup>> groups;
  if (isAngular(kind)) {
    std::vector<AxisPlace<1>> places = {{{0}, 0}};
    if (kind == TrajectoryKind::kTwoAngles) {
      places.push_back({{1}, 1});
    }
    groups.push_back(std::make_unique<AxisFilters<2, 1>>(angleLaw(way, options), places));
    return groups;
  }
  if (kind == TrajectoryKind::kPointAndPivot) {
    const std::vector<AxisPlace<2>> places = {{{3, 0}, 0}, {{4, 1}, 1}};
    groups.push_back(std::make_unique<AxisFilters<5, 2>>(travellingLaw(way, options), places));
  } else {
    const std::vector<AxisPlace<1>> places = {{{0}, 0}, {{1}, 1}};
    groups.push_back(std::make_unique<AxisFilters<4, 1>>(driftingLaw(way, options), places));
  }
  const std::vector<AxisPlace<1>> height = {{{2}, 2}};
  groups.push_back(std::make_unique<AxisFilters<2, 1>>(
      constantVelocityLaw({options.sample_sigma, options.height_density}), height));
  return groups;
}

std::unique_ptr<MotionModel> knownPendulum(Way way, TrajectoryKind kind,
                                           const PendulumMotionOptions& options,
                                           LinearMotion::Label label) {
  label.name = nameOf(way);
  return std::make_unique<LinearMotion>(kind, std::move(label), groupsOf(way, kind, options));
}

/// Waits for the start's fit, then is given all that was gathered.
class StartedPendulum final : public MotionModel {
 public:
  StartedPendulum(Way way, TrajectoryKind kind, const PendulumMotionOptions& options)
      : way_(way), kind_(kind), options_(options), start_(kind, options.gravity) {}

  [[nodiscard]] std::string name() const override { return nameOf(way_); }

  Outcome<FilterUpdate> update(Time time, const Eigen::VectorXd& value) override {
    if (pendulum_) {
      return pendulum_->update(time, value);
    }
    if (!value.allFinite()) {
      return Refusal{"not finite"};
    }
    if (!gathered_.empty() && time <= gathered_.back().first) {
      return Refusal{"late or duplicate time stamp"};
    }
    gathered_.emplace_back(time, value);
    if (const auto fit = start_.add(time, value)) {
      begin(*fit);
    }
    return FilterUpdate{time, 0.0, 0};
  }

  [[nodiscard]] Outcome<Gaussian<Eigen::Dynamic>> predict(Time time) const override {
    if (!pendulum_) {
      return Refusal{gathered_.empty() ? "no measurement yet" : "not started yet"};
    }
    return pendulum_->predict(time);
  }

  [[nodiscard]] std::vector<NamedParameter> parameters() const override {
    return pendulum_ ? pendulum_->parameters() : std::vector<NamedParameter>{};
  }

  [[nodiscard]] std::string note() const override {
    return pendulum_ ? pendulum_->note() : "found no swing to start from";
  }

 private:
  void begin(const PendulumFit& fit) {
    options_.length_m = fit.length_m;
    options_.damping_per_s = fit.damping_per_s;
    char note[96];
    std::snprintf(note, sizeof(note), "length and damping from the first %.2f s, then kept",
                  gathered_.back().first - gathered_.front().first);
    pendulum_ = knownPendulum(way_, kind_, options_,
                              {"",
                               note,
                               {{"length_m", fit.length_m, fit.length_sigma_m},
                                {"damping_per_s", fit.damping_per_s, fit.damping_sigma_per_s}}});
    for (const auto& [time, value] : gathered_) {
      static_cast<void>(pendulum_->update(time, value));
    }
    gathered_.clear();
  }

  Way way_;
  TrajectoryKind kind_;
  PendulumMotionOptions options_;
  PendulumStart start_;
  std::vector<std::pair<Time, Eigen::VectorXd>> gathered_;
  std::unique_ptr<MotionModel> pendulum_;
};

std::unique_ptr<MotionModel> makePendulum(Way way, TrajectoryKind kind,
                                          const PendulumMotionOptions& options) {
  assert(options.sample_sigma > 0.0 && options.frame_s > 0.0);
  if (!options.length_m) {
    return std::make_unique<StartedPendulum>(way, kind, options);
  }
  return knownPendulum(
      way, kind, options,
      {"",
       "length and damping as told",
       {{"length_m", *options.length_m, 0.0}, {"damping_per_s", options.damping_per_s, 0.0}}});
}

}  // namespace

std::unique_ptr<MotionModel> makeReportPendulum(TrajectoryKind kind,
                                                const PendulumMotionOptions& options) {
  return makePendulum(Way::kReport, kind, options);
}

std::unique_ptr<MotionModel> makeExactPendulum(TrajectoryKind kind,
                                               const PendulumMotionOptions& options) {
  return makePendulum(Way::kExact, kind, options);
}

}  // namespace ringhook

#include "calib/solve/plan_search.h"

#include <cmath>
#include <limits>

namespace ringhook {
namespace {

constexpr int kBaselines = 200;
constexpr int kVergences = 40;
constexpr int kBoxSteps = 4;

Eigen::Vector3d inBox(const WorkBox& box, int i, int j, int k, int steps) {
  const Eigen::Vector3d share = Eigen::Vector3d(i, j, k) / steps - Eigen::Vector3d::Constant(0.5);
  return box.centre_m + box.size_m.cwiseProduct(share);
}

double roomOfBox(const PlanView& view, const WorkBox& box) {
  double room = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    room = std::min(room, view.room(inBox(box, corner & 1, (corner >> 1) & 1, corner >> 2, 1)));
  }
  return room;
}

double roomAt(const PlanWish& wish, double baseline_m, double vergence_rad) {
  return roomOfBox(PlanView(plannedRig({wish.sensor, baseline_m, vergence_rad})), wish.box);
}

/// The vergence with most room: coarse, then by halving steps around the best one.
double roomiestVergence(const PlanWish& wish, double baseline_m) {
  const double near =
      std::max(0.05 * wish.box.centre_m.z(), wish.box.centre_m.z() - 0.5 * wish.box.size_m.z());
  double step = crossingVergence(baseline_m, near) / kVergences;
  double best = 0.0;
  double room = roomAt(wish, baseline_m, best);
  const auto consider = [&](double vergence) {
    const double here = vergence < 0.0 ? room : roomAt(wish, baseline_m, vergence);
    if (here > room) {
      room = here;
      best = vergence;
    }
  };
  for (int i = 1; i <= kVergences; ++i) {
    consider(i * step);
  }
  for (; step > 1e-6; step *= 0.5) {
    consider(best - step);
    consider(best + step);
  }
  return best;
}

PlanChoice choiceAt(const PlanWish& wish, double baseline_m) {
  PlanChoice choice;
  choice.setup = {wish.sensor, baseline_m, roomiestVergence(wish, baseline_m)};
  choice.error = boxError(PlanView(plannedRig(choice.setup)), wish.box, wish.sigma_px);
  return choice;
}

/// The step from a baseline that does not do to one that does, bisected to a tenth of a millimetre.
PlanChoice firstThatDoes(const PlanWish& wish, double too_short_m, PlanChoice does) {
  while (does.setup.baseline_m - too_short_m > 1e-4) {
    const double middle = 0.5 * (does.setup.baseline_m + too_short_m);
    const PlanChoice tried = choiceAt(wish, middle);
    if (tried.error.worst_m <= wish.wanted_m) {
      does = tried;
    } else {
      too_short_m = middle;
    }
  }
  return does;
}

}  // namespace

BoxError boxError(const PlanView& view, const WorkBox& box, double sigma_px) {
  BoxError error;
  error.room_px = roomOfBox(view, box);
  if (!(error.room_px >= 0.0)) {
    error.worst_m = error.rms_m = std::numeric_limits<double>::infinity();
    return error;
  }
  double sum = 0.0;
  const int count = kBoxSteps + 1;
  for (int n = 0; n < count * count * count; ++n) {
    const Eigen::Vector3d point =
        inBox(box, n % count, (n / count) % count, n / (count * count), kBoxSteps);
    const double variance = pointCovariance(view, point, sigma_px).trace();
    sum += variance;
    error.worst_m = std::max(error.worst_m, std::sqrt(variance));
  }
  error.rms_m = std::sqrt(sum / (count * count * count));
  return error;
}

Outcome<PlanAdvice> adviseSetup(const PlanWish& wish) {
  PlanAdvice advice;
  advice.finest.error.worst_m = std::numeric_limits<double>::infinity();
  double roomiest = -std::numeric_limits<double>::infinity();
  double previous = 0.0;
  for (int i = 1; i <= kBaselines; ++i) {
    const double baseline_m = wish.max_baseline_m * i / kBaselines;
    const PlanChoice choice = choiceAt(wish, baseline_m);
    roomiest = std::max(roomiest, choice.error.room_px);
    if (choice.error.worst_m < advice.finest.error.worst_m) {
      advice.finest = choice;
    }
    if (!advice.shortest && choice.error.worst_m <= wish.wanted_m) {
      advice.shortest = firstThatDoes(wish, previous, choice);
    }
    previous = baseline_m;
  }
  if (!(roomiest >= 0.0)) {
    return Refusal{"no allowed baseline shows the whole workspace to both cameras"};
  }
  return advice;
}

}  // namespace ringhook

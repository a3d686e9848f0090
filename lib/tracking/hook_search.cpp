#include "tracking/hook_search.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "tracking/edge_field.h"

namespace ringhook {
namespace {

// travel [m], angle about x_f, angle about y_f [rad], how much longer it hangs [m]
using Place = Eigen::Vector4d;

constexpr double kCoarseCutoffPx = 24.0;  // The grid's steps move the J by about as much.
constexpr double kFineCutoffPx = 10.0;
constexpr double kCoarseSampleM = 0.012;
constexpr double kFineSampleM = 0.004;
constexpr std::size_t kRefined = 12;  // Places of the coarse grid that are looked at closely.
constexpr double kLengthStepM = 0.004;
constexpr double kElsewhereM = 0.04;  // Further apart than this is another place.

struct Match {
  Place place;
  double score;
};

/// Mean nearness of the projected model to like image edges over all views, 0 to 1.
double scoreOf(const std::vector<EdgeField>& fields, const std::vector<EdgeSample>& samples,
               const Pose& c1Mo) {
  constexpr double kAhead = 1e-3;  // second point along the edge, for its direction [m]
  double sum = 0.0;
  for (const EdgeField& field : fields) {
    const PinholeView& camera = field.camera();
    const Pose cMo = camera.cMc1 * c1Mo;
    for (const EdgeSample& sample : samples) {
      const Eigen::Vector3d p = cMo * sample.point_o;
      const Eigen::Vector3d q = p + kAhead * (cMo.linear() * sample.tangent_o);
      if (p.z() < kAhead || q.z() < kAhead) {
        continue;
      }
      const Eigen::Vector2d a(camera.fx * p.x() / p.z(), camera.fy * p.y() / p.z());
      const Eigen::Vector2d b(camera.fx * q.x() / q.z(), camera.fy * q.y() / q.z());
      sum += field.nearness(a + Eigen::Vector2d(camera.cx, camera.cy), b - a);
    }
  }
  return sum / (255.0 * static_cast<double>(std::max<std::size_t>(1, samples.size()) *
                                            std::max<std::size_t>(1, fields.size())));
}

class Search {
 public:
  Search(const RectifiedFrame& frame, const EdgeModel& model, const SearchSpace& space)
      : space_(space),
        coarse_samples_(sampleEdges(model, kCoarseSampleM)),
        fine_samples_(sampleEdges(model, kFineSampleM)) {
    for (const RectifiedView& view : frame.views) {
      coarse_.emplace_back(view, kCoarseCutoffPx);
      fine_.emplace_back(view, kFineCutoffPx);
    }
  }

  [[nodiscard]] Pose c1Mo(const Place& place) const {
    return space_.fMc1.inverse() * hookAt(space_, place[0], place[1], place[2], place[3]);
  }

  /// The best places of the grid, no two of them next to each other.
  [[nodiscard]] std::vector<Match> coarse() const {
    std::vector<Match> all;
    const Place step = coarseStep();
    for (double s = space_.travel_from_m; s <= space_.travel_to_m; s += step[0]) {
      for (double a = -space_.swing_x; a <= space_.swing_x; a += step[1]) {
        for (double b = -space_.swing_y; b <= space_.swing_y; b += step[2]) {
          const Place place(s, a, b, 0.0);
          all.push_back({place, scoreOf(coarse_, coarse_samples_, c1Mo(place))});
        }
      }
    }
    std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.score > b.score; });
    std::vector<Match> best;
    for (std::size_t i = 0; i < all.size() && best.size() < kRefined; ++i) {
      const bool new_place = std::none_of(best.begin(), best.end(), [&](const Match& m) {
        return ((m.place - all[i].place).cwiseQuotient(step)).cwiseAbs().maxCoeff() < 2.5;
      });
      if (new_place) {
        best.push_back(all[i]);
      }
    }
    return best;
  }

  /// Climbs along the coordinates and their sums with steps that shrink, from the best length.
  [[nodiscard]] Match refine(const Match& from) const {
    Match best{from.place, scoreOf(fine_, fine_samples_, c1Mo(from.place))};
    for (double longer = -space_.longer; longer <= space_.longer; longer += kLengthStepM) {
      tryPlace(Place(from.place[0], from.place[1], from.place[2], longer), best);
    }
    Place step = coarseStep() / 2.0;
    for (int level = 0; level < 5;) {
      const Match before = best;
      for (const Place& way : ways()) {
        tryPlace(before.place + way.cwiseProduct(step), best);
        tryPlace(before.place - way.cwiseProduct(step), best);
      }
      if (!(best.score > before.score)) {
        step /= 2.0;
        ++level;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] Place coarseStep() const {
    return {space_.travel_step_m, space_.swing_step, space_.swing_step, kLengthStepM};
  }

  /// The last two turn the hook about its J: the pivot moves on while the swing falls back.
  [[nodiscard]] std::vector<Place> ways() const {
    const double arm = space_.pivot_o.norm();
    const double ratio = space_.travel_step_m / (arm * space_.swing_step);
    return {{1, 0, 0, 0}, {0, 1, 0, 0},     {0, 0, 1, 0},
            {0, 0, 0, 1}, {1, ratio, 0, 0}, {1, -ratio, 0, 0}};
  }

  void tryPlace(const Place& place, Match& best) const {
    const double reach = space_.travel_step_m;
    if (place[0] < space_.travel_from_m - reach || place[0] > space_.travel_to_m + reach ||
        std::abs(place[3]) > space_.longer) {
      return;
    }
    const double score = scoreOf(fine_, fine_samples_, c1Mo(place));
    if (score > best.score) {
      best = {place, score};
    }
  }

  SearchSpace space_;
  std::vector<EdgeSample> coarse_samples_;
  std::vector<EdgeSample> fine_samples_;
  std::vector<EdgeField> coarse_;
  std::vector<EdgeField> fine_;
};

void check(const SearchSpace& space) {
  if (!(space.travel_step_m > 0.0) || !(space.swing_step > 0.0) ||
      !(space.travel_to_m >= space.travel_from_m) || !(space.swing_x >= 0.0) ||
      !(space.swing_y >= 0.0)) {
    throw InputError("hook search: positive steps and a range that is not empty expected");
  }
}

}  // namespace

Pose hookAt(const SearchSpace& space, double travel_m, double angle_x, double angle_y,
            double longer_m) {
  Pose fMo = Pose::Identity();
  fMo.linear() = (Eigen::AngleAxisd(angle_x, Eigen::Vector3d::UnitX()) *
                  Eigen::AngleAxisd(angle_y, Eigen::Vector3d::UnitY()))
                     .toRotationMatrix();
  const Eigen::Vector3d pivot_f = space.pivot_start_f + travel_m * space.belt_direction_f;
  const Eigen::Vector3d longer_o(0.0, 0.0, longer_m);
  fMo.translation() = pivot_f - fMo.linear() * (space.pivot_o + longer_o);
  return fMo;
}

Outcome<Pose> findHook(const RectifiedFrame& frame, const EdgeModel& model,
                       const SearchSpace& space) {
  check(space);
  const Search search(frame, model, space);
  std::vector<Match> matches;
  for (const Match& match : search.coarse()) {
    matches.push_back(search.refine(match));
  }
  const auto best = std::max_element(matches.begin(), matches.end(),
                                     [](auto& a, auto& b) { return a.score < b.score; });
  if (best == matches.end() || best->score < space.min_score) {
    return Refusal{"no hook found"};
  }
  const Pose found = search.c1Mo(best->place);
  const bool rivalled = std::any_of(matches.begin(), matches.end(), [&](const Match& other) {
    const double apart = (search.c1Mo(other.place).translation() - found.translation()).norm();
    return apart > kElsewhereM && other.score > best->score - space.min_lead;
  });
  if (rivalled) {
    return Refusal{"two places look like the hook"};
  }
  return found;
}

}  // namespace ringhook

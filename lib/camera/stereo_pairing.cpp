#include "camera/stereo_pairing.h"

namespace ringhook {

void StereoPairing::add(int side, MonoFrame frame) {
  waiting_[side].push_back(std::move(frame));
  if (waiting_[side].size() > kMostWaiting) {
    dropOldest(side);
  }
}

std::optional<std::pair<MonoFrame, MonoFrame>> StereoPairing::take() {
  while (!waiting_[0].empty() && !waiting_[1].empty()) {
    const double left_later_s = waiting_[0].front().time - waiting_[1].front().time;
    if (left_later_s > tolerance_s_) {
      dropOldest(1);
    } else if (left_later_s < -tolerance_s_) {
      dropOldest(0);
    } else {
      std::pair pair{std::move(waiting_[0].front()), std::move(waiting_[1].front())};
      waiting_[0].pop_front();
      waiting_[1].pop_front();
      return pair;
    }
  }
  return std::nullopt;
}

void StereoPairing::dropOldest(int side) {
  ++(excused_(waiting_[side].front().time) ? excused_alone_ : unpaired_[side]);
  waiting_[side].pop_front();
}

}  // namespace ringhook

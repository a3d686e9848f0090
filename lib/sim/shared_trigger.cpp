#include "sim/shared_trigger.h"

#include <chrono>
#include <exception>
#include <utility>

namespace ringhook {

std::optional<Exposed> SharedTrigger::expose(int side, const Window& region, double exposure_s) {
  const auto me = static_cast<std::size_t>(side);
  const std::size_t other = 1 - me;
  Lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !making_; });
  ExposureRequest request;
  request.exposure_s = exposure_s;
  request.regions[me] = region;
  if (ready_[other]) {
    request.regions[other] = *std::exchange(ready_[other], std::nullopt);
    return makePair(lock, request, me);
  }
  given_[me].reset();
  ready_[me] = region;
  const std::int64_t failures = pairs_without_result_;
  const auto served = [&] { return closed_ || given_[me] || pairs_without_result_ > failures; };
  changed_.wait_for(lock, std::chrono::duration<double>(patience_s_), served);
  if (!ready_[me]) {  // the partner took this camera along
    changed_.wait(lock, served);
    return std::exchange(given_[me], std::nullopt);
  }
  ready_[me].reset();
  return closed_ ? std::nullopt : makePair(lock, request, me);
}

std::optional<Exposed> SharedTrigger::makePair(Lock& lock, const ExposureRequest& request,
                                               std::size_t side) {
  if (closed_) {
    ++pairs_without_result_;
    changed_.notify_all();
    return std::nullopt;
  }
  making_ = true;
  lock.unlock();
  std::optional<ExposedPair> pair;
  std::exception_ptr failure;
  try {
    pair = source_(request);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  making_ = false;
  const std::size_t other = 1 - side;
  std::optional<Exposed> mine;
  if (pair) {
    if (!request.regions[other].empty()) {
      given_[other] = Exposed{pair->start_ns, std::move(pair->images[other])};
    }
    mine = Exposed{pair->start_ns, std::move(pair->images[side])};
  } else {
    ++pairs_without_result_;
  }
  changed_.notify_all();
  if (failure) {
    std::rethrow_exception(failure);
  }
  return mine;
}

void SharedTrigger::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

}  // namespace ringhook

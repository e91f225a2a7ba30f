// SPDX-License-Identifier: MIT
#include "editing/solve/budget.hpp"

#include <algorithm>
#include <cmath>

namespace carom::editing_detail {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kLongestWait = 1e8;  // s, that a clock can add
/// What sums of prices lose to rounding.
constexpr double kSlack = 1e-9;

}  // namespace

Budget::Budget(int limit, double seconds, std::stop_token stop) : limit_(limit), stop_(std::move(stop)) {
  if (seconds < kLongestWait)
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(std::max(0.0, seconds)));
}

Budget Budget::replayed(int limit, std::optional<int> cut_after) {
  Budget budget(limit);
  budget.cut_after_ = cut_after;
  return budget;
}

int Budget::left() const { return static_cast<int>(std::floor((limit_ - reserve_ - spent_) / price_ + kSlack)); }

bool Budget::take() {
  if (left() < 1 || expired()) return false;
  count(1);
  return true;
}

bool Budget::pass() {
  if (expired()) return false;
  ++done_;
  return true;
}

void Budget::allow(int units) {
  setPrice(1, 0);
  limit_ = spent_ + units;
}

bool Budget::expired() {
  if (stop_.stop_requested()) end(Halt::cancelled);
  if (cut_after_ ? done_ >= *cut_after_ : secondsLeft() <= 0) end(Halt::out_of_time);
  return halt_ != Halt::none;
}

void Budget::end(Halt why) {
  if (halt_ == Halt::none) halt_ = why, cut_at_ = done_;
}

double Budget::secondsLeft() const {
  return deadline_ ? Seconds(*deadline_ - Clock::now()).count() : std::numeric_limits<double>::infinity();
}

}  // namespace carom::editing_detail

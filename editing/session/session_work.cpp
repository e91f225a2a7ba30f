// SPDX-License-Identifier: MIT
#include "editing/session/session_work.hpp"

#include <cmath>

namespace carom::editing_detail {
namespace {

constexpr double kLongestWait = 1e8;  // s, that a clock can add
/// What sums of prices lose to rounding.
constexpr double kSlack = 1e-9;

}  // namespace

Work::Work(int limit, double seconds, std::optional<int> cut_after) : limit_(limit), cut_after_(cut_after) {
  using Clock = std::chrono::steady_clock;
  if (!cut_after && seconds < kLongestWait)
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

int Work::left() const { return static_cast<int>(std::floor((limit_ - reserve_ - spent_) / price_ + kSlack)); }

bool Work::take() {
  if (cut_at_ || left() < 1) return false;
  if (cut_after_ ? done_ >= *cut_after_ : deadline_ && std::chrono::steady_clock::now() >= *deadline_) {
    cut_at_ = done_;
    return false;
  }
  ++done_;
  spent_ += price_;
  return true;
}

void Work::takeReserved() {
  ++done_;
  spent_ += price_;
}

}  // namespace carom::editing_detail

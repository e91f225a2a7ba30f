// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

namespace carom::editing_detail {

/// How much an update may still do: counted, so that it is the same everywhere, and watched by the clock for safety.
/// Internal to editing/.
class Work {
 public:
  /// `limit`: in simulations of the whole scene, or in iterations. `cut_after`: of a replay, so many takes after which
  /// the clock ended it when it was recorded; then there is no clock.
  Work(int limit, double seconds, std::optional<int> cut_after);

  /// From here on a take costs `price`, and `reserve` is kept for later. A motion of some of the bodies costs their
  /// share of those that move.
  void setPrice(double price, double reserve) { price_ = price, reserve_ = reserve; }

  /// Takes one unit; false when there is none left.
  bool take();
  /// Takes what was kept for later, whatever the clock says.
  void takeReserved();
  int done() const { return done_; }  ///< takes
  int left() const;                   ///< takes, at the present price
  bool cutByClock() const { return cut_at_.has_value(); }
  /// Takes after which the clock ended it.
  std::optional<int> cutAfter() const { return cut_at_; }

 private:
  double limit_, spent_ = 0, price_ = 1, reserve_ = 0;
  int done_ = 0;
  std::optional<int> cut_after_, cut_at_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
};

}  // namespace carom::editing_detail

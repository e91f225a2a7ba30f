// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <stop_token>

namespace carom::editing_detail {

/// Why a search must end early.
enum class Halt { none, out_of_time, cancelled };

/// How much an edit, or an update of a session, may still do: counted, so that it is the same everywhere, and watched
/// by the clock and a stop token. Internal to editing/.
class Budget {
 public:
  /// `limit`: in steps of a solver, or in simulations of the whole scene.
  explicit Budget(int limit, double seconds = std::numeric_limits<double>::infinity(), std::stop_token stop = {});
  /// Of a replay: without a clock, but out of time after so many units, as it was ended when it was recorded.
  static Budget replayed(int limit, std::optional<int> cut_after);

  /// From here on a unit costs `price`, and `reserve` is kept for later. A motion of some of the bodies costs their
  /// share of those that move.
  void setPrice(double price, double reserve) { price_ = price, reserve_ = reserve; }

  /// Takes one unit; false when there is none left, or where it has ended.
  bool take();
  /// Takes units that have been used, or kept for later, whatever there is left.
  void count(int units) { done_ += units, spent_ += units * price_; }
  /// Begins or ends a stretch of work: asks whether it has ended, and counts that it was asked although that costs
  /// nothing, so that no two places have the same count. False where it has ended.
  bool pass();
  /// From here on so many more units of price 1.
  void allow(int units);
  int done() const { return done_; }  ///< units taken
  int left() const;                   ///< units, at the present price

  /// Looks at the clock and the stop token, and says whether it has ended.
  bool expired();
  /// Ends it, unless it has ended.
  void end(Halt why);
  Halt halt() const { return halt_; }
  /// Units after which the clock or a stop ended it.
  std::optional<int> cutAfter() const { return halt_ == Halt::none ? std::nullopt : std::optional(cut_at_); }
  double secondsLeft() const;
  /// For work that ends within a unit, whose results then do not count.
  const std::stop_token& stop() const { return stop_; }

 private:
  double limit_, spent_ = 0, price_ = 1, reserve_ = 0;
  int done_ = 0, cut_at_ = 0;
  Halt halt_ = Halt::none;
  std::optional<int> cut_after_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  std::stop_token stop_;
};

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#include "python/src/evaluator_batch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "adjoint/base/errors.h"

namespace carom::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooksOfABatch{20};  // a point alone tells of itself only if it takes long

/// Evaluates many points in several threads.
class Batch {
  using Clock = std::chrono::steady_clock;

 public:
  Batch(const NlpEvaluator& evaluator, const double* x, std::size_t count, bool with_jacobian)
      : evaluator_(evaluator),
        x_(x),
        count_(count),
        n_(evaluator.variables().size()),
        m_(evaluator.rows().size()),
        rows_{std::vector<double>(count * m_), std::vector<double>(with_jacobian ? count * m_ * n_ : 0)},
        with_jacobian_(with_jacobian),
        thrown_(count) {}

  /// Evaluates points that no other thread has begun, until one fails or `watch` stops. Points are begun in their order,
  /// so that all before the first that fails are complete. Only one thread, the caller's, looks for Ctrl-C.
  void work(Watch& watch, bool looks) {
    const auto look = looks ? watch.progress() : std::function<void(const SimulateProgress&)>();
    const std::stop_token stop = watch.stop();
    auto last_look = Clock::now();
    for (std::size_t i = next_++; i < count_ && !failed_ && !stop.stop_requested(); i = next_++) {
      try {
        evaluate(i, stop, look);
      } catch (...) {
        thrown_[i] = std::current_exception();
        failed_ = true;
      }
      if (looks && Clock::now() - last_look > kBetweenLooksOfABatch) look({}), last_look = Clock::now();
    }
  }

  /// Throws what the first point has thrown, or gives all rows.
  RowsOfMany result() {
    for (const std::exception_ptr& one : thrown_)
      if (one) std::rethrow_exception(one);
    return std::move(rows_);
  }

 private:
  void evaluate(std::size_t i, std::stop_token stop, const std::function<void(const SimulateProgress&)>& progress) {
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(x_ + i * n_, static_cast<Eigen::Index>(n_));
    const NlpPoint point = evaluator_.at(x, std::move(stop), progress);
    if (!point.available())
      throw NotComputable(count_ == 1 ? point.message() : "point " + std::to_string(i) + ": " + point.message());
    std::copy_n(point.values().data(), m_, rows_.values.begin() + static_cast<std::ptrdiff_t>(i * m_));
    if (!with_jacobian_) return;
    using RowByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd entries = point.jacobian().entries;
    Eigen::Map<RowByRow>(rows_.entries.data() + i * m_ * n_, entries.rows(), entries.cols()) = entries;
  }

  const NlpEvaluator& evaluator_;
  const double* x_;
  std::size_t count_, n_, m_;
  RowsOfMany rows_;
  bool with_jacobian_;
  std::vector<std::exception_ptr> thrown_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
};

}  // namespace

RowsOfMany rowsOfMany(const NlpEvaluator& evaluator, const double* x, std::size_t count, bool with_jacobian, int threads,
                      Watch& watch) {
  Batch batch(evaluator, x, count, with_jacobian);
  {
    std::vector<std::jthread> others;
    for (std::size_t k = 1; k < std::min(static_cast<std::size_t>(threads), count); ++k)
      others.emplace_back([&] { batch.work(watch, false); });
    batch.work(watch, true);
  }
  watch.finish();
  return batch.result();
}

nb::tuple rowsAt(const NlpEvaluator& evaluator, const ArrayLike& x, bool with_jacobian, int threads) {
  if (threads < 1) throw InputError("threads", "found " + std::to_string(threads) + ", expected 1 or more");
  const std::size_t m = evaluator.rows().size(), n = evaluator.variables().size();
  const auto points = numbersOf(x, "x", {-1, static_cast<long>(n)});
  const std::size_t count = points.shape(0);
  Watch watch;
  RowsOfMany rows = [&] {
    const Computing free;  // before other threads begin, which take over how it computes
    return rowsOfMany(evaluator, points.data(), count, with_jacobian, threads, watch);
  }();
  nb::object values = nb::cast(owning<Array<-1, -1>>(std::move(rows.values), {count, m}), nb::rv_policy::automatic);
  if (!with_jacobian) return nb::make_tuple(values, nb::none());
  return nb::make_tuple(values, owning<Array<-1, -1, -1>>(std::move(rows.entries), {count, m, n}));
}

}  // namespace carom::python

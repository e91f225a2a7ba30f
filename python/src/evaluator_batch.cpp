// SPDX-License-Identifier: MIT
#include "python/src/evaluator_batch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "adjoint/base/errors.h"
#include "python/src/interruptible.hpp"

namespace carom::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooksOfABatch{20};  // a point alone tells of itself only if it takes long

/// Rows of many points, and their Jacobians, in C order.
class Batch {
  using Clock = std::chrono::steady_clock;

 public:
  Batch(const NlpEvaluator& evaluator, const double* x, std::size_t count, bool with_jacobian)
      : evaluator_(evaluator),
        x_(x),
        count_(count),
        n_(evaluator.variables().size()),
        m_(evaluator.rows().size()),
        values_(count * m_),
        entries_(with_jacobian ? count * m_ * n_ : 0),
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

  /// With the GIL: throws what the first point has thrown, or gives the values (count, m) and the Jacobians (count, m, n).
  nb::tuple result() {
    for (const std::exception_ptr& one : thrown_)
      if (one) std::rethrow_exception(one);
    nb::object values = nb::cast(owning<Array<-1, -1>>(std::move(values_), {count_, m_}), nb::rv_policy::automatic);
    if (!with_jacobian_) return nb::make_tuple(values, nb::none());
    return nb::make_tuple(values, owning<Array<-1, -1, -1>>(std::move(entries_), {count_, m_, n_}));
  }

 private:
  void evaluate(std::size_t i, std::stop_token stop, const std::function<void(const SimulateProgress&)>& progress) {
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(x_ + i * n_, static_cast<Eigen::Index>(n_));
    const NlpPoint point = evaluator_.at(x, std::move(stop), progress);
    if (!point.available())
      throw NotComputable(count_ == 1 ? point.message() : "point " + std::to_string(i) + ": " + point.message());
    std::copy_n(point.values().data(), m_, values_.begin() + static_cast<std::ptrdiff_t>(i * m_));
    if (!with_jacobian_) return;
    using RowByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd entries = point.jacobian().entries;
    Eigen::Map<RowByRow>(entries_.data() + i * m_ * n_, entries.rows(), entries.cols()) = entries;
  }

  const NlpEvaluator& evaluator_;
  const double* x_;
  std::size_t count_, n_, m_;
  std::vector<double> values_, entries_;
  bool with_jacobian_;
  std::vector<std::exception_ptr> thrown_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
};

}  // namespace

nb::tuple rowsAt(const NlpEvaluator& evaluator, const ArrayLike& x, bool with_jacobian, int threads) {
  if (threads < 1) throw InputError("threads", "found " + std::to_string(threads) + ", expected 1 or more");
  const auto points = numbersOf(x, "x", {-1, static_cast<long>(evaluator.variables().size())});
  Batch batch(evaluator, points.data(), points.shape(0), with_jacobian);
  Watch watch;
  {
    const Computing free;  // before other threads begin, which take over how it computes
    std::vector<std::jthread> others;
    for (std::size_t k = 1; k < std::min(static_cast<std::size_t>(threads), points.shape(0)); ++k)
      others.emplace_back([&] { batch.work(watch, false); });
    batch.work(watch, true);
  }
  watch.finish();
  return batch.result();
}

}  // namespace carom::python

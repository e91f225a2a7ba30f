#include "editing/edit_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "adjoint/errors.h"

namespace carom {
namespace {

constexpr std::size_t kRecentPoints = 4;
/// An impact that is held may come later than at the start: so much of its time is simulated at first.
constexpr double kMarginAfterLast = 1.25;
/// Longest time budget that a clock can add.
constexpr double kLongestBudget = 1e8;

}  // namespace

EditSearch::EditSearch(const EditProblem& problem, const EditOptions& options)
    : problem_(problem), options_(options), lower_(problem.lower()), upper_(problem.upper()), until_(problem.horizon) {
  if (options.time_budget_seconds < kLongestBudget) {
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> budget(std::max(0.0, options.time_budget_seconds));
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(budget);
  }
}

bool EditSearch::expired() {
  if (deadline_ && std::chrono::steady_clock::now() >= *deadline_ && halt_ == Halt::none) halt_ = Halt::out_of_time;
  return halt_ != Halt::none;
}

bool EditSearch::step(double objective, double violation) {
  ++iterations_;
  if (expired()) return false;
  if (!silent_ && options_.progress && !options_.progress({iterations_, objective, violation})) halt_ = Halt::cancelled;
  return halt_ == Halt::none;
}

void readRows(const EditProblem& problem, EditPoint& point) {
  point.rows = problem.constraints.evaluate(point.motion, problem.timesOf(point.changes));
  point.violation = 0;
  for (double residual : point.rows.scaled) point.violation = std::max(point.violation, std::abs(residual));
  for (double h : point.validity) point.violation = std::max(point.violation, -h);
}

EditPointPtr pointAt(const EditProblem& problem, const Eigen::VectorXd& unknowns, double until, bool nearest_times,
                     const MotionMaker& maker) {
  auto point = std::make_shared<EditPoint>();
  point->changes = unknowns;
  point->values = problem.valuesOf(unknowns);
  if (maker.like) {
    Replay replay = replayAt(problem, point->values, maker.like->motion, until, maker.contacts);
    if (!replay.complete) return nullptr;
    point->motion = std::move(replay.motion);
  } else {
    point->motion = simulateAt(problem, point->values, until, maker.contacts);
  }
  if (nearest_times && problem.times() > 0)
    point->changes.tail(problem.times()) = problem.unknownTimes(problem.constraints.nearestTimes(point->motion));
  point->validity = problem.validity.evaluate(problem.controls, point->values);
  point->objective = problem.objective(unknowns);
  readRows(problem, *point);
  point->signature = point->motion.signature(problem.constraints.extentIn(point->motion, point->rows.times).events);
  return point;
}

EditPointPtr EditSearch::evaluateStart() {
  EditPointPtr point = pointAt(problem_, Eigen::VectorXd::Zero(problem_.unknowns()), until_, true);
  if (!point->rows.available) return point;
  until_ = std::min(problem_.horizon, kMarginAfterLast * problem_.constraints.extentIn(point->motion).time);
  recent_.push_back(point);
  consider(point);
  return point;
}

EditPointPtr EditSearch::make(const Eigen::VectorXd& changes, bool nearest_times, const MotionMaker& maker) const {
  if (!changes.allFinite()) return nullptr;
  EditPointPtr point;
  try {
    point = pointAt(problem_, changes, until_, nearest_times, maker);
    if (point && !point->rows.available && until_ < problem_.horizon)
      point = pointAt(problem_, changes, problem_.horizon, nearest_times, maker);
  } catch (const InputError&) {
    return nullptr;  // this trial makes no sense (bodies overlap, moments are impossible): others may
  }
  return point && point->rows.available && point->rows.scaled.allFinite() ? point : nullptr;
}

EditPointPtr EditSearch::evaluate(const Eigen::VectorXd& changes, bool nearest_times) {
  for (const EditPointPtr& point : recent_) {
    if (!nearest_times && point->changes == changes) return point;
  }
  if (expired()) return nullptr;
  const EditPointPtr point = make(changes, nearest_times, maker_);
  if (!point) return nullptr;
  if (recent_.size() == kRecentPoints) recent_.erase(recent_.begin());
  recent_.push_back(point);
  consider(point);
  return point;
}

EditSearch EditSearch::branch(const MotionMaker& maker, bool silent) const {
  EditSearch other(*this);
  other.maker_ = maker;
  other.silent_ = silent;
  other.recent_.clear();
  other.best_ = nullptr;
  return other;
}

void differentiate(const EditProblem& problem, EditPoint& point) {
  if (point.row_jacobian) return;
  const Eigen::VectorXd rates = problem.rates(point.changes);
  const Eigen::Index n = problem.controls.size(), k = problem.times();
  Eigen::MatrixXd J(problem.constraints.size(), n + k);
  J.leftCols(n) = jacobianByAdjoint(problem, point.values, point.motion, point.rows);
  J.rightCols(k) = jacobianByTimes(problem, point.motion, point.rows);
  J *= rates.asDiagonal();
  const std::vector<Row>& rows = problem.constraints.rows();
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) /= rows[i].scale;
  point.row_jacobian = std::move(J);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(problem.validity.size(), n + k);
  H.leftCols(n) = problem.validity.jacobian(problem.controls, point.values) * rates.head(n).asDiagonal();
  point.validity_jacobian = std::move(H);
}

void EditSearch::consider(const EditPointPtr& point) {
  if (best_) {
    const bool both = reached(*point) && reached(*best_);
    const bool better = both ? point->objective < best_->objective : point->violation < best_->violation;
    if (!better) return;
  }
  best_ = point;
}

namespace {

/// Validity rows nearer than this to their limit are held at it.
constexpr double kActiveValidity = 1e-6;
/// Steps across the border of an impact sequence that may make things worse at first.
constexpr int kLeaps = 8;
/// Where rounding leaves nothing to improve.
constexpr double kExact = 1e-14;
/// Steps of a free time count so much less than those of a control.
constexpr double kTimeIsCheap = 100;
/// A step that leaves a range by more than this, dimensionless, is taken again with the range held.
constexpr double kLeavesRange = 1e-12;

struct System {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;

  void add(const Eigen::MatrixXd& from, Eigen::Index row, double residual) {
    J.conservativeResize(J.rows() + 1, from.cols());
    r.conservativeResize(J.rows());
    // Rows of one length: the rank is judged by their directions.
    const double norm = from.row(row).norm(), length = norm > 0 ? norm : 1;
    J.bottomRows<1>() = from.row(row) / length;
    r[r.size() - 1] = residual / length;
  }
};

/// The rows to bring to zero: what is held at a number, ranges that `active` names, and what would be invalid or is
/// about to be.
System systemAt(const EditProblem& problem, const EditPoint& point, const std::vector<int>& active) {
  System system;
  for (int i : problem.constraints.equations()) system.add(*point.row_jacobian, i, point.rows.scaled[i]);
  for (int i : active) {
    const Row& row = problem.constraints.rows()[i];
    const double value = point.rows.values[i];
    const double limit = std::abs(value - row.lower) < std::abs(value - row.upper) ? row.lower : row.upper;
    system.add(*point.row_jacobian, i, (value - limit) / row.scale);
  }
  for (int i = 0; i < point.validity.size(); ++i)
    if (point.validity[i] < 0) system.add(*point.validity_jacobian, i, point.validity[i] - kActiveValidity);
  if (system.r.size() == 0) system.J.resize(0, point.changes.size());
  return system;
}

/// Smallest step with J step = -r (least squares where that is impossible) that stays within the bounds: numbers that
/// would leave them stop there, and the others make up for it.
Eigen::VectorXd boundedStep(const System& system, const Eigen::VectorXd& at, const Eigen::VectorXd& lower,
                            const Eigen::VectorXd& upper) {
  const Eigen::Index n = at.size();
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n), r = system.r;
  std::vector<Eigen::Index> free(static_cast<std::size_t>(n));
  for (Eigen::Index j = 0; j < n; ++j) free[static_cast<std::size_t>(j)] = j;
  while (!free.empty()) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-10);
    decomposition.compute(system.J(Eigen::all, free));
    const Eigen::VectorXd wanted = -decomposition.solve(r);
    std::vector<Eigen::Index> still_free;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Eigen::Index j = free[k];
      const double inside = std::clamp(at[j] + wanted[static_cast<Eigen::Index>(k)], lower[j], upper[j]) - at[j];
      step[j] = inside;
      if (inside == wanted[static_cast<Eigen::Index>(k)] ||
          std::abs(inside - wanted[static_cast<Eigen::Index>(k)]) <= 1e-15 * (1 + std::abs(at[j]))) {
        still_free.push_back(j);
      } else {
        r += system.J.col(j) * inside;
      }
    }
    if (still_free.size() == free.size()) break;
    free = std::move(still_free);
  }
  return step;
}

}  // namespace

Eigen::VectorXd residualsAfter(const EditSearch& search, const EditPoint& point, const Eigen::VectorXd& step) {
  const ConstraintSet& constraints = search.problem().constraints;
  Eigen::VectorXd residuals = *point.row_jacobian * step;
  for (int i = 0; i < constraints.size(); ++i) {
    const double scale = constraints.rows()[i].scale;
    residuals[i] = constraints.residual(i, point.rows.values[i] + residuals[i] * scale) / scale;
  }
  return residuals;
}

// Ranges that the step would leave are held at their limits in another try, until none is left out.
Eigen::VectorXd smallestStep(const EditSearch& search, const EditPoint& point) {
  const EditProblem& problem = search.problem();
  std::vector<int> active;
  for (int i : problem.constraints.ranges())
    if (point.rows.residuals[i] != 0) active.push_back(i);
  // A free time costs nothing, so that it goes most of the way.
  const Eigen::Index n = problem.controls.size(), times = problem.times();
  const auto stretched = [&](Eigen::VectorXd v, double factor) {
    v.tail(times) *= factor;
    return v;
  };
  for (;;) {
    System system = systemAt(problem, point, active);
    system.J.rightCols(times) *= kTimeIsCheap;
    Eigen::VectorXd step =
        boundedStep(system, stretched(point.changes, 1 / kTimeIsCheap), stretched(search.lower(), 1 / kTimeIsCheap),
                    stretched(search.upper(), 1 / kTimeIsCheap));
    step = stretched(std::move(step), kTimeIsCheap);
    if (problem.constraints.ranges().empty()) return step;
    const Eigen::VectorXd after = residualsAfter(search, point, step);
    const std::size_t before = active.size();
    for (int i : problem.constraints.ranges())
      if (std::abs(after[i]) > kLeavesRange && std::find(active.begin(), active.end(), i) == active.end())
        active.push_back(i);
    if (active.size() == before || active.size() > static_cast<std::size_t>(n + times)) return step;
  }
}

namespace {

/// The first point along a step with a smaller violation; null where there is none. `full` is the one at its end.
EditPointPtr descend(EditSearch& search, const EditPoint& from, const Eigen::VectorXd& step,
                     const std::string* signature, EditPointPtr& full) {
  for (double length = 1; length > 0.01 && search.halt() == Halt::none; length /= 2) {
    EditPointPtr trial = search.evaluate(from.changes + length * step);
    if (!trial || (signature && trial->signature != *signature)) continue;
    if (length == 1) full = trial;
    if (trial->violation < from.violation) return trial;
  }
  return nullptr;
}

}  // namespace

EditPointPtr projectOntoConstraints(EditSearch& search, EditPointPtr from, int max_steps,
                                    const std::string* signature) {
  EditPointPtr point = std::move(from), nearest = point;
  int leaps = 0;
  for (int k = 0; k < max_steps && point->violation > kExact; ++k) {
    search.differentiate(*point);
    if (!point->row_jacobian->allFinite()) break;
    EditPointPtr full;
    EditPointPtr next = descend(search, *point, smallestStep(search, *point), signature, full);
    // At the border of two impact sequences the violation may have a kink that no descent leaves.
    const bool may_leap = !signature && full && leaps < kLeaps && full->signature != point->signature;
    if (!next && may_leap) next = full, ++leaps;
    if (!next) break;
    point = std::move(next);
    if (point->violation < nearest->violation) nearest = point;
    if (!search.step(point->objective, point->violation)) break;
  }
  return nearest;
}

}  // namespace carom

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
    : problem_(problem),
      options_(options),
      lower_(problem.controls.lowerChanges()),
      upper_(problem.controls.upperChanges()),
      until_(problem.horizon) {
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
  if (options_.progress && !options_.progress({iterations_, objective, violation})) halt_ = Halt::cancelled;
  return halt_ == Halt::none;
}

EditPointPtr EditSearch::simulatePoint(const Eigen::VectorXd& changes, double until) const {
  auto point = std::make_shared<EditPoint>();
  point->changes = changes;
  point->values = problem_.controls.valuesOf(changes);
  point->motion = simulateAt(problem_, point->values, until);
  point->rows = problem_.constraints.evaluate(point->motion);
  point->signature = point->motion.signature(problem_.constraints.extentIn(point->motion).events);
  point->validity = problem_.validity.evaluate(problem_.controls, point->values);
  point->objective = 0.5 * changes.squaredNorm();
  point->violation = 0;
  for (double residual : point->rows.scaled) point->violation = std::max(point->violation, std::abs(residual));
  for (double h : point->validity) point->violation = std::max(point->violation, -h);
  return point;
}

EditPointPtr EditSearch::evaluateStart() {
  EditPointPtr point = simulatePoint(Eigen::VectorXd::Zero(problem_.controls.size()), until_);
  if (!point->rows.available) return point;
  until_ = std::min(problem_.horizon, kMarginAfterLast * problem_.constraints.extentIn(point->motion).time);
  recent_.push_back(point);
  consider(point);
  return point;
}

EditPointPtr EditSearch::evaluate(const Eigen::VectorXd& changes) {
  for (const EditPointPtr& point : recent_) {
    if (point->changes == changes) return point;
  }
  if (expired() || !changes.allFinite()) return nullptr;
  EditPointPtr point;
  try {
    point = simulatePoint(changes, until_);
    if (!point->rows.available && until_ < problem_.horizon) point = simulatePoint(changes, problem_.horizon);
  } catch (const InputError&) {
    return nullptr;  // this trial makes no sense (bodies overlap, moments are impossible): others may
  }
  if (!point->rows.available || !point->rows.scaled.allFinite()) return nullptr;
  if (recent_.size() == kRecentPoints) recent_.erase(recent_.begin());
  recent_.push_back(point);
  consider(point);
  return point;
}

void EditSearch::differentiate(EditPoint& point) const {
  if (point.row_jacobian) return;
  const Eigen::VectorXd rates = problem_.controls.valueRates(point.changes);
  Eigen::MatrixXd J = jacobianByAdjoint(problem_, point.values, point.motion, point.rows) * rates.asDiagonal();
  const std::vector<Row>& rows = problem_.constraints.rows();
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) /= rows[i].scale;
  point.row_jacobian = std::move(J);
  point.validity_jacobian = problem_.validity.jacobian(problem_.controls, point.values) * rates.asDiagonal();
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

struct System {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;
};

/// The rows to bring to zero: all constraints, and what would be invalid or is about to be.
System systemAt(const EditPoint& point) {
  std::vector<int> active;
  for (int i = 0; i < point.validity.size(); ++i) {
    if (point.validity[i] < 0) active.push_back(i);
  }
  const Eigen::Index m = point.rows.scaled.size(), n = point.changes.size();
  System system{Eigen::MatrixXd(m + static_cast<Eigen::Index>(active.size()), n), {}};
  system.r.resize(system.J.rows());
  system.J.topRows(m) = *point.row_jacobian;
  system.r.head(m) = point.rows.scaled;
  for (std::size_t k = 0; k < active.size(); ++k) {
    system.J.row(m + static_cast<Eigen::Index>(k)) = point.validity_jacobian->row(active[k]);
    system.r[m + static_cast<Eigen::Index>(k)] = point.validity[active[k]] - kActiveValidity;
  }
  // Rows of one length: the rank is judged by their directions.
  for (Eigen::Index i = 0; i < system.J.rows(); ++i) {
    const double norm = system.J.row(i).norm();
    if (norm > 0) system.J.row(i) /= norm, system.r[i] /= norm;
  }
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

Eigen::VectorXd smallestStep(const EditSearch& search, const EditPoint& point) {
  return boundedStep(systemAt(point), point.changes, search.lower(), search.upper());
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

// SPDX-License-Identifier: MIT
// The differential updates of a gesture: steps from first derivatives, each tried by simulation.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adjoint/base/errors.h"
#include "editing/problem/jacobian.hpp"
#include "editing/session/session_solver.hpp"
#include "editing/solve/dependence.hpp"

namespace carom::editing_detail {
namespace {

/// Below this violation, dimensionless, steps are taken whole even if the curvature of the constraints makes it larger
/// at first: by so many times the square of what a step does to make the change smaller.
constexpr double kNear = 1e-2;
constexpr double kCurvature = 100;
/// The change is small enough when a step would shorten it by less than this share.
constexpr double kSettled = 0.1;
/// The goal is as near as it gets when a step would bring it nearer by less than this share, to first order.
constexpr double kHopeless = 1e-3;
/// A change that a step would make shorter by no more than this is short enough.
constexpr double kNothing = 1e-8;
/// Where rounding leaves no step.
constexpr double kNoStep = 1e-15;
/// Steps are not shortened below this, and begin no shorter than that in an update.
constexpr double kShortestStep = 1e-4;
constexpr double kFirstStep = 0.25;
/// Shares of the way towards the smallest change that a step may take.
constexpr double kLeastEase = 1.0 / 16, kMostEase = 2;
/// So much work is kept for the projection onto the constraints, whatever the change.
constexpr int kProjectionSteps = 3;
/// Boundaries of impact sequences that an update follows.
constexpr std::size_t kMostKinks = 3;
/// Steps across the boundary of an impact sequence that may make things worse at first, in one update.
constexpr int kLeaps = 2;
/// An update ends after so many steps that hardly bring the goal nearer, or leave the change as large as it was.
constexpr int kStalls = 3;
constexpr double kHardly = 0.99;
/// It is worth while to go on where the goal came at least so much nearer, as a share of what was left.
constexpr double kNearer = 0.5;
/// Steps from the best point, along a boundary, and from samples; samples of which the best is followed.
constexpr int kSteps = 8, kStepsAlong = 5, kStepsElsewhere = 6, kBatch = 3;

}  // namespace

StepProblem SessionSolver::stepProblem(EditPoint& point) const {
  if (!differentiate(problem_, point)) throw NotComputable(point.not_computable);
  const Eigen::Index n = point.changes.size();
  StepProblem step;
  step.at = point.changes, step.lower = lower_, step.upper = upper_, step.costless = problem_.times();
  step.longest = longest_, step.ease = ease_;
  for (LinearRows* rows : {&step.hard, &step.within, &step.soft, &step.terms}) rows->J.resize(0, n);
  if (!problem_.soft.empty()) {
    const RowValues soft = problem_.soft.evaluate(point.motion);
    step.terms = {softJacobian(problem_, point.changes, point.motion, soft), problem_.soft.weighted(soft)};
  }
  const Eigen::MatrixXd& J = *point.row_jacobian;
  for (int i = 0; i < problem_.constraints.size(); ++i) {
    const Row& row = problem_.constraints.rows()[static_cast<std::size_t>(i)];
    if (!row.isRange()) {
      (row.constraint == goal_ ? step.soft : step.hard).add(J.row(i), point.rows.scaled[i]);
      continue;
    }
    if (row.constraint == goal_ && point.rows.scaled[i] != 0) {  // a nail's range is kept to, the goal's is come to
      step.soft.add(J.row(i), point.rows.scaled[i]);
      continue;
    }
    const double value = point.rows.values[i];
    if (std::isfinite(row.lower)) step.within.add(J.row(i), (value - row.lower) / row.scale);
    if (std::isfinite(row.upper)) step.within.add(-J.row(i), (row.upper - value) / row.scale);
  }
  for (const Kink& kink : kinks_) {
    const double side = kink.normal.dot(point.changes) - kink.offset, sign = side < 0 ? -1 : 1;
    step.within.add(sign * kink.normal.transpose(), sign * side);
  }
  for (Eigen::Index i = 0; i < point.validity.size(); ++i)
    step.within.add(point.validity_jacobian->row(i), point.validity[i] - kValidityMargin);
  return step;
}

bool SessionSolver::isSettled(const EditPoint& point, const Step& step) const {
  const double change = point.changes.head(problem_.controls.size()).norm();
  if (reached(point)) return ease_ * step.towards_zero.norm() <= kSettled * change + kNothing;
  // As near as it gets, to first order.
  const bool nails_met = nailViolation(point) <= nails_allowed_;
  return step.d.norm() <= kNoStep * (1 + point.changes.norm()) ||
         (nails_met && goal_ >= 0 && step.soft_after > (1 - kHopeless) * merit(point));
}

bool SessionSolver::leads(const EditPoint& trial, const EditPoint& from, double eased) const {
  if (options_.sequence == SequencePolicy::stay && trial.signature != start_->signature) return false;
  const double now = merit(trial);
  return now < merit(from) || now <= std::min(kNear, kCurvature * eased * eased) || reached(trial);
}

/// The curvature of the constraints makes the way towards the smallest change shorter or longer than a step thinks:
/// by how the last step changed what is left of it, the next one knows by how much (a secant along it).
void SessionSolver::learnEase(const EditPoint& at, const Step& step) {
  const double square = last_towards_.squaredNorm();
  if (last_towards_.size() == step.towards_zero.size() && square > kNothing * kNothing &&
      at.signature == last_signature_) {
    const double left = step.towards_zero.dot(last_towards_) / square;
    ease_ = left < 1 ? std::clamp(ease_ / (1 - left), kLeastEase, kMostEase) : kMostEase;
  }
  last_towards_.resize(0);
}

/// Keeps the steps from `at` on its own side of the boundary that a trial went across; false where there is none that
/// could be held.
bool SessionSolver::holdAtKink(EditPoint& at, EditPoint& trial) {
  if (kinks_.size() >= kMostKinks || trial.signature == at.signature) return false;
  if (!differentiate(problem_, trial)) return false;
  if (const std::optional<Kink> kink = kinkBetween(problem_, at, trial)) {
    kinks_.push_back(*kink);
    return true;
  }
  if (!std::exchange(holds_jumps_, false)) return false;
  const std::vector<Kink> jumps = jumpsBetween(problem_, at, trial);
  kinks_.insert(kinks_.end(), jumps.begin(), jumps.end());
  return !jumps.empty();
}

void SessionSolver::improveHere(Budget& budget) {
  keepIfBetter(start_);  // a drag that comes back finds what was there
  beyond_.reset();
  descendFromBest(budget);
  if (!reached() && beyond_) {  // leaps across the boundary led nowhere: along it
    holds_jumps_ = true;
    descend(point_, budget, kStepsAlong);
    holds_jumps_ = false;
  }
  if (options_.sequence != SequencePolicy::stay && goal_ >= 0 && problem_.unknowns() > 0) lookElsewhere(budget);
}

/// For as long as that brings it nearer.
void SessionSolver::descendFromBest(Budget& budget) {
  for (double before = std::numeric_limits<double>::infinity(); before > 0 && budget.left() > 0;) {
    descend(point_, budget, kSteps);
    const double now = merit(*point_);
    if (reached() || !(now < kNearer * before)) return;
    before = now;
  }
}

/// The step from a point, and the directions that move neither the goal nor nails; nothing where derivatives lack.
std::optional<Surroundings> SessionSolver::surroundings(EditPoint& point) const {
  const StepProblem problem = stepProblem(point);
  if (!point.row_jacobian->allFinite()) return std::nullopt;
  return Surroundings{point.changes, hierarchicalStep(problem).d, nullSpace(*point.row_jacobian)};
}

/// Where the steps from the best point end before the goal, others are tried from samples around it, and around the
/// start of the gesture. What is found is another way to the same target; impact sequences that were not tried come
/// first.
void SessionSolver::lookElsewhere(Budget& budget) {
  const double longest = longest_, ease = ease_;
  std::vector<std::string> known{point_->signature};  // where steps began in this update
  for (int round = 0; !reached() && budget.left() >= kBatch + kProjectionSteps; ++round) {
    EditPoint& centre = round % 2 ? *start_ : *point_;
    const std::optional<Surroundings> here = surroundings(centre);
    if (!here) return;
    EditPointPtr best;
    const auto isKnown = [&](const EditPoint& p) { return std::count(known.begin(), known.end(), p.signature) > 0; };
    for (const Eigen::VectorXd& y : samples(centre.changes, {*here}, lower_, upper_, samples_, kBatch)) {
      ++samples_;
      if (!budget.take()) return;
      const EditPointPtr trial = evaluate(y);
      if (!trial) continue;
      keepIfBetter(trial);
      const bool fresh = !isKnown(*trial), best_fresh = best && !isKnown(*best);
      if (!best || (fresh != best_fresh ? fresh : merit(*trial) < merit(*best))) best = trial;
    }
    if (!best) continue;
    known.push_back(best->signature);
    longest_ = kFirstStep, ease_ = 1;
    const double before = merit(*point_);
    descend(best, budget, kStepsElsewhere);
    if (!reached() && merit(*point_) < kNearer * before) descendFromBest(budget);
    longest_ = longest, ease_ = ease;
  }
}

/// Takes at most so many steps, tried or taken, from a point on.
void SessionSolver::descend(EditPointPtr at, Budget& budget, int most) {
  int stalls = 0, leaps = 0;
  bool projects = false, crosses = false;
  longest_ = std::max(longest_, kFirstStep);
  kinks_.clear();
  last_towards_.resize(0);
  while (stalls < kStalls) {
    const int left = std::min(most, budget.left());
    StepProblem problem = stepProblem(*at);
    if (!at->row_jacobian->allFinite()) return;
    projects = !reached() && (projects || left <= kProjectionSteps);
    if (projects) problem.ease = 0;
    Step step = hierarchicalStep(problem);
    if (!projects && last_towards_.size() > 0) {
      learnEase(*at, step);
      problem.ease = ease_;
      step = hierarchicalStep(problem);
    }
    if (isSettled(*at, step)) {
      if (reached() || kinks_.empty() || leaps >= kLeaps || crosses) return;
      kinks_.clear();  // the boundary is as near as this side gets: what is beyond it?
      crosses = true;
      continue;
    }
    if (most-- <= 0 || !budget.take()) return;
    const EditPointPtr trial = evaluate(at->changes + step.d);
    const double length = step.d.norm(), eased = problem.ease * step.towards_zero.norm();
    if (trial && at == point_ && trial->signature != at->signature) beyond_ = trial;
    if (trial && leads(*trial, *at, eased)) {
      ++iterations_;
      const bool both = reached(*trial) && reached(*at);
      if (both && trial->objective >= at->objective) ++stalls;
      if (!reached(*trial) && merit(*trial) > kHardly * merit(*at)) ++stalls;
      longest_ = std::max(longest_, 2 * length);
      keepIfBetter(trial);
      crosses = false;
      if (!projects) last_towards_ = step.towards_zero, last_signature_ = at->signature;
      at = trial;
    } else if (trial && !crosses && holdAtKink(*at, *trial)) {
      continue;
    } else if (eased > 0.5 * length) {
      ease_ = std::max(kLeastEase, ease_ / 2);
      projects = true;
      if (reached()) ++stalls;
    } else if (trial && leaps < kLeaps && options_.sequence != SequencePolicy::stay &&
               trial->signature != at->signature) {
      ++iterations_, ++leaps;
      kinks_.clear();
      crosses = false;
      at = trial;
    } else {
      longest_ = length / 3;
      if (longest_ < std::min(kShortestStep, kShortestStep * merit(*at))) return;
    }
  }
}

}  // namespace carom::editing_detail

#include "editing/session/session_solver.h"

#include <algorithm>
#include <cmath>

#include "adjoint/errors.h"
#include "editing/solve/edit_solution.h"

namespace carom {
namespace {

/// An impact that is held may come later than at the start: so much of its time is simulated.
constexpr double kMarginAfterLast = 1.25;
/// From this share of the duration on all of it is simulated, so that the motion to show is there already.
constexpr double kNearlyAll = 0.8;
/// Below this violation, dimensionless, steps are taken whole even if the curvature of the constraints makes it larger
/// at first: by so many times the square of what a step does to make the change smaller.
constexpr double kNear = 1e-2;
constexpr double kCurvature = 100;
/// What a nail is worth against the goal while neither is met.
constexpr double kNailWeight = 10;
/// The change is small enough when a step would shorten it by less than this share.
constexpr double kSettled = 0.1;
/// The goal is as near as it gets when a step would bring it nearer by less than this share, to first order.
constexpr double kHopeless = 1e-3;
/// A change that a step would make shorter by no more than this is short enough.
constexpr double kNothing = 1e-8;
/// Where rounding leaves no step.
constexpr double kNoStep = 1e-15;
/// Steps are not shortened below this, and begin no shorter than that in an update.
constexpr double kShortestReach = 1e-4;
constexpr double kLeastReach = 0.25;
/// Shares of the way towards the smallest change that a step may take.
constexpr double kLeastEase = 1.0 / 16, kMostEase = 2;
/// So much work is kept for coming onto the constraints, whatever the change.
constexpr int kLanding = 3;
/// Borders of impact sequences that an update follows.
constexpr std::size_t kMostKinks = 3;
/// Steps across the border of an impact sequence that may make things worse at first, in one update.
constexpr int kLeaps = 2;
/// An update ends after so many steps that hardly bring the goal nearer, or leave the change as large as it was.
constexpr int kStalls = 3;
constexpr double kHardly = 0.99;
/// Validity is kept a little away from its limit.
constexpr double kValidityMargin = 1e-7;
constexpr double kLongestWait = 1e8;  // s, that a clock can add

}  // namespace

Work::Work(int limit, double seconds, std::optional<int> cut_after)
    : limit_(cut_after ? std::min(limit, *cut_after) : limit), cut_at_limit_(cut_after.has_value()) {
  using Clock = std::chrono::steady_clock;
  if (!cut_after && seconds < kLongestWait)
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Work::take() {
  if (done_ >= limit_) {
    cut_ = cut_at_limit_;
    return false;
  }
  if (deadline_ && std::chrono::steady_clock::now() >= *deadline_) {
    cut_ = true;
    return false;
  }
  ++done_;
  return true;
}

SessionSolver::SessionSolver(const Scene& reference, ContactSource& contacts, double duration,
                             const std::vector<Control>& controls, const std::vector<Constraint>& constraints, int goal,
                             const Eigen::VectorXd& changes, const SessionOptions& options)
    : options_(options),
      problem_(reference, contacts, duration, controls, constraints),
      goal_(goal),
      lower_(problem_.lower()),
      upper_(problem_.upper()),
      until_(problem_.horizon) {
  // Motions are shown as well: whoever turns is to be seen turning.
  for (Asked& asked : problem_.asked) asked.orientation = true;
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(problem_.unknowns());
  if (changes.size() > 0) unknowns.head(problem_.controls.size()) = changes;
  start_ = point_ = pointAt(problem_, unknowns, until_, true);
  if (!point_->rows.available)
    throw InputError("found a constraint that the motion lacks, expected one that it has: " + point_->rows.message);
  until_ = std::min(until_, kMarginAfterLast * problem_.constraints.extentIn(point_->motion).time);
  if (until_ > kNearlyAll * duration) until_ = duration;
  nails_allowed_ = std::max(options_.tolerance, nailViolation(*point_));
}

EditPointPtr SessionSolver::evaluate(const Eigen::VectorXd& changes) const {
  if (!changes.allFinite()) return nullptr;
  try {
    EditPointPtr point = pointAt(problem_, changes, until_, false);
    if (!point->rows.available && until_ < problem_.horizon)
      point = pointAt(problem_, changes, problem_.horizon, false);
    return point->rows.available && point->rows.scaled.allFinite() ? point : nullptr;
  } catch (const InputError&) {
    return nullptr;  // this trial makes no sense (bodies overlap, moments are impossible): others may
  }
}

void SessionSolver::aim(int target, const std::vector<double>& value) {
  problem_.constraints.setTarget(goal_, target, value);
  // Errors are other ones; derivatives of places are the same, those of a turn depend on where it is to end.
  const bool turns = problem_.constraints.constraints()[static_cast<std::size_t>(goal_)]
                         .targets[static_cast<std::size_t>(target)]
                         .quantity == "orientation";
  for (const EditPointPtr& point : {start_, point_}) {
    readRows(problem_, *point);
    if (turns) point->row_jacobian.reset();
  }
}

double SessionSolver::goalError(const RowValues& rows) const {
  double error = 0;
  for (int i = 0; i < problem_.constraints.size(); ++i)
    if (problem_.constraints.rows()[static_cast<std::size_t>(i)].constraint == goal_)
      error = std::max(error, std::abs(rows.scaled[i]));
  return error;
}

double SessionSolver::nailError(const RowValues& rows) const {
  double error = 0;
  for (int i = 0; i < problem_.constraints.size(); ++i)
    if (problem_.constraints.rows()[static_cast<std::size_t>(i)].constraint != goal_)
      error = std::max(error, std::abs(rows.scaled[i]));
  return error;
}

double SessionSolver::nailViolation(const EditPoint& point) const {
  const double invalid = point.validity.size() > 0 ? std::max(0.0, -point.validity.minCoeff()) : 0;
  return std::max(invalid, nailError(point.rows));
}

double SessionSolver::merit(const EditPoint& point) const {
  double squares = 0;
  for (int i = 0; i < problem_.constraints.size(); ++i)
    if (problem_.constraints.rows()[static_cast<std::size_t>(i)].constraint == goal_)
      squares += point.rows.scaled[i] * point.rows.scaled[i];
  return kNailWeight * nailViolation(point) + std::sqrt(squares);
}

/// Nails first, then the goal, then the change.
bool SessionSolver::isBetter(const EditPoint& point) const {
  if (reached(point) && reached()) return point.objective < point_->objective;
  const double nails = std::max(nails_allowed_, nailViolation(point));
  const double nails_so_far = std::max(nails_allowed_, nailViolation(*point_));
  if (nails != nails_so_far) return nails < nails_so_far;
  return goal_ < 0 ? nailViolation(point) < nailViolation(*point_) : merit(point) < merit(*point_);
}

void SessionSolver::keepIfBetter(const EditPointPtr& point) {
  if (!isBetter(*point)) return;
  point_ = point;
  nails_allowed_ = std::clamp(nailViolation(*point), options_.tolerance, nails_allowed_);
}

StepProblem SessionSolver::stepProblem(EditPoint& point) const {
  differentiate(problem_, point);
  const Eigen::Index n = point.changes.size();
  StepProblem step;
  step.at = point.changes, step.lower = lower_, step.upper = upper_, step.costless = problem_.times();
  step.reach = reach_, step.ease = ease_;
  for (LinearRows* rows : {&step.hard, &step.within, &step.soft}) rows->J.resize(0, n);
  const Eigen::MatrixXd& J = *point.row_jacobian;
  for (int i = 0; i < problem_.constraints.size(); ++i) {
    const Row& row = problem_.constraints.rows()[static_cast<std::size_t>(i)];
    if (!row.isRange()) {
      (row.constraint == goal_ ? step.soft : step.hard).add(J.row(i), point.rows.scaled[i]);
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

/// Keeps the steps from `at` on its own side of the border that a trial went across; false where there is none that
/// could be held.
bool SessionSolver::holdAtKink(EditPoint& at, EditPoint& trial) {
  if (kinks_.size() >= kMostKinks || trial.signature == at.signature) return false;
  differentiate(problem_, trial);
  const std::optional<Kink> kink = kinkBetween(problem_, at, trial);
  if (kink) kinks_.push_back(*kink);
  return kink.has_value();
}

void SessionSolver::improve(Work& work) {
  keepIfBetter(start_);  // a drag that comes back finds what was there
  EditPointPtr at = point_;
  int stalls = 0, leaps = 0;
  bool lands = false, crosses = false;
  reach_ = std::max(reach_, kLeastReach);
  kinks_.clear();
  last_towards_.resize(0);
  while (stalls < kStalls) {
    StepProblem problem = stepProblem(*at);
    if (!at->row_jacobian->allFinite()) return;
    lands = !reached() && (lands || work.left() <= kLanding);
    if (lands) problem.ease = 0;
    Step step = hierarchicalStep(problem);
    if (!lands && last_towards_.size() > 0) {
      learnEase(*at, step);
      problem.ease = ease_;
      step = hierarchicalStep(problem);
    }
    if (isSettled(*at, step)) {
      if (reached() || kinks_.empty() || leaps >= kLeaps || crosses) return;
      kinks_.clear();  // the border is as near as this side gets: what is beyond it?
      crosses = true;
      continue;
    }
    if (!work.take()) return;
    const EditPointPtr trial = evaluate(at->changes + step.d);
    const double length = step.d.norm(), eased = problem.ease * step.towards_zero.norm();
    if (trial && leads(*trial, *at, eased)) {
      ++iterations_;
      const bool both = reached(*trial) && reached(*at);
      if (both && trial->objective >= at->objective) ++stalls;
      if (!reached(*trial) && merit(*trial) > kHardly * merit(*at)) ++stalls;
      reach_ = std::max(reach_, 2 * length);
      keepIfBetter(trial);
      crosses = false;
      if (!lands) last_towards_ = step.towards_zero, last_signature_ = at->signature;
      at = trial;
    } else if (trial && !crosses && holdAtKink(*at, *trial)) {
      continue;
    } else if (eased > 0.5 * length) {
      ease_ = std::max(kLeastEase, ease_ / 2);
      lands = true;
      if (reached()) ++stalls;
    } else if (trial && leaps < kLeaps && options_.sequence != SequencePolicy::stay &&
               trial->signature != at->signature) {
      ++iterations_, ++leaps;
      kinks_.clear();
      crosses = false;
      at = trial;
    } else {
      reach_ = length / 3;
      if (reach_ < std::min(kShortestReach, kShortestReach * merit(*at))) return;
    }
  }
}

void SessionSolver::finish(Work& work) {
  EditOptions options;
  options.max_iterations = options_.release_iterations;
  options.tolerance = options_.tolerance;
  options.sequence = options_.sequence;
  options.progress = [&](const EditProgress&) { return work.take(); };
  EditSearch search(problem_, options);
  EditPointPtr found;
  if (!reached()) {
    found = findSolution(search).point;
  } else if (const EditPointPtr from = search.evaluate(point_->changes)) {
    found = minimiseWithin(search, from, search.iterationsLeft());
  }
  iterations_ += search.iterations();
  if (!found || !found->rows.available || !reached(*found)) return;
  if (options_.sequence == SequencePolicy::stay && found->signature != start_->signature) return;
  if (const EditPointPtr again = evaluate(found->changes)) keepIfBetter(again);
}

}  // namespace carom

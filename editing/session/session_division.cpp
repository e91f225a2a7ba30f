// SPDX-License-Identifier: MIT
// A gesture on part of the scene: the bodies that can matter, with what came of it verified by a simulation of all.
#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/session/session_solver.hpp"

namespace carom::editing_detail {
namespace {

/// With more than this share of the moving bodies there is little to gain.
constexpr double kMostShare = 0.5;
/// Work is counted in simulations of so many moving bodies, or of all where there are fewer.
constexpr double kCounted = 5;
/// Bodies that do not matter any more leave the part after so many updates since the last one came in.
constexpr int kUpdatesToShrink = 10;

/// An update makes so many simulations at least, however long they take.
constexpr double kFewSimulations = 3;

bool contains(const std::vector<bool>& all, const std::vector<bool>& some) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (some[i] && !all[i]) return false;
  return true;
}

}  // namespace

/// Works with these bodies from here on, or with all where that makes no difference.
void SessionSolver::divide(const std::vector<bool>& moving) {
  part_.reset();
  division_ = scenePart(problem_, moving);
  stays_whole_ = true;
  if (division_.moving > kMostShare * division_.all_moving) return;
  try {
    // whose numbers the unknowns are is known by a problem of the part; the start is where the gesture began
    const EditProblem problem(division_.scene, *problem_.contacts, problem_.duration, division_.controls,
                              problem_.constraints.constraints());
    if (!matchUnknowns(problem_, problem, division_)) return;
    part_ = std::make_unique<SessionSolver>(
        division_.scene, *problem_.contacts, problem_.duration, division_.controls, problem_.constraints.constraints(),
        goal_, division_.restrict(start_->changes).head(problem.controls.size()), options_, true);
  } catch (const InputError&) {
    return;  // without the others it makes no sense
  }
  stays_whole_ = false;
  if (point_ != start_) part_->startAt(division_.restrict(point_->changes));
  until_ = problem_.duration;  // what is verified is shown
}

void SessionSolver::startAt(const Eigen::VectorXd& changes) {
  if (point_->changes == changes) return;
  const EditPointPtr point = changes == start_->changes ? start_ : evaluate(changes);
  if (point) point_ = point;
}

/// Verifies where the part came to. True when the part had to grow, so that there is more to do.
bool SessionSolver::takeOverPart(Budget& budget) {
  const EditPointPtr found = part_->point();
  Eigen::VectorXd changes = point_->changes;
  division_.extend(found->changes, changes);
  if (changes == point_->changes) return false;
  EditPointPtr trial = start_;
  if (changes != start_->changes) {
    budget.count(1);
    trial = evaluateToShow(changes);
    if (trial && known_) known_ = {trial, &trial->motion};
  }
  if (!trial) {  // with all bodies it makes no sense
    stays_whole_ = true;
    since_growth_ = 0;
    part_.reset();
    return true;
  }
  keepIfBetter(trial);
  if (trial->rows.scaled.size() == 0) return false;
  if ((trial->rows.scaled - found->rows.scaled).cwiseAbs().maxCoeff() <= options_.tolerance) return false;
  std::vector<bool> counts = bodiesThatCount(problem_, *trial);
  if (!contains(division_.bodies, counts)) {
    for (std::size_t b = 0; b < counts.size(); ++b)
      counts[b] = counts[b] || (division_.bodies[b] && !problem_.controls.writtenScene().bodies[b].fixed);
    divide(counts);
    since_growth_ = 0;
    return true;
  }
  part_->startAt(division_.restrict(point_->changes));
  return false;
}

/// Bodies that came in on the way and have left it cost work for nothing.
void SessionSolver::shrinkPart() {
  if (++since_growth_ < kUpdatesToShrink) return;
  since_growth_ = 0;
  const std::vector<bool> counts = bodiesThatCount(problem_, *point_);
  if (stays_whole_ || std::count(counts.begin(), counts.end(), true) < division_.moving) divide(counts);
}

/// What one motion of all bodies counts.
double SessionSolver::priceOfAll() const {
  const double bodies = std::max(1.0, division_.all_moving / kCounted);
  if (!sparing_) return bodies;
  const double limit = options_.drag_simulations, steps = static_cast<double>(start_->motion.steps);
  return std::max(bodies, std::min(limit * steps / options_.drag_steps, limit / kFewSimulations));
}

void SessionSolver::improve(Budget& budget, const std::function<void()>& better, bool sparing) {
  better_ = better;
  sparing_ = sparing;
  improveDivided(budget);
  better_ = {};
}

void SessionSolver::improveDivided(Budget& budget) {
  if (is_part_) return improveHere(budget);
  if (division_.bodies.empty()) divide(bodiesThatCount(problem_, *start_));
  shrinkPart();
  const double whole = priceOfAll();
  if (part_) keepIfBetter(start_);
  for (bool goes_on = true; part_ && goes_on;) {
    const int before = part_->iterations();
    budget.setPrice(whole * division_.moving / division_.all_moving, whole);
    part_->improve(budget);
    budget.setPrice(whole, 0);
    iterations_ += part_->iterations() - before;
    goes_on = takeOverPart(budget) && budget.left() > 1;
  }
  budget.setPrice(whole, 0);
  if (!part_) improveHere(budget);
}

/// What stays is a motion that owes nothing to those that were seen on the way: the same scene gives the same bits.
void SessionSolver::simulateAnew() {
  known_.reset();
  if (point_->motion.taken_over == 0) return;
  if (const EditPointPtr anew = evaluateToShow(point_->changes)) point_ = anew;
}

void SessionSolver::finish(Budget& budget) {
  better_ = {};
  simulateAnew();
  if (!part_) return finishHere(budget);
  const int before = part_->iterations();
  part_->finish(budget);
  iterations_ += part_->iterations() - before;
  const bool agrees = !takeOverPart(budget) && part_->reached() == reached();
  if (!agrees) finishHere(budget);
}

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#include "editing/strategy/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/solve/minimise.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/boundary_minimum.hpp"
#include "editing/strategy/local_solve.hpp"
#include "editing/strategy/local_solve_score.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// Of each group so many points, the nearest to the constraints, are looked at more closely.
constexpr std::size_t kOfEachGroup = 2;
/// So many of them for each local solve, at most.
constexpr std::size_t kForEachLocalSolve = 4;
constexpr int kMinimisingIterations = 40, kPolishingIterations = 15, kBoundarySteps = 20;
/// The way along the constraints that is left where a change is as small as it gets, as a share of it.
constexpr double kStationary = 1e-9, kNearlyStationary = 1e-8;
/// Of the objective: half a natural scale; and the part of the local solves that is done for less than that.
constexpr double kSmallChange = 0.1;
constexpr std::size_t kPart = 6;
/// Of the objective near its least, as a share of it: what is stationary may seem the larger by this.
constexpr double kRounding = 1e-12;
/// So many impacts leave few other ways.
constexpr int kFewImpacts = 3;
/// Steps of a motion from which on a local solve takes so long that few can be made.
constexpr std::size_t kManySteps = 2000;
/// While there is no solution, a step that is so much longer makes up for a change that is smaller by one.
constexpr double kStepsAreUncertain = 0.4;
/// Local solves of a higher score are not made, where rounds do a part of the work and elsewhere: fewer than three, and fewer
/// than one, of a thousand bring a smaller change.
constexpr double kScoreInPart = 2, kScore = 8;
/// Of the most promising points of a round the next one may look beyond the boundaries.
constexpr std::size_t kRemembered = 6;
/// A step that leaves more of the residuals than this, as the rows are linear, leads nowhere.
constexpr double kLeadsNowhere = 0.5;
/// Once there is a solution only points from which the change is expected to be smaller than this share of it count.
constexpr double kClearlySmaller = 0.995;
/// From a sequence that was tried so often, no more than so many local solves a round go where a solution is known.
constexpr int kTriedOften = 4, kOfTriedOften = 4;
/// So many local solves at a time.
constexpr std::size_t kLocalSolvesAhead = 4;
/// The beginnings of the samples of two seeds are so many of them apart: a prime.
constexpr int kBetweenSeeds = 1'000'003;
/// Solutions of one sequence whose changes differ by less than this share of them are the same.
constexpr double kSameChange = 0.1;

}  // namespace

bool areDistinct(const EditPoint& a, const EditPoint& b) {
  if (a.signature != b.signature) return true;
  return (a.changes - b.changes).norm() > kSameChange * std::max(a.changes.norm(), b.changes.norm());
}

SequenceSearch::SequenceSearch(EditEvaluator& evaluator, EditPointPtr start)
    : evaluator_(evaluator),
      plan_(planOf(evaluator.options().effort)),
      pool_(*evaluator.problem().contacts),
      threads_(pool_.isShareable() ? evaluator.options().threads : 1),
      start_(std::move(start)),
      samples_(evaluator.options().seed * kBetweenSeeds) {}

bool SequenceSearch::round(Seek seek) {
  if (evaluator_.problem().unknowns() == 0) return false;  // nowhere to go
  if (!evaluator_.goesOn()) return false;
  std::vector<EditPointPtr> points = sample(seek);
  if (!reportBatch()) return false;
  const double to_beat = lengthToBeat(seek);
  const std::vector<EditPointPtr> candidates = startsFrom(promising(points, to_beat), to_beat);
  letGo(std::move(points));
  const std::vector<EditPointPtr> solved = solveAllLocally(candidates, seek);
  if (!reportBatch()) return false;
  minimise(solved, seek);
  ++round_;
  rounds_without_ = solutions_.empty() ? rounds_without_ + 1 : 0;
  if (solutions_.empty()) evaluator_.allowLongerMotions();
  return true;
}

bool SequenceSearch::hasSmallChangeInside() const {
  return isBestInside() && solutions_.front()->objective < kSmallChange && impactsOfBest() <= kFewImpacts;
}

bool SequenceSearch::isLong() const { return start_->motion.steps > kManySteps; }

bool SequenceSearch::isInPart() const { return hasSmallChangeInside() || isLong(); }

bool SequenceSearch::takesLong() const { return evaluator_.work() > plan_.stopping.usual; }

std::size_t SequenceSearch::localSolves() const {
  return isInPart() ? (plan_.local_solves + kPart - 1) / kPart : plan_.local_solves;
}

std::size_t SequenceSearch::wanted() const {
  return static_cast<std::size_t>(std::max(1, evaluator_.options().alternatives));
}

// Of as many solutions as are wanted the largest.
double SequenceSearch::lengthToBeat(Seek seek) const {
  if (seek == Seek::others || solutions_.size() < wanted()) return std::numeric_limits<double>::infinity();
  return kClearlySmaller * lengthOf(evaluator_.problem(), solutions_[wanted() - 1]->changes);
}

// With a solution in the sequence of the start, others count only where they are allowed to.
bool SequenceSearch::isAllowed(const EditPoint& point) const {
  if (evaluator_.options().sequence == SequencePolicy::smallest || solutions_.empty()) return true;
  const bool inside = std::any_of(solutions_.begin(), solutions_.end(),
                                  [&](const EditPointPtr& s) { return s->signature == start_->signature; });
  return !inside || point.signature == start_->signature;
}

bool SequenceSearch::reportBatch() {
  const EditPointPtr best = evaluator_.best();
  return evaluator_.step(best->objective, best->violation);
}

// Where memory was taken by several threads, one alone is slow to give it back.
void SequenceSearch::letGo(std::vector<EditPointPtr> points) {
  threads_.forAll(points.size(), [&](std::size_t i) { points[i].reset(); });
}

// A few of each impact sequence, all in all no more than can be looked at.
std::vector<EditPointPtr> SequenceSearch::nearestOfEachGroup(const std::vector<EditPointPtr>& points) const {
  const auto nearer = [](const EditPointPtr& a, const EditPointPtr& b) { return a->violation < b->violation; };
  std::map<std::string, std::vector<EditPointPtr>> groups;
  for (const EditPointPtr& point : points)
    if (isAllowed(*point)) groups[point->signature].push_back(point);
  const std::size_t each = std::max(kOfEachGroup, localSolves() / std::max<std::size_t>(1, groups.size()));
  std::vector<EditPointPtr> nearest;
  for (auto& [signature, group] : groups) {
    std::stable_sort(group.begin(), group.end(), nearer);
    group.resize(std::min(group.size(), each));
    nearest.insert(nearest.end(), group.begin(), group.end());
  }
  std::stable_sort(nearest.begin(), nearest.end(), nearer);
  nearest.resize(std::min(nearest.size(), kForEachLocalSolve * localSolves()));
  return nearest;
}

// Once there is a solution, those that are likeliest to lead to a smaller change, as far as they are worth a local solve; until
// then those from which the linearised rows lead to the smallest change by the shortest step. Sequences that were tried
// often come last.
std::vector<SequenceSearch::Candidate> SequenceSearch::promising(const std::vector<EditPointPtr>& points, double to_beat) {
  std::vector<Candidate> ranked;
  for (const EditPointPtr& point : nearestOfEachGroup(points)) ranked.push_back({0, {}, point});
  const bool improving = std::isfinite(to_beat);
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    auto& [score, estimate, point] = ranked[i];
    if (!evaluator_.differentiate(*point)) {
      score = std::numeric_limits<double>::infinity();
      return;
    }
    const Eigen::VectorXd step = smallestStep(evaluator_, *point);
    const double left = residualsAfter(evaluator_, *point, step).norm();
    const bool leads_nowhere = !evaluator_.reached(*point) && !(left < kLeadsNowhere * point->rows.scaled.norm());
    estimate = estimateOf(evaluator_, *point, step);
    score = improving ? localSolveScore(estimate, to_beat) : estimate.change + kStepsAreUncertain * estimate.step;
    if (leads_nowhere || !std::isfinite(score) || estimate.change > to_beat + estimate.step)  // a local solve would give up
      score = std::numeric_limits<double>::infinity();
  });
  for (const auto& [score, estimate, point] : ranked) noteInfluence(*point);
  std::erase_if(ranked, [](const auto& entry) { return std::isinf(entry.score); });
  for (auto& [score, estimate, point] : ranked) score *= 1 + tries_[point->signature];
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
  return ranked;
}

// As many as can be made, none from a point where one began that had no less to beat: it would end as that did.
std::vector<EditPointPtr> SequenceSearch::startsFrom(const std::vector<Candidate>& ranked, double to_beat) {
  promising_.clear();
  for (const auto& [score, estimate, point] : ranked)
    if (promising_.size() < kRemembered && !lacksImpacts(evaluator_.problem(), *point)) promising_.push_back(point);
  const bool improving = std::isfinite(to_beat);
  const double worst = isInPart() ? kScoreInPart : kScore;
  std::vector<EditPointPtr> chosen;
  std::map<std::string, int> of_sequence;
  for (const auto& [score, estimate, point] : ranked) {
    if (chosen.size() == localSolves() || (improving && score > worst)) break;
    const bool tried_often = improving && tries_[point->signature] >= kTriedOften;
    if (tried_often && of_sequence[point->signature] >= kOfTriedOften) continue;
    const RoundedPoint rounded(point->changes.head(evaluator_.problem().controls.size()));
    double& had_to_beat = begun_.try_emplace(rounded, -1).first->second;
    if (had_to_beat >= to_beat) continue;
    had_to_beat = to_beat;
    ++tries_[point->signature], ++of_sequence[point->signature];
    if (improving) expected_.add(estimate, to_beat);
    chosen.push_back(point);
  }
  return chosen;
}

// What local solves find is what later ones have to beat. Where an edit takes long, those that miss are made in other ways, too.
std::vector<EditPointPtr> SequenceSearch::solveAllLocally(const std::vector<EditPointPtr>& candidates, Seek seek) {
  const std::size_t n = candidates.size();
  const LocalSolveOptions first{.below = lengthToBeat(seek)};
  std::vector<EditPointPtr> ends(n);
  std::vector<int> steps(n, 0);
  const auto way = takesLong() ? solveWithFallbacks : solveLocally;
  const auto learn = [&](LocalSolveOptions options, const EditPointPtr& end) {
    if (seek == Seek::others || wanted() > 1 || !end || !isAllowed(*end) || !evaluator_.reached(*end)) return options;
    options.below = std::min(options.below, kClearlySmaller * lengthOf(evaluator_.problem(), end->changes));
    return options;
  };
  threads_.inOrder(n, kLocalSolvesAhead, [&](std::size_t i) {
    // of those that are sure to be done, whoever else may be: the same on any number of threads
    LocalSolveOptions options = first;
    for (std::size_t k = 0; k + kLocalSolvesAhead <= i; ++k) {
      options = learn(options, ends[k]);
      if (plan_.first_ends && seek != Seek::others && ends[k] && isAllowed(*ends[k]) && evaluator_.reached(*ends[k])) return;
    }
    const ContactPool::Loan loan(pool_);
    EditEvaluator branch = evaluator_.branch({{&loan.source()}}, true);
    ends[i] = way(branch, candidates[i], options);
    steps[i] = branch.iterations() - evaluator_.iterations();
  });
  for (const EditPointPtr& end : ends)
    if (end && isAllowed(*end)) evaluator_.consider(end);
  if (n > 0) evaluator_.count(*std::max_element(steps.begin(), steps.end()));
  std::erase(ends, nullptr);
  return ends;
}

// Of each sequence the smallest change that arrived, the smallest of all first.
void SequenceSearch::minimise(const std::vector<EditPointPtr>& solved, Seek seek) {
  std::map<std::string, EditPointPtr> smallest;
  for (const EditPointPtr& point : solved) {
    if (!evaluator_.reached(*point) || !isAllowed(*point)) continue;
    EditPointPtr& slot = smallest[point->signature];
    if (!slot || point->objective < slot->objective) slot = point;
  }
  std::vector<EditPointPtr> arrived;
  for (const auto& [signature, point] : smallest) arrived.push_back(point);
  std::stable_sort(arrived.begin(), arrived.end(),
                   [](const EditPointPtr& a, const EditPointPtr& b) { return a->objective < b->objective; });
  arrived.resize(std::min(arrived.size(), plan_.minimised));
  for (const EditPointPtr& point : arrived) {
    // the smallest changes of all the others are looked at only when someone asks for them
    const bool worth = !(plan_.first_ends && seek != Seek::others) &&
                       (seek == Seek::others || solutions_.empty() ||
                        point->objective < kClearlySmaller * solutions_.front()->objective);
    if (!worth || evaluator_.halt() != Halt::none) {
      add(point);
      continue;
    }
    add(smallerWithin(point));
  }
}

// To the end of the way that local solves go, or else, with an objective of one's own, that of the solver.
EditPointPtr SequenceSearch::smallerWithin(const EditPointPtr& point) {
  const bool own = evaluator_.problem().constraints.objective() != nullptr;
  const EditPointPtr end = own ? minimiseWithin(evaluator_, point, kMinimisingIterations)
                               : solveLocally(evaluator_, point, {.signature = &point->signature});
  return evaluator_.reached(*end) && end->objective < point->objective ? end : point;
}

std::vector<EditPointPtr> SequenceSearch::smallestSolutions(std::size_t count) const {
  return {solutions_.begin(), solutions_.begin() + static_cast<std::ptrdiff_t>(std::min(count, solutions_.size()))};
}

void SequenceSearch::polish(std::size_t count) {
  for (const EditPointPtr& solution : smallestSolutions(count)) polish(solution);
}

void SequenceSearch::polishSmallest() {
  for (const EditPointPtr& solution : smallestSolutions(plan_.minimised)) {
    const bool may_be = solution == solutions_.front() ||
                        (evaluator_.differentiate(*solution) && lengthOf(evaluator_.problem(), smallestChange(evaluator_, *solution)) <
                                                                 lengthOf(evaluator_.problem(), solutions_.front()->changes));
    if (may_be) polish(solution);
  }
}

void SequenceSearch::polish(const EditPointPtr& solution) {
  if (evaluator_.problem().constraints.objective() || evaluator_.halt() != Halt::none) return;
  const LocalSolveOptions options{.signature = &solution->signature, .arrived = kStationary};
  EditPointPtr end = solveLocally(evaluator_, solution, options);
  const bool stationary = evaluator_.differentiate(*end) && (smallestChange(evaluator_, *end) - end->changes).norm() <=
                                                             kNearlyStationary * end->changes.norm();
  if (!stationary) {
    const EditPointPtr solved = end;
    end = minimiseAlongBoundary(evaluator_, solved, kBoundarySteps);  // does nothing where the minimum is on none
    if (end->signature != solution->signature)  // beyond the boundary it may lie on none
      end = solveLocally(evaluator_, end, {.signature = &end->signature, .arrived = kStationary});
    if (end == solved) end = minimiseWithin(evaluator_, end, kPolishingIterations);
  }
  if (end == solution || !evaluator_.reached(*end) || !(end->objective <= (1 + kRounding) * solution->objective)) return;
  drop(solution);
  add(end);
}

bool SequenceSearch::isBestInside() const {
  return !solutions_.empty() && solutions_.front()->signature == start_->signature;
}

int SequenceSearch::impactsOfBest() const {
  if (solutions_.empty()) return 0;
  const EditPoint& best = *solutions_.front();
  return static_cast<int>(evaluator_.problem().constraints.extentIn(best.motion, best.rows.times).events);
}

void SequenceSearch::drop(const EditPointPtr& solution) { std::erase(solutions_, solution); }

void SequenceSearch::add(const EditPointPtr& solution) {
  const auto known = std::find_if(solutions_.begin(), solutions_.end(),
                                  [&](const EditPointPtr& other) { return !areDistinct(*other, *solution); });
  if (known == solutions_.end()) {
    solutions_.push_back(solution);
  } else if (solution->objective < (*known)->objective) {
    *known = solution;
  }
  std::stable_sort(solutions_.begin(), solutions_.end(),
                   [](const EditPointPtr& a, const EditPointPtr& b) { return a->objective < b->objective; });
}

}  // namespace carom::editing_detail

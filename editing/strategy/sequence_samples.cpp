// SPDX-License-Identifier: MIT
// The points of a round of SequenceSearch.
#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/solve/dependence.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/approach.hpp"
#include "editing/strategy/local_solve.hpp"
#include "editing/strategy/missing_impacts.hpp"
#include "editing/strategy/neighbours.hpp"
#include "editing/strategy/samples.hpp"
#include "editing/strategy/sequence_search.hpp"

namespace carom::editing_detail {
namespace {

/// Of points that lack impacts so many for each local solve, at most, are looked at.
constexpr std::size_t kLackingForEach = 4;
constexpr int kApproachSteps = 8;
/// Of the bodies of a motion that nearly meet so many pairs are made to; none where hardly another way changes less.
constexpr std::size_t kNearMisses = 12;
/// Points beyond whose boundaries one round looks.
constexpr std::size_t kCrossedInRound = 4;
/// A solution from which the change could still fall by this share, if it were not for the boundary of its sequence.
constexpr double kAtBoundary = 0.05;
/// Samples double from one round without a solution to the next, so often.
constexpr int kDoublings = 6;
/// What a sample takes beside its motion, in steps of simulations.
constexpr double kStepsOfSample = 10;
/// Where hardly another way changes less, one sample of so many is done.
constexpr int kPartOfSamples = 6;
/// Smaller derivatives, as shares of the largest, are rounding.
constexpr double kInfluence = 1e-10;
/// The reach of samples, natural scales, unless a smaller change is known.
constexpr double kReach = 3;

/// Where nothing is known of the rows: everything around it.
Surroundings anywhereAround(const EditPoint& point) {
  const Eigen::Index n = point.changes.size();
  return {point.changes, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Identity(n, n)};
}

// Around a point that meets the constraints the step is one towards a smaller change: along the free directions, which
// matters at the boundary of a sequence, or else back to the start.
Surroundings surroundingsOf(const EditEvaluator& evaluator, EditPoint& point) {
  if (!evaluator.differentiate(point)) return anywhereAround(point);
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  if (!evaluator.reached(point)) return {point.changes, smallestStep(evaluator, point), free};
  const Eigen::VectorXd smaller = -free * (free.transpose() * point.changes);
  const bool at_boundary = smaller.norm() > kAtBoundary * point.changes.norm();
  return {point.changes, at_boundary ? smaller : Eigen::VectorXd(-0.5 * point.changes), free};
}

}  // namespace

// The cheaper a motion is, the more of them.
int SequenceSearch::sampleCount() const {
  const double steps = kStepsOfSample + static_cast<double>(start_->motion.steps);
  if (!solutions_.empty()) {
    const int part = hasSmallChangeInside() ? kPartOfSamples : 1;
    const double wanted = plan_.improving_steps * (takesLong() ? plan_.unusual_multiple : 1);
    return std::clamp(static_cast<int>(wanted / steps), plan_.least_samples, plan_.most_samples) / part;
  }
  const double doubled = std::ldexp(plan_.first_steps / steps, std::min(rounds_without_, kDoublings));
  const double least = std::ldexp(plan_.least_samples, std::min(rounds_without_, kDoublings));
  return static_cast<int>(std::clamp(doubled, std::min<double>(least, plan_.most_samples), 1.0 * plan_.most_samples));
}

// What changes less than the best lies nearer to the start. While there is none, every other round reaches further.
SampleReach SequenceSearch::reach() const {
  if (solutions_.empty()) return {std::ldexp(kReach, rounds_without_ / 2)};
  const double known = lengthOf(evaluator_.problem(), solutions_.front()->changes);
  return known < kReach ? SampleReach{known, true} : SampleReach{kReach};
}

// Within bounds many samples, and points beyond boundaries, come to lie where others were.
void SequenceSearch::eraseKnown(std::vector<Eigen::VectorXd>& places) {
  const Eigen::Index n = evaluator_.problem().controls.size();
  std::erase_if(places, [&](const Eigen::VectorXd& place) { return !known_.insert(RoundedPoint(place.head(n))).second; });
}

void SequenceSearch::noteInfluence(const EditPoint& point) {
  if (!point.row_jacobian || point.row_jacobian->size() == 0) return;
  const Eigen::Index n = evaluator_.problem().controls.size();
  has_influence_.resize(static_cast<std::size_t>(n), 0);
  const double largest = point.row_jacobian->cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < n; ++j)
    if (point.row_jacobian->col(j).cwiseAbs().maxCoeff() > kInfluence * largest) has_influence_[static_cast<std::size_t>(j)] = 1;
}

std::vector<EditPointPtr> SequenceSearch::sample(Seek seek) {
  std::vector<Surroundings> around;
  if (start_->rows.available) around.push_back(surroundingsOf(evaluator_, *start_));
  if (nearest_lacking_ && solutions_.empty()) around.push_back(anywhereAround(*nearest_lacking_));
  if (evaluator_.best() != start_) around.push_back(surroundingsOf(evaluator_, *evaluator_.best()));
  const int count = sampleCount();
  std::vector<Eigen::VectorXd> places =
      samples(start_->changes, around, evaluator_.lower(), evaluator_.upper(), samples_, count, reach());
  keepInMost(places, start_->changes, has_influence_);
  eraseKnown(places);
  samples_ += count;
  std::vector<EditPointPtr> made(places.size());
  std::vector<char> is_lacking(places.size(), 0);
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    made[i] = evaluator_.make(places[i], true, {{&contacts}, nullptr, true});
    is_lacking[i] = made[i] && lacksImpacts(evaluator_.problem(), *made[i]);
  });
  std::vector<EditPointPtr> points, lacking;
  for (std::size_t i = 0; i < made.size(); ++i)
    if (made[i]) (is_lacking[i] ? lacking : points).push_back(std::move(made[i]));
  const double to_beat = lengthToBeat(seek);
  std::erase_if(lacking, [&](const EditPointPtr& p) { return lengthOf(evaluator_.problem(), p->changes) > to_beat; });
  if (round_ == 0 && lacksImpacts(evaluator_.problem(), *start_)) lacking.push_back(start_);
  for (const EditPointPtr& point : approachAll(lacking)) points.push_back(point);
  letGo(std::move(lacking));
  if (round_ == 0 && start_->rows.available) points.insert(points.begin(), start_);
  if (evaluator_.best() != start_) points.insert(points.begin(), evaluator_.best());
  for (const EditPointPtr& point : neighbours(seek)) points.push_back(point);
  for (const EditPointPtr& point : crossings(points)) points.push_back(point);
  for (const EditPointPtr& point : points) evaluator_.consider(point);
  return points;
}

// Beyond the boundaries of the sequences of the start, of the smallest solutions and of what was most promising in the last
// round, of each of them once.
std::vector<EditPointPtr> SequenceSearch::neighbours(Seek seek) {
  std::vector<EditPointPtr> around;
  const auto take = [&](const EditPointPtr& point) {
    if (around.size() >= kCrossedInRound || std::find(crossed_.begin(), crossed_.end(), point) != crossed_.end()) return;
    around.push_back(point), crossed_.push_back(point);
  };
  if (start_->rows.available && !lacksImpacts(evaluator_.problem(), *start_)) take(start_);
  for (const EditPointPtr& solution : solutions_) take(solution);
  for (const EditPointPtr& point : promising_) take(point);
  const std::size_t misses = hasSmallChangeInside() ? 0 : kNearMisses;
  std::vector<std::vector<Eigen::VectorXd>> beyond(around.size());
  forAll(around.size(), [&](std::size_t i, ContactSource&) {
    if (evaluator_.differentiate(*around[i])) beyond[i] = beyondBoundaries(evaluator_, *around[i], lengthToBeat(seek), misses);
  });
  std::vector<Eigen::VectorXd> places;
  for (const auto& list : beyond)
    places.insert(places.end(), list.begin(), list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), localSolves())));
  eraseKnown(places);
  std::vector<EditPointPtr> points(places.size());
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    points[i] = evaluator_.make(places[i], true, {{&contacts}});
  });
  std::erase(points, nullptr);
  std::erase_if(points, [&](const EditPointPtr& p) { return lacksImpacts(evaluator_.problem(), *p); });
  return points;
}

// Where the one row changes its sign between two points of a sequence, of each sequence between those that change
// least. The arc on which a strongly bent row is met may be too short for steps to come onto it.
std::vector<EditPointPtr> SequenceSearch::crossings(const std::vector<EditPointPtr>& points) {
  if (evaluator_.problem().constraints.size() != 1 || evaluator_.problem().constraints.equations().size() != 1) return {};
  std::map<std::string, std::pair<EditPointPtr, EditPointPtr>> smallest;  // below and above the target
  for (const EditPointPtr& point : points) {
    if (!point->rows.available) continue;
    auto& [below, above] = smallest[point->signature];
    EditPointPtr& slot = point->rows.scaled[0] < 0 ? below : above;
    if (!slot || point->objective < slot->objective) slot = point;
  }
  std::vector<std::pair<double, Eigen::VectorXd>> places;
  for (const auto& [signature, pair] : smallest) {
    const auto& [below, above] = pair;
    if (!below || !above) continue;
    const double low = below->rows.scaled[0], high = above->rows.scaled[0];
    const Eigen::VectorXd place = below->changes - low / (high - low) * (above->changes - below->changes);
    places.emplace_back(lengthOf(evaluator_.problem(), place), place);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  places.resize(std::min(places.size(), localSolves()));
  std::vector<EditPointPtr> found(places.size());
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    found[i] = evaluator_.make(places[i].second, true, {{&contacts}});
  });
  std::erase(found, nullptr);
  return found;
}

// From the points that lack least, steps towards the impacts that they lack. Returns those that arrived.
std::vector<EditPointPtr> SequenceSearch::approachAll(const std::vector<EditPointPtr>& lacking) {
  const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::vector<std::pair<double, EditPointPtr>> ranked(lacking.size());
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    double left = 0;  // of what was required
    for (const LackingImpact& impact : missingImpacts(evaluator_.problem(), *lacking[i])) left += 1 - impact.share;
    ranked[i] = {left, lacking[i]};
  });
  std::stable_sort(ranked.begin(), ranked.end(), nearer);
  const std::size_t followed = solutions_.empty() ? localSolves() : (localSolves() + 1) / 2;
  ranked.resize(std::min(ranked.size(), kLackingForEach * followed));
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    ranked[i].first = lackOf(evaluator_.problem(), *ranked[i].second);
  });
  std::stable_sort(ranked.begin(), ranked.end(), nearer);
  ranked.resize(std::min(ranked.size(), followed));
  forAll(ranked.size(), [&](std::size_t i, ContactSource& contacts) {
    EditEvaluator branch = evaluator_.branch({{&contacts}, nullptr, true}, true);
    ranked[i].second = approach(branch, ranked[i].second, kApproachSteps);
    ranked[i].first = lackOf(evaluator_.problem(), *ranked[i].second);
  });
  std::vector<EditPointPtr> arrived;
  for (const auto& [lack, point] : ranked) {
    if (lack == 0) arrived.push_back(point);
    if (lack > 0 && lack < least_lack_) least_lack_ = lack, nearest_lacking_ = point;
  }
  return arrived;
}

}  // namespace carom::editing_detail

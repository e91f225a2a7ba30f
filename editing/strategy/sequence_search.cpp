// SPDX-License-Identifier: MIT
#include "editing/strategy/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/solve/dependence.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/samples.hpp"

namespace carom::editing_detail {
namespace {

constexpr int kSampleRounds = 8;
constexpr int kSamples = 64;
/// Of each group so many points, the nearest to the constraints, are looked at more closely.
constexpr std::size_t kOfEachGroup = 2;
constexpr std::size_t kLandings = 10;
constexpr int kLandingSteps = 30;
constexpr std::size_t kMinimised = 3;
constexpr int kMinimisingIterations = 40;
/// A step that is so much longer makes up for a change that is smaller by one.
constexpr double kStepsAreUncertain = 1.5;
/// A solution from which the change could still fall by this share, if it were not for the border of its sequence.
constexpr double kAtBorder = 0.05;
/// Once there is a solution only points from which the change is expected to be smaller than this share of it count.
constexpr double kClearlySmaller = 0.9;
/// Solutions of one sequence whose changes differ by less than this share of them are the same.
constexpr double kSameChange = 0.1;

// Around a point that meets the constraints the step is one towards a smaller change: along the free directions, which
// matters at the border of a sequence, or else back to the start.
Surroundings surroundingsOf(const EditSearch& search, EditPoint& point) {
  search.differentiate(point);
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  if (!search.reached(point)) return {point.changes, smallestStep(search, point), free};
  const Eigen::VectorXd smaller = -free * (free.transpose() * point.changes);
  const bool at_border = smaller.norm() > kAtBorder * point.changes.norm();
  return {point.changes, at_border ? smaller : Eigen::VectorXd(-0.5 * point.changes), free};
}

}  // namespace

bool areDistinct(const EditPoint& a, const EditPoint& b) {
  if (a.signature != b.signature) return true;
  return (a.changes - b.changes).norm() > kSameChange * std::max(a.changes.norm(), b.changes.norm());
}

SequenceSearch::SequenceSearch(EditSearch& search, EditPointPtr start)
    : search_(search), pool_(*search.problem().contacts), start_(std::move(start)) {}

template <class Work>
void SequenceSearch::forAll(std::size_t count, const Work& work) {
  const int threads = pool_.isShareable() ? search_.options().threads : 1;
  inParallel(threads, count, [&](std::size_t i) {
    const ContactPool::Loan loan(pool_);
    work(i, loan.source());
  });
}

bool SequenceSearch::round(Seek seek) {
  if (search_.problem().unknowns() == 0) return false;  // nowhere to go
  if (round_ == kSampleRounds || !search_.goesOn()) return false;
  const std::vector<EditPointPtr> points = sample();
  if (!reportBatch()) return false;
  const std::vector<EditPointPtr> landed = land(promising(points, seek), seek);
  if (!reportBatch()) return false;
  minimise(landed);
  ++round_;
  return true;
}

bool SequenceSearch::reportBatch() {
  const EditPointPtr best = search_.best();
  return search_.step(best->objective, best->violation);
}

std::vector<EditPointPtr> SequenceSearch::sample() {
  std::vector<Surroundings> around = {surroundingsOf(search_, *start_)};
  if (search_.best() != start_) around.push_back(surroundingsOf(search_, *search_.best()));
  const std::vector<Eigen::VectorXd> places =
      samples(start_->changes, around, search_.lower(), search_.upper(), round_ * kSamples, kSamples);
  std::vector<EditPointPtr> points(places.size());
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    points[i] = search_.make(places[i], true, {&contacts, nullptr});
  });
  std::erase(points, nullptr);
  if (round_ == 0) points.insert(points.begin(), start_);
  if (search_.best() != start_) points.insert(points.begin(), search_.best());
  for (const EditPointPtr& point : points) search_.consider(point);
  return points;
}

// Those from which the linearised rows lead to the smallest change by the shortest step, sequences that were not tried
// often first.
std::vector<EditPointPtr> SequenceSearch::promising(const std::vector<EditPointPtr>& points, Seek seek) {
  std::map<std::string, std::vector<EditPointPtr>> groups;
  for (const EditPointPtr& point : points)
    if (seek != Seek::smaller_inside || point->signature == start_->signature)
      groups[point->signature].push_back(point);
  std::vector<std::pair<double, EditPointPtr>> ranked;
  for (auto& [signature, group] : groups) {
    std::stable_sort(group.begin(), group.end(),
                     [](const EditPointPtr& a, const EditPointPtr& b) { return a->violation < b->violation; });
    group.resize(std::min(group.size(), seek == Seek::smaller_inside ? kLandings : kOfEachGroup));
    for (const EditPointPtr& point : group) ranked.push_back({0, point});
  }
  const bool improving = seek != Seek::anything && !solutions_.empty();
  const double largest =
      improving ? kClearlySmaller * std::sqrt(2 * solutions_.front()->objective) : std::numeric_limits<double>::max();
  const auto controlsOf = [&](const Eigen::VectorXd& changes) {
    return changes.head(search_.problem().controls.size());
  };
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    auto& [score, point] = ranked[i];
    search_.differentiate(*point);
    const Eigen::VectorXd step = smallestStep(search_, *point);
    const double change = controlsOf(point->changes + step).norm();
    score = (point->changes + step).norm() + kStepsAreUncertain * step.norm();
    if (!std::isfinite(score) || change > largest) score = std::numeric_limits<double>::infinity();
  });
  if (improving) std::erase_if(ranked, [](const auto& entry) { return std::isinf(entry.first); });
  for (auto& [score, point] : ranked) score *= 1 + tries_[point->signature];
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ranked.resize(std::min(ranked.size(), kLandings));
  std::vector<EditPointPtr> chosen;
  for (const auto& [score, point] : ranked) {
    ++tries_[point->signature];
    chosen.push_back(point);
  }
  return chosen;
}

std::vector<EditPointPtr> SequenceSearch::land(const std::vector<EditPointPtr>& candidates, Seek seek) {
  const std::string* within = seek == Seek::smaller_inside ? &start_->signature : nullptr;
  std::vector<EditPointPtr> landed(candidates.size());
  std::vector<int> steps(candidates.size(), 0);
  forAll(candidates.size(), [&](std::size_t i, ContactSource& contacts) {
    EditSearch branch = search_.branch({&contacts, nullptr}, true);
    landed[i] = projectOntoConstraints(branch, candidates[i], kLandingSteps, within);
    steps[i] = branch.iterations() - search_.iterations();
  });
  for (const EditPointPtr& point : landed) search_.consider(point);
  if (!steps.empty()) search_.count(*std::max_element(steps.begin(), steps.end()));
  return landed;
}

// Of each sequence the smallest change that arrived, the smallest of all first.
void SequenceSearch::minimise(const std::vector<EditPointPtr>& landed) {
  std::map<std::string, EditPointPtr> smallest;
  for (const EditPointPtr& point : landed) {
    if (!search_.reached(*point)) continue;
    EditPointPtr& slot = smallest[point->signature];
    if (!slot || point->objective < slot->objective) slot = point;
  }
  std::vector<EditPointPtr> arrived;
  for (const auto& [signature, point] : smallest) arrived.push_back(point);
  std::stable_sort(arrived.begin(), arrived.end(),
                   [](const EditPointPtr& a, const EditPointPtr& b) { return a->objective < b->objective; });
  arrived.resize(std::min(arrived.size(), kMinimised));
  for (const EditPointPtr& point : arrived) {
    const EditPointPtr end =
        search_.halt() == Halt::none ? minimiseWithin(search_, point, kMinimisingIterations) : point;
    add(search_.reached(*end) ? end : point);
  }
}

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

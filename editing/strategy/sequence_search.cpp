// SPDX-License-Identifier: MIT
#include "editing/strategy/sequence_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "editing/solve/dependence.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/approach.hpp"
#include "editing/strategy/landing.hpp"
#include "editing/strategy/missing_impacts.hpp"
#include "editing/strategy/samples.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#define TR(...) if (getenv("CAROM_TRACE")) { double now = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); fprintf(stderr, "        +%7.1f ", now - t0trace); t0trace = now; fprintf(stderr, __VA_ARGS__); fprintf(stderr, "\n"); }
static double t0trace = 0;
namespace carom::editing_detail {
namespace {

/// Of each group so many points, the nearest to the constraints, are looked at more closely.
constexpr std::size_t kOfEachGroup = 2;
/// So many of them for each landing, at most.
constexpr std::size_t kForEachLanding = 4;
constexpr int kLandingSteps = 30, kImprovingSteps = 15;
constexpr int kMinimisingIterations = 40;
constexpr int kApproachSteps = 8;
/// Of the objective: a fifth of a natural scale; and the part of the landings that is done for less than that.
constexpr double kSmallChange = 0.02;
constexpr std::size_t kPart = 4;
/// So many impacts leave few other ways.
constexpr std::size_t kFewImpacts = 2;
/// A step that is so much longer makes up for a change that is smaller by one.
constexpr double kStepsAreUncertain = 1.5;
/// A step that leaves more of the residuals than this, as the rows are linear, leads nowhere.
constexpr double kLeadsNowhere = 0.5;
/// A solution from which the change could still fall by this share, if it were not for the border of its sequence.
constexpr double kAtBorder = 0.05;
/// Once there is a solution only points from which the change is expected to be smaller than this share of it count.
constexpr double kClearlySmaller = 0.995;
/// Rows are not linear: from a sample the change may become smaller than it looks, by this factor.
constexpr double kMayShrink = 1.5;
/// Solutions of one sequence whose changes differ by less than this share of them are the same.
constexpr double kSameChange = 0.1;
/// Samples double from one round without a solution to the next, so often.
constexpr int kDoublings = 6;
/// What a sample takes beside its motion, in steps of simulations.
constexpr double kStepsOfSample = 10;
/// The reach of samples, natural scales; around a solution in lengths of its change.
constexpr double kReach = 3, kReachOfChange = 1.2;

/// Where nothing is known of the rows: everything around it.
Surroundings anywhereAround(const EditPoint& point) {
  const Eigen::Index n = point.changes.size();
  return {point.changes, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Identity(n, n)};
}

// Around a point that meets the constraints the step is one towards a smaller change: along the free directions, which
// matters at the border of a sequence, or else back to the start.
Surroundings surroundingsOf(const EditSearch& search, EditPoint& point) {
  if (!search.differentiate(point)) return anywhereAround(point);
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
    : search_(search),
      plan_(planOf(search.options().effort)),
      pool_(*search.problem().contacts),
      start_(std::move(start)) {}

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
  if (!search_.goesOn()) return false;
  TR("start");
  const std::vector<EditPointPtr> points = sample(seek);
  { std::vector<int> st; for (auto& p : points) st.push_back(int(p->motion.steps)); std::sort(st.begin(), st.end()); if (!st.empty()) TR("samples %zu steps med %d p90 %d max %d start %d", points.size(), st[st.size()/2], st[st.size()*9/10], st.back(), int(start_->motion.steps)); }
  if (!reportBatch()) return false;
  const std::vector<EditPointPtr> landed = landAll(promising(points, seek), seek);
  TR("landed %zu reached %ld", landed.size(), std::count_if(landed.begin(), landed.end(), [&](auto& p) { return search_.reached(*p); }));
  if (!reportBatch()) return false;
  minimise(landed, seek);
  TR("minimised");
  if (getenv("CAROM_SIG")) {
    std::map<std::string, int> c; for (auto& p : points) if (p->rows.available) c[p->signature]++;
    std::map<std::string, int> l; for (auto& p : landed) l[p->signature]++;
    const char* want = getenv("CAROM_SIG");
    fprintf(stderr, "   groups %zu want-sampled %d want-landed %d ; tries %d; best sig %s\n", c.size(), c.count(want) ? c[want] : 0, l.count(want) ? l[want] : 0, tries_.count(want) ? tries_[want] : 0, solutions_.empty() ? "" : solutions_.front()->signature.c_str());
  }
  ++round_;
  rounds_without_ = solutions_.empty() ? rounds_without_ + 1 : 0;
  if (solutions_.empty()) search_.allowLongerMotions();
  return true;
}

bool SequenceSearch::hasSmallChangeInside() const {
  if (solutions_.empty()) return false;
  const EditPoint& best = *solutions_.front();
  if (!(best.objective < kSmallChange && best.signature == start_->signature)) return false;
  return search_.problem().constraints.extentIn(best.motion, best.rows.times).events <= kFewImpacts;
}

std::size_t SequenceSearch::landings() const {
  return hasSmallChangeInside() ? (plan_.landings + kPart - 1) / kPart : plan_.landings;
}

// The cheaper a motion is, the more of them.
int SequenceSearch::sampleCount() const {
  const double steps = kStepsOfSample + static_cast<double>(start_->motion.steps);
  if (!solutions_.empty())
    return static_cast<int>(std::clamp(plan_.improving_steps / steps, 1.0 * plan_.least_samples, 1.0 * plan_.most_samples));
  const double doubled = std::ldexp(plan_.first_steps / steps, std::min(rounds_without_, kDoublings));
  const double least = std::ldexp(plan_.least_samples, std::min(rounds_without_, kDoublings));
  return static_cast<int>(std::clamp(doubled, std::min<double>(least, plan_.most_samples), 1.0 * plan_.most_samples));
}

// What changes less than the best lies nearer to the start. While there is none, every other round reaches further.
double SequenceSearch::reach() const {
  if (solutions_.empty()) return std::ldexp(kReach, rounds_without_ / 2);
  return std::min(kReach, kReachOfChange * lengthOf(search_.problem(), solutions_.front()->changes));
}

double SequenceSearch::lengthToBeat(Seek seek) const {
  if (seek == Seek::others || solutions_.empty()) return std::numeric_limits<double>::infinity();
  return kClearlySmaller * lengthOf(search_.problem(), solutions_.front()->changes);
}

// With a solution in the sequence of the start, others count only where they are allowed to.
bool SequenceSearch::isAllowed(const EditPoint& point) const {
  if (search_.options().sequence == SequencePolicy::smallest || solutions_.empty()) return true;
  const bool inside = std::any_of(solutions_.begin(), solutions_.end(),
                                  [&](const EditPointPtr& s) { return s->signature == start_->signature; });
  return !inside || point.signature == start_->signature;
}

bool SequenceSearch::reportBatch() {
  const EditPointPtr best = search_.best();
  return search_.step(best->objective, best->violation);
}

std::vector<EditPointPtr> SequenceSearch::sample(Seek seek) {
  std::vector<Surroundings> around;
  if (start_->rows.available) around.push_back(surroundingsOf(search_, *start_));
  if (nearest_lacking_ && solutions_.empty()) around.push_back(anywhereAround(*nearest_lacking_));
  if (search_.best() != start_) around.push_back(surroundingsOf(search_, *search_.best()));
  const int count = sampleCount();
  const std::vector<Eigen::VectorXd> places =
      samples(start_->changes, around, search_.lower(), search_.upper(), samples_, count, reach());
  samples_ += count;
  std::vector<EditPointPtr> points(places.size());
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    points[i] = search_.make(places[i], true, {{&contacts}, nullptr, true});
  });
  std::erase(points, nullptr);
  const auto lacks = [&](const EditPointPtr& point) { return !missingImpacts(search_.problem(), *point).empty(); };
  std::vector<EditPointPtr> lacking;
  std::copy_if(points.begin(), points.end(), std::back_inserter(lacking), lacks);
  std::erase_if(points, lacks);
  const double to_beat = lengthToBeat(seek);
  std::erase_if(lacking, [&](const EditPointPtr& p) { return lengthOf(search_.problem(), p->changes) > to_beat; });
  if (round_ == 0 && lacks(start_)) lacking.push_back(start_);
  for (const EditPointPtr& point : approachAll(std::move(lacking))) points.push_back(point);
  if (round_ == 0 && start_->rows.available) points.insert(points.begin(), start_);
  if (search_.best() != start_) points.insert(points.begin(), search_.best());
  for (const EditPointPtr& point : crossings(points)) points.push_back(point);
  for (const EditPointPtr& point : points) search_.consider(point);
  return points;
}

// Where the one row changes its sign between two points of a sequence, of each sequence between those that change least.
// The arc on which a strongly bent row is met may be too short for steps to come onto it.
std::vector<EditPointPtr> SequenceSearch::crossings(const std::vector<EditPointPtr>& points) {
  if (search_.problem().constraints.size() != 1 || search_.problem().constraints.equations().size() != 1) return {};
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
    places.emplace_back(lengthOf(search_.problem(), place), place);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  places.resize(std::min(places.size(), landings()));
  std::vector<EditPointPtr> found(places.size());
  forAll(places.size(), [&](std::size_t i, ContactSource& contacts) {
    found[i] = search_.make(places[i].second, true, {{&contacts}});
  });
  std::erase(found, nullptr);
  return found;
}

// From the points that lack least, steps towards the impacts that they lack. Returns those that arrived.
std::vector<EditPointPtr> SequenceSearch::approachAll(std::vector<EditPointPtr> lacking) {
  std::vector<std::pair<double, EditPointPtr>> ranked;
  const auto share = [](const EditPointPtr& point) {
    double sum = 0;
    for (const LackingImpact& impact : point->rows.lacking) sum += 1 - impact.share;
    return sum;
  };
  std::stable_sort(lacking.begin(), lacking.end(),
                   [&](const EditPointPtr& a, const EditPointPtr& b) { return share(a) < share(b); });
  const std::size_t followed = solutions_.empty() ? landings() : (landings() + 1) / 2;
  lacking.resize(std::min(lacking.size(), kForEachLanding * followed));
  for (const EditPointPtr& point : lacking) ranked.emplace_back(0, point);
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    ranked[i].first = lackOf(search_.problem(), *ranked[i].second);
  });
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ranked.resize(std::min(ranked.size(), followed));
  forAll(ranked.size(), [&](std::size_t i, ContactSource& contacts) {
    EditSearch branch = search_.branch({{&contacts}, nullptr, true}, true);
    ranked[i].second = approach(branch, ranked[i].second, kApproachSteps);
    ranked[i].first = lackOf(search_.problem(), *ranked[i].second);
  });
  std::vector<EditPointPtr> arrived;
  for (const auto& [lack, point] : ranked) {
    if (lack == 0) arrived.push_back(point);
    if (lack > 0 && lack < least_lack_) least_lack_ = lack, nearest_lacking_ = point;
  }
  return arrived;
}

// A few of each impact sequence, all in all no more than can be looked at.
std::vector<EditPointPtr> SequenceSearch::nearestOfEachGroup(const std::vector<EditPointPtr>& points) const {
  const auto nearer = [](const EditPointPtr& a, const EditPointPtr& b) { return a->violation < b->violation; };
  std::map<std::string, std::vector<EditPointPtr>> groups;
  for (const EditPointPtr& point : points)
    if (isAllowed(*point)) groups[point->signature].push_back(point);
  const std::size_t each = std::max(kOfEachGroup, landings() / std::max<std::size_t>(1, groups.size()));
  std::vector<EditPointPtr> nearest;
  for (auto& [signature, group] : groups) {
    std::stable_sort(group.begin(), group.end(), nearer);
    group.resize(std::min(group.size(), each));
    nearest.insert(nearest.end(), group.begin(), group.end());
  }
  std::stable_sort(nearest.begin(), nearest.end(), nearer);
  nearest.resize(std::min(nearest.size(), kForEachLanding * landings()));
  return nearest;
}

// Those from which the linearised rows lead to the smallest change by the shortest step, sequences that were not tried
// often first.
std::vector<EditPointPtr> SequenceSearch::promising(const std::vector<EditPointPtr>& points, Seek seek) {
  std::vector<std::pair<double, EditPointPtr>> ranked;
  for (const EditPointPtr& point : nearestOfEachGroup(points)) ranked.push_back({0, point});
  const double to_beat = lengthToBeat(seek);
  forAll(ranked.size(), [&](std::size_t i, ContactSource&) {
    auto& [score, point] = ranked[i];
    if (!search_.differentiate(*point)) {
      score = std::numeric_limits<double>::infinity();
      return;
    }
    const Eigen::VectorXd step = smallestStep(search_, *point);
    const double left = residualsAfter(search_, *point, step).norm();
    const bool leads_nowhere = !search_.reached(*point) && !(left < kLeadsNowhere * point->rows.scaled.norm());
    const double change = lengthOf(search_.problem(), smallestChange(search_, *point));
    score = change + kStepsAreUncertain * step.norm();
    if (leads_nowhere || !std::isfinite(score) || change > kMayShrink * to_beat) score = std::numeric_limits<double>::infinity();
  });
  std::erase_if(ranked, [](const auto& entry) { return std::isinf(entry.first); });
  for (auto& [score, point] : ranked) score *= 1 + tries_[point->signature];
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ranked.resize(std::min(ranked.size(), landings()));
  std::vector<EditPointPtr> chosen;
  for (const auto& [score, point] : ranked) {
    ++tries_[point->signature];
    chosen.push_back(point);
  }
  return chosen;
}

std::vector<EditPointPtr> SequenceSearch::landAll(const std::vector<EditPointPtr>& candidates, Seek seek) {
  const Landing landing{solutions_.empty() ? kLandingSteps : kImprovingSteps, lengthToBeat(seek), nullptr};
  std::vector<EditPointPtr> landed(candidates.size());
  std::vector<int> steps(candidates.size(), 0);
  forAll(candidates.size(), [&](std::size_t i, ContactSource& contacts) {
    EditSearch branch = search_.branch({{&contacts}}, true);
    landed[i] = land(branch, candidates[i], landing);
    steps[i] = branch.iterations() - search_.iterations();
  });
  std::erase(landed, nullptr);
  for (const EditPointPtr& point : landed)
    if (isAllowed(*point)) search_.consider(point);
  if (!steps.empty()) search_.count(*std::max_element(steps.begin(), steps.end()));
  return landed;
}

// Of each sequence the smallest change that arrived, the smallest of all first.
void SequenceSearch::minimise(const std::vector<EditPointPtr>& landed, Seek seek) {
  std::map<std::string, EditPointPtr> smallest;
  for (const EditPointPtr& point : landed) {
    if (!search_.reached(*point) || !isAllowed(*point)) continue;
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
    const bool worth = seek == Seek::others || solutions_.empty() ||
                       point->objective < kClearlySmaller * solutions_.front()->objective;
    const EditPointPtr end =
        worth && search_.halt() == Halt::none ? minimiseWithin(search_, point, kMinimisingIterations) : point;
    add(search_.reached(*end) ? end : point);
  }
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

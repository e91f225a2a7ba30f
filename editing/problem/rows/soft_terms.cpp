// SPDX-License-Identifier: MIT
#include "editing/problem/rows/soft_terms.hpp"

#include <cmath>
#include <utility>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/nearest_instants.hpp"

namespace carom::editing_detail {
namespace {

void checkSoft(const Constraint& constraint, const std::string& where) {
  const double weight = *constraint.soft;
  if (!(weight > 0 && std::isfinite(weight)))
    throw InputError(where, "found the weight " + number(weight) + ", expected a number > 0");
  if (constraint.hits || !constraint.sequence.empty())
    throw InputError(where, std::string("found a weight of ") + (constraint.hits ? "a hit" : "a sequence") +
                                ", expected a constraint that has an error: an impact is there or not");
}

/// One row of the sum: its seeds, their rates, and what the sum takes of it.
struct SoftTerm {
  std::vector<StateSeed> seeds;
  SeedRates rates;
  double slope = 0, bend = 0;  ///< of w^2 r^2 / 2 by the value, SI
};

/// How the weights slope * seed change with the states.
std::vector<StateSeed> ratesOf(const SoftTerm& term, std::span<const BodyStateRate> rates) {
  double moved = 0;
  for (std::size_t k = 0; k < rates.size(); ++k) moved += rates[k].dot(term.seeds[k]);
  std::vector<StateSeed> out = term.seeds;
  for (StateSeed& seed : out) seed *= term.bend * moved;
  if (!term.rates) return out;
  const std::vector<StateSeed> own = term.rates(rates);
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].position += term.slope * own[k].position, out[k].orientation += term.slope * own[k].orientation;
    out[k].velocity += term.slope * own[k].velocity;
    out[k].angular_velocity += term.slope * own[k].angular_velocity;
    out[k].center_of_mass += term.slope * own[k].center_of_mass;
    out[k].time += term.slope * own[k].time, out[k].mass += term.slope * own[k].mass;
    out[k].inertia += term.slope * own[k].inertia, out[k].gravity += term.slope * own[k].gravity;
    if (own[k].size.size() == 0) continue;
    if (out[k].size.size() == 0) out[k].size = Eigen::VectorXd::Zero(own[k].size.size());
    out[k].size += term.slope * own[k].size;
  }
  return out;
}

/// Whether the seeds of a row change with the states as its note says, or not at all.
bool hasItsRates(const Row& row, const Constraint& constraint, const RowNote& note) {
  if (!note.second_order || row.overSpan() || constraint.at.span) return false;
  return row.kind && (row.kind->read || (constraint.relative_to.empty() && !row.kind->seed_rate));
}

/// A time within a span is where the miss is least, so that the sum does not change with it to first order.
RowReading readingOfAll(const ConstraintSet& set, const Eigen::VectorXd& weights, const Motion& motion) {
  RowReading sum;
  const RowValues rows = set.evaluate(motion, nearestInstants(set, motion));
  if (!rows.available) {
    sum.missing = rows.message;
    return sum;
  }
  sum.second_order = true;
  std::vector<SoftTerm> terms;
  for (int i = 0; i < set.size(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    const RowNote& note = rows.notes[static_cast<std::size_t>(i)];
    const double factor = weights[i] / row.scale, error = factor * rows.residuals[i];
    sum.value += 0.5 * error * error;
    if (row.isRange() && rows.residuals[i] == 0) continue;  // within it nothing pulls
    SoftTerm& term = terms.emplace_back(SoftTerm{rows.seeds[static_cast<std::size_t>(i)], note.seed_rates, factor * error, factor * factor});
    for (StateSeed seed : term.seeds) sum.seeds.push_back(seed *= term.slope);
    sum.second_order = sum.second_order && hasItsRates(row, set.constraints()[static_cast<std::size_t>(row.constraint)], note);
    if (sum.doubt.empty()) sum.doubt = note.doubt;
  }
  if (sum.seeds.empty()) {  // all within their ranges: it does not change
    StateSeed& none = sum.seeds.emplace_back();
    none.body = 0, none.at = Instant::at(0);
    terms.push_back({{none}, {}, 0, 0});
  }
  if (!sum.second_order) return sum;
  sum.seed_rates = [terms = std::move(terms)](std::span<const BodyStateRate> rates) {
    std::vector<StateSeed> out;
    for (const SoftTerm& term : terms) {
      const std::vector<StateSeed> of = ratesOf(term, rates.subspan(out.size(), term.seeds.size()));
      out.insert(out.end(), of.begin(), of.end());
    }
    return out;
  };
  return sum;
}

/// a + b / scale.
RowReading sumOf(RowReading a, const RowReading& b, double scale) {
  if (!b.missing.empty()) return b;
  const std::size_t first = a.seeds.size();
  a.value += b.value / scale;
  for (StateSeed seed : b.seeds) a.seeds.push_back(seed *= 1 / scale);
  if (a.doubt.empty()) a.doubt = b.doubt;
  a.second_order = a.second_order && b.second_order;
  const SeedRates of_a = std::exchange(a.seed_rates, {});
  if (!a.second_order) return a;
  a.seed_rates = [of_a, of_b = b.seed_rates, first, scale](std::span<const BodyStateRate> rates) {
    std::vector<StateSeed> out = of_a(rates.first(first));
    std::vector<StateSeed> rest(rates.size() - first);
    if (of_b) rest = of_b(rates.subspan(first));
    for (StateSeed& seed : rest) out.push_back(seed *= 1 / scale);
    return out;
  };
  return a;
}

}  // namespace

SoftTerms::SoftTerms(const Scene& scene, const std::vector<Constraint>& constraints, double duration) {
  for (std::size_t i = 0; i < constraints.size(); ++i)
    if (constraints[i].soft) checkSoft(constraints[i], "/constraints/" + std::to_string(i) + "/soft");
  const auto set = std::make_shared<ConstraintSet>(scene, constraints, duration, OwnFunctions{}, RowsOf::soft);
  weights_.resize(set->size());
  for (int i = 0; i < set->size(); ++i)
    weights_[i] = *set->constraints()[static_cast<std::size_t>(set->rows()[static_cast<std::size_t>(i)].constraint)].soft;
  set_ = set;
}

RowValues SoftTerms::evaluate(const Motion& motion) const { return set_->evaluate(motion, nearestInstants(*set_, motion)); }

OwnFunctions SoftTerms::beside(const Scene& scene, OwnFunctions own, double duration) const {
  if (empty()) return own;
  MotionFunction sum;
  sum.name = "soft constraints";
  if (!own.objective) {
    own.change_weight = 1;
    if (!set_->waits()) sum.until = When(set_->horizon(duration));
    sum.read = [set = set_, weights = weights_](const Motion& motion) { return readingOfAll(*set, weights, motion); };
  } else {
    sum.read = [set = set_, weights = weights_,
                own = BoundFunction(scene, *own.objective, duration, "minimise")](const Motion& motion) {
      RowReading soft = readingOfAll(*set, weights, motion);
      return soft.missing.empty() ? sumOf(std::move(soft), own.read(motion), own.function.scale) : soft;
    };
  }
  own.objective = std::move(sum);
  return own;
}

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#include "editing/problem/margins/sequence_boundaries.hpp"

#include <algorithm>

#include "editing/problem/rows/required_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// The instants at which targets are read, and the last one of all, up to which every impact counts. What a region
/// keeps clear of is read where it is nearest, and does not jump. Impacts that are held or required must not come after the
/// end, nor must a rest.
std::vector<ReadInstant> instantsOf(const EditProblem& problem, const RowValues& rows, double last) {
  std::vector<ReadInstant> instants;
  bool at_impact = false;
  const std::vector<Body>& bodies = problem.controls.startScene().bodies;
  const auto add = [&](int body, double time) {
    const auto known = std::find_if(instants.begin(), instants.end(),
                                    [&](const ReadInstant& i) { return i.body == body && i.time == time; });
    if (known == instants.end()) instants.push_back({body, time, false});
  };
  const auto addRest = [&](int constraint, const StateSeed& seed) {
    if (constraint < 0) return;
    const Constraint& held = problem.constraints.constraints()[static_cast<std::size_t>(constraint)];
    if (!held.at.rest || held.body != bodies[static_cast<std::size_t>(seed.body)].name) return;
    const bool known = std::any_of(instants.begin(), instants.end(), [&](const ReadInstant& i) {
      return i.body == seed.body && i.rest == seed.at.event;
    });
    if (!known) instants.push_back({seed.body, problem.duration, true, seed.at.event});
  };
  for (int i = 0; i < problem.constraints.size(); ++i) {
    if (problem.constraints.rows()[static_cast<std::size_t>(i)].overSpan()) continue;
    for (const StateSeed& seed : rows.seeds[static_cast<std::size_t>(i)]) {
      if (seed.at.event >= 0) {
        at_impact = true;
        addRest(problem.constraints.rows()[static_cast<std::size_t>(i)].constraint, seed);
        continue;
      }
      add(seed.at.time == last ? -1 : seed.body, seed.at.time);
    }
  }
  const std::vector<Constraint>& held = problem.constraints.constraints();
  if (at_impact || std::any_of(held.begin(), held.end(), requiresImpacts)) instants.push_back({-1, problem.duration, true});
  return instants;
}

}  // namespace

std::vector<EventMargin> sequenceBoundaries(const EditProblem& problem, const Eigen::VectorXd& unknowns,
                                            DerivativeTape& tape, const RowValues& rows, std::size_t most_events) {
  const auto byChanges = [&](const SceneGradient& gradient) { return problem.byChanges(gradient, unknowns); };
  const ConstraintSet::Extent extent = problem.constraints.extentIn(tape.motion(), rows.times);
  return eventMargins(tape, std::min(extent.events, most_events), instantsOf(problem, rows, extent.time), byChanges);
}

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#include "editing/session_alternatives.h"

#include <algorithm>
#include <cmath>

#include "editing/edit.h"
#include "editing/session_numbers.h"

namespace carom {
namespace {

/// Motions whose numbers differ by less than this, in natural scales, are one solution.
constexpr double kSameSolution = 1e-3;
/// The search goes on until there are as many as are asked for, which there may never be.
constexpr double kSearchSeconds = 5;

bool isSame(const Scene& a, const Scene& b, const std::vector<Control>& controls) {
  const std::vector<SessionNumber> x = sessionNumbers(a, controls), y = sessionNumbers(b, controls);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i].value - y[i].value) <= kSameSolution * x[i].scale)) return false;
  return true;
}

}  // namespace

SessionAlternatives alternativesTo(const SessionSnapshot& snapshot, ContactSource& contacts, int most, std::stop_token stop) {
  SessionAlternatives out;
  const SessionContent& now = snapshot.content;
  if (snapshot.wanted.empty()) {
    out.message = "Nothing is nailed, and nothing was dragged: there is nothing to solve in another way.";
    return out;
  }
  EditOptions options;
  options.tolerance = snapshot.tolerance;
  options.sequence = snapshot.sequence == SequencePolicy::stay ? SequencePolicy::stay : SequencePolicy::smallest;
  options.alternatives = most + 1;
  options.threads = 1;
  options.certify = options.explain = false;
  options.time_budget_seconds = kSearchSeconds;
  options.stop = stop;
  const Edit edit(snapshot.began, contacts, now.duration, now.controls, snapshot.wanted);
  EditResult result = edit.solve(options);
  if (stop.stop_requested()) return out;
  if (!result.solved()) {
    out.message = "No other solution was found: " + result.message;
    return out;
  }
  out.least = result.objective;
  EditAlternative best{result.scene, result.changed, result.objective, false, result.residual, result.scaled_residual,
                       result.sequence_after, result.sequence_changes};
  out.found.push_back(std::move(best));
  std::ranges::move(result.alternatives, std::back_inserter(out.found));
  std::erase_if(out.found, [&](const EditAlternative& one) { return isSame(one.scene, now.scene, now.controls); });
  if (out.found.size() > static_cast<std::size_t>(most)) out.found.resize(static_cast<std::size_t>(most));
  // from where everything is met already, no search begins
  const bool from_here = result.objective == 0;
  if (out.found.empty())
    out.message = from_here ? "The motion met everything before it was changed: drag it, or meet nails that are not met, to have a change that could be another."
                            : "No other solution was found.";
  return out;
}

}  // namespace carom

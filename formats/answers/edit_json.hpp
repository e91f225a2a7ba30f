// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/edit.h"

namespace carom::formats_detail {

/// The answer of `carom edit --json`: status, message, met, changed {control, component, name, before, after, share},
/// residuals {constraint, component, name, value, target, error, scaled_error} (of a range target is null, and there
/// are min and max, null on an open side), times {constraint, name, from, to, time}, residual, scaled_residual,
/// objective, iterations, milliseconds, sequence_before, sequence_after, signature_changed, sequence_changes {kind,
/// before, after, matters, sentence}, reliable, certificate {residual, scaled_residual, energy_drift, energy_gain,
/// deepest_penetration, reliable, events, smallest_margin, signature_radius, signature_event} (see Certificate;
/// deepest_penetration is null where it is not known, signature_radius where none is in sight), why_not {conflicts
/// {residuals, names}, inside {constraint, name, body}, at_bounds {control, name, side, bound, removes, change},
/// would_help {name, the members of a control, removes, change, restores_rank, solves (null: not tried)}, rows, rank,
/// extended_rank, sentences} (see WhyNot; null where there is nothing to explain), output, alternatives {objective,
/// much_dearer, residual, scaled_residual, changed, sequence, sequence_changes, output}. `outputs` are the files that
/// the edited scene and those of the alternatives were written to, in this order; where there is none, or it is empty,
/// `output` is null.
std::string editJson(const EditResult& result, const std::vector<std::string>& outputs);

}  // namespace carom::formats_detail

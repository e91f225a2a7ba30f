#pragma once

#include <string>

#include "editing/edit.h"

namespace carom {

/// The answer of `carom edit --json`: status, message, changed {control, component, name, before, after}, residuals
/// {constraint, component, name, value, target, error, scaled_error}, residual, scaled_residual, objective, iterations,
/// milliseconds, sequence_before, sequence_after, signature_changed, sequence_changes {kind, before, after, sentence},
/// reliable, output, alternatives {objective, residual, scaled_residual, changed, sequence, sequence_changes, output}.
/// `outputs` are the files that the edited scene and those of the alternatives were written to, in this order; where
/// there is none, or it is empty, `output` is null.
std::string editJson(const EditResult& result, const std::vector<std::string>& outputs);

}  // namespace carom

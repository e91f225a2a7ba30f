#pragma once

#include <string>

#include "editing/edit.h"

namespace carom {

/// The answer of `carom edit --json`: status, message, changed {control, component, name, before, after}, residuals
/// {constraint, component, name, value, target, error, scaled_error}, residual, scaled_residual, objective, iterations,
/// milliseconds, sequence_before, sequence_after, signature_changed, reliable, output. `output` is the file that the
/// edited scene was written to, null where none was.
std::string editJson(const EditResult& result, const std::string& output);

}  // namespace carom

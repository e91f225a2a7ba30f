// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bench/edits/tasks.h"

namespace carom::bench {

/// A task of those that start anywhere: a hidden motion is drawn first, then a start that differs from it by any amount
/// and may lack what is held. None where the draw does not keep to the limits.
std::optional<Task> drawAnywhere(std::uint64_t seed, int index, int attempt, const Wanted& wanted);

}  // namespace carom::bench

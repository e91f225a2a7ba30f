// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace carom::cli {

/// The unit of a number of a scene by its name ("velocity.x of 'hat'", "size.0.scale of 'cup'"); empty for one that has
/// none.
std::string unitOf(const std::string& name);

}  // namespace carom::cli

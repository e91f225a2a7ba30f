// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "explore/worlds/exploration.h"
#include "formats/base/document.h"

namespace carom {

/// All that the worlds of a document depend on, as text: equal texts, equal worlds. What is for readers alone is not in
/// it; of files that it names there is a hash of what was read. Throws InputError where the document cannot be written.
std::string questionOf(const Document& document, const ExploreOptions& options);

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace carom {

/// Names the shared library that the first edit opens as Ipopt, in place of the one found when carom was built: a copy
/// that a program ships, or a library that depends on one. What it loads is searched for symbols, itself first, before the
/// rest of the process: elementary functions that it defines are Ipopt's, too (docs/elementary.md). Under the address
/// sanitizer, which refuses that, the process is searched first as usual.
/// Throws InputError once a library is open. Safe in several threads.
void setSolverLibrary(const std::string& path);

}  // namespace carom

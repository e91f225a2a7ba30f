// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/pages/declared.h"

namespace carom::cli {

/// Scripts that complete the command in a shell.
std::string bashCompletion(const DeclaredProgram& program);
std::string zshCompletion(const DeclaredProgram& program);
std::string fishCompletion(const DeclaredProgram& program);

/// The man page, in roff.
std::string manPage(const DeclaredProgram& program);

}  // namespace carom::cli

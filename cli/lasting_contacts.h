// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"
#include "cli/output.h"

namespace carom::cli {

/// Which bodies rest, slide, roll and pivot on what, and from when to when, for people; nothing where no contact lasts. Of
/// more than kMostListed only the first, unless `all` are asked for.
void printLastingContacts(Output& out, const Motion& motion, bool all);

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#pragma once

namespace carom::cli {

/// Reads the command line, runs the command and gives the exit code of the process. Throws nothing.
int run(int argc, const char* const* argv);

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <stdexcept>

#include "cli/output.h"

namespace CLI {
class App;
}

namespace carom::cli {

/// How the process ends.
enum class Exit : int { done = 0, input_error = 1, wrong_usage = 2, not_solved = 3, check_failed = 4, ended_early = 5, interrupted = 130, terminated = 143 };

/// Of work that a signal stopped.
Exit exitOf(const Interruption& interruption);

/// Runs a command whose options are read. Throws InputError for what is wrong in the input or the files.
using Action = std::function<Exit(Output&)>;

/// Options that each are right, but not together.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One row of the table of commands. A new command adds its file and a row in commands.cpp.
struct Command {
  const char* name;
  const char* summary;               ///< one line
  const char* examples;              ///< the end of its --help: what it answers, and how it is called
  Action (*declare)(CLI::App& app);  ///< adds its options to `app`; --json, --digits and --quiet are there already
  bool answers = true;               ///< has those three options; otherwise it only writes a text
};

std::span<const Command* const> commands();

extern const Command kSimulateCommand, kGradientCommand, kCheckCommand, kEditCommand, kExploreCommand, kExportCommand, kImportCommand,
    kValidateCommand, kInfoCommand, kReplayCommand, kStudioCommand, kCompletionCommand, kManCommand;

}  // namespace carom::cli

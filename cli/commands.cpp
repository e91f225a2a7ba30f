// SPDX-License-Identifier: MIT
#include "cli/command.h"

namespace carom::cli {

std::span<const Command* const> commands() {
  static constexpr const Command* kTable[] = {&kSimulateCommand, &kGradientCommand, &kCheckCommand,
                                              &kEditCommand,     &kExploreCommand,
#ifndef CAROM_NO_STUDIO  // built without it
                                              &kStudioCommand,
#endif
                                              &kReplayCommand,
                                              &kExportCommand,   &kImportCommand,   &kValidateCommand,
                                              &kInfoCommand,     &kCompletionCommand, &kManCommand};
  return kTable;
}

}  // namespace carom::cli

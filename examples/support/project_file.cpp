// SPDX-License-Identifier: MIT
#include "examples/support/project_file.h"

namespace carom {

std::string projectFile(const std::string& name) { return CAROM_PROJECT_FOLDER "/" + name; }

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom {

/// What an import could not take over as it was: one sentence each, with the name of the node or material.
struct ImportReport {
  std::vector<std::string> warnings;
  std::vector<std::string> joints, triggers;  ///< names of the nodes that have one; neither is simulated
};

}  // namespace carom

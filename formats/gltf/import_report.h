// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom {

/// What an import changed or ignored: one sentence each, with the name of the node or material.
struct ImportReport {
  std::vector<std::string> warnings;  ///< a sentence each
  std::vector<std::string> joints;    ///< names of the nodes that have one; joints are not simulated
  std::vector<std::string> triggers;  ///< names of the nodes that are one; triggers are not simulated
};

}  // namespace carom

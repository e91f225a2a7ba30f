// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/edit.h"

namespace carom::bench {

/// One way to solve edits. Another way to compare is one line in configurations.cpp.
struct Configuration {
  const char* name;   ///< in tables and on the command line
  const char* label;  ///< in the chart and in documents
  EditOptions options;
};
const std::vector<Configuration>& configurations();

}  // namespace carom::bench

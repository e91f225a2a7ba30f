// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_rules.h"

namespace carom::structure {

/// A constant of the search as the table of docs/editing.md has it: a row may name several.
struct ToldConstant {
  std::string name, file, value;
};

/// The rows of the table "| constant | file | value | ..." of a page.
std::vector<ToldConstant> toldConstants(const std::string& page);

/// The value of a constant, or of the default of a member, as it is written in a source: "1e-4", "{1, 0.5, 0.2}". Of a member of
/// SearchPlan in effort.cpp those of kFast, kNormal and kThorough: "10; 10; 16", "-" where it has its default. Empty: there is none.
std::string valueOf(const std::string& name, const std::string& file, const std::string& source);

/// Names of the constants that a source defines, but for the plans of effort.cpp.
std::vector<std::string> constantsOf(const std::string& source);

/// A sentence for each row that is not as the code has it, and for each constant of the search that has no row.
std::vector<std::string> constantViolations(const std::string& page, const Sources& sources);

}  // namespace carom::structure

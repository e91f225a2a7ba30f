// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/base/short_text.hpp"

namespace CLI {
class App;
}

/// The command line as it is declared to CLI11: what --help, the man page and the completions of shells are made of.
namespace carom::cli {

struct DeclaredOption {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional argument none
  std::string value;                 ///< "FILE"; empty for a flag
  std::vector<std::string> choices;  ///< the values there are, where they are few
  std::string help;
  bool required = false;
  bool value_optional = false;
  bool common = false;  ///< one that all commands have

  bool positional() const { return names.empty(); }
  /// Whether the value is a file, and what its name ends with ("json"); nothing: any file.
  bool file() const;
  std::vector<std::string> extensions() const;
};

struct DeclaredCommand {
  std::string name, summary;
  std::string details;  ///< the end of its --help
  std::vector<DeclaredOption> options;
};

struct DeclaredProgram {
  std::string name, version, introduction, details;
  std::vector<DeclaredOption> options;
  std::vector<DeclaredCommand> commands;
};

/// The group of options that all commands have, in --help.
inline constexpr const char* kCommonOptions = "Common options";

DeclaredProgram declaredProgram(const CLI::App& app);

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace carom::cli {

/// The words of a call as the parser takes them: "help edit" as "edit --help", and options that stand before the command
/// after it. Without the name of the program.
std::vector<std::string> orderedWords(int argc, const char* const* argv);

/// For a first word that is no command: "found 'simulat', expected one of ...; did you mean simulate?"
std::string describeNoCommand(const std::vector<std::string>& words);

/// "; did you mean --effort?" for the first option among the words that the command does not have; else empty.
std::string meantOption(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace carom::test {

/// What one run of the command left.
struct CommandRun {
  int code = -1;  ///< exit code; -1 - signal where a signal ended it
  std::string out, err;
};

/// Where the built command is.
std::string commandPath();

/// Runs a program as a process of its own.
CommandRun runProgram(const std::string& path, const std::vector<std::string>& arguments);
/// Runs the built command so.
CommandRun runCommand(const std::vector<std::string>& arguments);

/// Runs a line of sh in which `carom` is the built command.
CommandRun runShell(const std::string& line);

/// Which streams of a process are a terminal.
enum class Terminal { out, error, all };
/// Runs the command on a terminal of 120 columns; the other streams are files. What the terminal got is in `out`, or,
/// with Terminal::error, in `err`. `variables` ("NO_COLOR=1") are set besides.
CommandRun runOnTerminal(Terminal terminal, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& variables = {});

/// Runs it with --json, expects the exit code, and one JSON document alone on standard output.
nlohmann::json runJson(std::vector<std::string> arguments, int code = 0);

/// The names of an object's members, in alphabetical order.
std::vector<std::string> membersOf(const nlohmann::json& object);

/// The scenes under examples/scenes, by their file names without the extension.
std::vector<std::string> sceneNames();
std::string scenePath(const std::string& name);

std::string readText(const std::string& path);
void writeText(const std::string& path, const std::string& text);
/// A new path in a folder of this run of the tests.
std::string temporaryPath(const std::string& name);
/// Writes a file under temporaryPath(name) and gives its path.
std::string writeTemporary(const std::string& name, const std::string& text);

}  // namespace carom::test

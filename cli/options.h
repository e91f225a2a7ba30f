// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

/// Options that several commands have.
namespace carom::cli {

/// Adds the scene document as the positional argument of a command; "-" is standard input.
void addScene(CLI::App& app, std::string& path, bool required = true);

/// How motions are simulated.
struct MotionArguments {
  bool refuse_overlaps = false;
  bool strict = false;                 ///< mesh files that must be repaired are errors
  std::size_t step_limit = 3'000'000;  ///< some seconds of work
};

/// Adds --refuse-overlaps, --strict and --step-limit.
void addMotion(CLI::App& app, MotionArguments& arguments);

/// Adds -o, the file to write: any name but an empty one.
CLI::Option* addOutput(CLI::App& app, std::string& path, const std::string& help, const std::string& type);

/// Accepts finite numbers greater than 0.
CLI::Validator positiveNumber();

}  // namespace carom::cli

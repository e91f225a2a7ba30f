// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

/// Options that several commands have.
namespace carom::cli {

/// Adds the scene document as the positional argument of a command; "-" is standard input.
void addScene(CLI::App& app, std::string& path, bool required = true);

/// How motions are simulated.
struct MotionArguments {
  bool refuse_overlaps = false;
  std::size_t step_limit = 3'000'000;  ///< some seconds of work
};

/// Adds --refuse-overlaps and --step-limit.
void addMotion(CLI::App& app, MotionArguments& arguments);

/// Accepts the name of a file to write: any but an empty one.
CLI::Validator fileName();

/// Accepts finite numbers greater than 0.
CLI::Validator positiveNumber();

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

/// Options that several commands have.
namespace carom::cli {

/// Adds the scene document as the positional argument of a command; "-" is standard input.
void addScene(CLI::App& app, std::string& path, bool required = true);

/// Adds the flag --refuse-overlaps.
void addRefuseOverlaps(CLI::App& app, bool& refuse);

/// Accepts finite numbers greater than 0.
CLI::Validator positiveNumber();

}  // namespace carom::cli

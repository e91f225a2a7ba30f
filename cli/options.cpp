// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cmath>

namespace carom::cli {

void addScene(CLI::App& app, std::string& path, bool required) {
  app.add_option("scene", path, "The scene document; - for standard input")->required(required)->type_name("S.json");
}

void addMotion(CLI::App& app, MotionArguments& arguments) {
  app.add_flag("--refuse-overlaps", arguments.refuse_overlaps,
               "Refuse bodies that overlap at the start (default: they collide once they have separated)");
  app.add_flag("--strict", arguments.strict, "Refuse mesh files that must be repaired (default: repair them and say how)");
  app.add_option("--step-limit", arguments.step_limit,
                 "Work limit of a motion in counted steps (default: 3000000, a few seconds)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000'000'000}))
      ->type_name("N");
}

CLI::Option* addOutput(CLI::App& app, std::string& path, const std::string& help, const std::string& type) {
  const auto check = [](std::string& text) {
    return std::string(text.empty() ? "found an empty name, expected that of a file, or - for standard output" : "");
  };
  return app.add_option("-o,--output", path, help)->check(CLI::Validator(check, "", "file name"))->type_name(type);
}

CLI::Validator positiveNumber() {
  const auto check = [](std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
    return good ? std::string() : "found " + text + ", expected a number > 0";
  };
  return CLI::Validator(check, "", "positive");
}

}  // namespace carom::cli

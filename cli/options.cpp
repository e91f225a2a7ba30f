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
               "Refuse bodies that overlap at the start; else they collide once they have parted");
  app.add_option("--step-limit", arguments.step_limit,
                 "End a motion that takes more steps of work, 3000000 (some seconds) if not given")
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

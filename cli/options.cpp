// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cmath>

namespace carom::cli {

void addScene(CLI::App& app, std::string& path, bool required) {
  app.add_option("scene", path, "The scene document; - for standard input")->required(required)->type_name("S.json");
}

void addRefuseOverlaps(CLI::App& app, bool& refuse) {
  app.add_flag("--refuse-overlaps", refuse, "Refuse bodies that overlap at the start; else they collide once they have parted");
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

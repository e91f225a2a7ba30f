// SPDX-License-Identifier: MIT
#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <new>
#include <string_view>

#include "carom/version.h"
#include "cli/command.h"
#include "cli/pages/declared.h"
#include "cli/words.h"
#include "formats/answers/status_json.hpp"
#include "formats/base/format_error.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr const char* kIntroduction =
    "Rigid motions with impacts, edited through their exact derivatives.\n"
    "A scene document (JSON) has the bodies, the controls that may change and the constraints to meet.";

constexpr const char* kFooter =
    "Start with:\n"
    "  carom simulate examples/scenes/book-on-shelf.json    every impact, and the state at the end\n"
    "  carom edit examples/scenes/book-on-shelf.json -o edited.json\n"
    "                                                       finds the throw that meets the targets\n"
    "  carom export edited.json -o edited.glb               the motion for Blender or any glTF viewer\n"
    "  carom export edited.json -o edited.py --camera       the same for blender --python edited.py\n"
    "\n"
    "carom help COMMAND explains a command, with examples. With --json every command prints one\n"
    "JSON document on standard output, for errors as well; warnings and progress go to standard error.\n"
    "- stands for standard input as an input file, and for standard output after -o; what is otherwise\n"
    "printed as text then goes to standard error. Output is in colour on a terminal, unless NO_COLOR\n"
    "is set.\n"
    "\n"
    "Exit codes: 0 done, 1 error in the input or in a file, 2 wrong usage,\n"
    "            3 the edit did not converge or is infeasible, 4 a check failed,\n"
    "            5 simulate, export: the motion ended early,\n"
    "            130 stopped by Ctrl-C, 143 stopped by SIGTERM.";

/// One error of a run, on the channel that was asked for.
Exit report(bool json, Exit code, const std::string& line, const std::string& message, const std::string& file = "",
            const std::string& pointer = "") {
  Output::printError(line);
  if (json) std::cout << errorJson(message, file, pointer) << std::flush;
  return code;
}

// A place that is no JSON pointer ("line 3, column 12") is part of the sentence.
Exit reportInput(bool json, const InputError& error, const std::string& file) {
  const bool pointer = error.where().empty() || error.where().starts_with('/');
  const std::string message = pointer ? error.message() : error.where() + ": " + error.message();
  return report(json, Exit::input_error, error.what(), message, file, pointer ? error.where() : "");
}

}  // namespace

Exit exitOf(const Interruption& interruption) {
  return interruption.signal() == SIGTERM ? Exit::terminated : Exit::interrupted;
}

namespace {

Exit perform(const Action& action, const Settings& settings) {
  Interruption interruption;
  try {
    Output output(settings, interruption);
    const Exit code = action(output);
    output.finish();
    return code;
  } catch (const Interrupted& interrupted) {
    return report(settings.json, exitOf(interruption), interrupted.what(), interrupted.what());
  } catch (const UsageError& error) {
    return report(settings.json, Exit::wrong_usage, error.what(), error.what());
  } catch (const FormatError& error) {
    return reportInput(settings.json, error, error.file());
  } catch (const InputError& error) {
    return reportInput(settings.json, error, "");
  } catch (const std::bad_alloc&) {
    return report(settings.json, Exit::input_error, "out of memory", "out of memory");
  } catch (const std::exception& error) {
    return report(settings.json, Exit::input_error, error.what(), error.what());
  }
}

/// One empty line between groups of options, not two.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, name, mode), "\n\n\n", "\n\n");
  }
};

void addSettings(CLI::App& app, Settings& settings) {
  app.add_flag("--json", settings.json, "Print one JSON document, numbers to full precision")
      ->group(kCommonOptions);
  app.add_option("--digits", settings.digits, "Significant digits of numbers in text (default: 6, in answers of edit 3)")
      ->check(CLI::Range(1, 17))
      ->type_name("N")
      ->group(kCommonOptions);
  app.add_flag("-q,--quiet", settings.quiet, "Print errors only; files and --json are still written")->group(kCommonOptions);
}

/// Help or the version: what was printed may not have arrived, on a full disk.
int printed(CLI::App& app, const CLI::ParseError& asked) {
  app.exit(asked);
  std::cout.flush();
  if (std::cout) return static_cast<int>(Exit::done);
  return static_cast<int>(report(false, Exit::input_error, "standard output: cannot be written", ""));
}

int runCommandLine(int argc, const char* const* argv) {
  CLI::App app(kIntroduction, "carom");
  app.footer(kFooter);
  app.set_version_flag("-V,--version", std::string("carom ") + kVersion, "Print the version and exit");
  app.formatter(std::make_shared<HelpFormatter>());
  app.get_formatter()->column_width(30);
  Settings settings;
  Action action;
  for (const Command* command : commands()) {
    CLI::App* sub = app.add_subcommand(command->name, command->summary);
    sub->footer(command->examples);
    if (command->answers) addSettings(*sub, settings);
    sub->final_callback([&action, run = command->declare(*sub)] { action = run; });
  }
  app.require_subcommand(1);
  const std::vector<std::string> words = orderedWords(argc, argv);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // as it takes them
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return printed(app, error);
    const auto isJson = [](const char* word) { return std::string_view(word) == "--json"; };
    const bool json = std::any_of(argv, argv + argc, isJson);
    const auto chosen = app.get_subcommands();
    const std::string help = "carom " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help";
    const std::string message =
        chosen.empty() ? describeNoCommand(words) : error.what() + meantOption(*chosen.front(), words);
    const std::string line = message + "\nRun " + help + " for its usage.";
    return static_cast<int>(report(json, Exit::wrong_usage, line, message));
  }
  return static_cast<int>(perform(action, settings));
}

}  // namespace

int run(int argc, const char* const* argv) try {
  return runCommandLine(argc, argv);
} catch (const std::exception& error) {
  std::cerr << "carom: " << error.what() << '\n';
  return static_cast<int>(Exit::input_error);
} catch (...) {
  std::cerr << "carom: an unknown error\n";
  return static_cast<int>(Exit::input_error);
}

}  // namespace carom::cli

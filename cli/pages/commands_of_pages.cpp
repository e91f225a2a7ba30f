// SPDX-License-Identifier: MIT
// carom completion and carom man: what goes with an installed copy of the command, from the text of its --help.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/pages/pages.h"
#include "cli/streams.h"
#include "formats/base/write_file.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct PageArguments {
  std::string shell, output = "-";
};

void addPageOutput(CLI::App& app, PageArguments& arguments) {
  addOutput(app, arguments.output, "The file to write (default: standard output)", "FILE");
}

Exit writePage(const PageArguments& arguments, const std::string& page, Output& out) {
  if (isStandard(arguments.output)) {
    out.reserveForContent();
    out.content(page);
  } else {
    writeFile(arguments.output, page);
  }
  return Exit::done;
}

Action declareCompletion(CLI::App& app) {
  const auto arguments = std::make_shared<PageArguments>();
  app.add_option("shell", arguments->shell, "The shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->type_name("SHELL");
  addPageOutput(app, *arguments);
  return [&app, arguments](Output& out) {
    const DeclaredProgram program = declaredProgram(*app.get_parent());
    const auto script = arguments->shell == "bash"  ? bashCompletion
                        : arguments->shell == "zsh" ? zshCompletion
                                                    : fishCompletion;
    return writePage(*arguments, script(program), out);
  };
}

Action declareMan(CLI::App& app) {
  const auto arguments = std::make_shared<PageArguments>();
  addPageOutput(app, *arguments);
  return [&app, arguments](Output& out) {
    return writePage(*arguments, manPage(declaredProgram(*app.get_parent())), out);
  };
}

}  // namespace

const Command kCompletionCommand{
    "completion", "Print the completion script for a shell",
    "An installed carom has these scripts in its share/ folder, where shells find them. Otherwise:\n"
    "\n"
    "Examples:\n"
    "  carom completion bash > ~/.local/share/bash-completion/completions/carom\n"
    "  carom completion zsh -o ~/.zfunc/_carom      for a folder that is in fpath\n"
    "  carom completion fish > ~/.config/fish/completions/carom.fish",
    declareCompletion, false};

const Command kManCommand{
    "man", "Print the man page",
    "Generated from --help. An installed carom has it in share/man.\n"
    "\n"
    "Examples:\n"
    "  carom man -o carom.1 && man ./carom.1",
    declareMan, false};

}  // namespace carom::cli

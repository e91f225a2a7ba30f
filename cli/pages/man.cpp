// SPDX-License-Identifier: MIT
// The man page, in the macros that groff and mandoc share.
#include <algorithm>
#include <cctype>

#include "cli/pages/pages.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

/// A text as roff reads it: no character and no beginning of a line has a meaning.
std::string roff(const std::string& text) {
  constexpr std::pair<char, const char*> kMeanings[] = {
      {'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'^', "\\(ha"}, {'`', "\\(ga"}};
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size() - 1) + 1;
    const bool is_request = text[from] == '.' || text[from] == '\'';
    out += (is_request ? "\\&" : "") + escaped(text.substr(from, to - from), kMeanings);
    from = to;
  }
  return out;
}

std::vector<std::string> paragraphs(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find("\n\n", from), text.size());
    out.push_back(text.substr(from, to - from));
    from = to + 2;
  }
  return out;
}

/// Prose is filled; what has lines that are set in stays as it is.
std::string paragraph(const std::string& text) {
  const bool set_in = text.starts_with(' ') || text.find("\n ") != std::string::npos;
  if (!set_in) return ".PP\n" + roff(text) + "\n";
  return ".PP\n.nf\n" + roff(text) + "\n.fi\n";
}

/// What follows a heading is a paragraph without being told.
std::string withoutBreak(const std::string& text) {
  const std::string macro = ".PP\n";
  return text.starts_with(macro) ? text.substr(macro.size()) : text;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string describedOption(const DeclaredOption& option) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i) text += (i > 0 ? ", " : "") + bold(option.names[i]);
  if (option.positional()) text += italic(option.value);
  if (!option.positional() && !option.value.empty())
    text += option.value_optional ? " [" + italic(option.value) + "]" : " " + italic(option.value);
  text += "\n" + roff(option.help);
  if (!option.choices.empty()) text += " (" + roff(joined(option.choices, ", ")) + ")";
  return text + ".\n";
}

std::string describedOptions(const std::vector<DeclaredOption>& options, bool common) {
  std::string text;
  for (const DeclaredOption& option : options)
    if (option.common == common && std::find(option.names.begin(), option.names.end(), "--help") == option.names.end())
      text += describedOption(option);
  return text;
}

std::string synopsis(const std::string& program, const DeclaredCommand& command) {
  std::string text = ".B " + roff(program + " " + command.name) + "\n";
  for (const DeclaredOption& option : command.options)
    if (option.positional()) text += option.required ? italic(option.value) + "\n" : "[" + italic(option.value) + "]\n";
  for (const DeclaredOption& option : command.options)
    if (!option.positional() && option.required) text += bold(option.names.front()) + " " + italic(option.value) + "\n";
  return text + "[" + italic("OPTION") + "]...\n";
}

}  // namespace

std::string manPage(const DeclaredProgram& program) {
  std::string title = program.name;
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
  const std::string purpose = program.introduction.substr(0, program.introduction.find(".\n"));
  std::string text = ".\\\" Written by `carom man` from the text of --help.\n.TH " + title + " 1 \"\" \"" +
                     program.name + " " + program.version + "\" \"User Commands\"\n";
  text += ".SH NAME\n" + program.name + " \\- " + roff(purpose) + "\n.SH SYNOPSIS\n";
  for (const DeclaredCommand& command : program.commands)
    text += (&command == &program.commands.front() ? "" : ".br\n") + synopsis(program.name, command);
  text += ".SH DESCRIPTION\n" + roff(program.introduction) + "\n.SH OPTIONS\n";
  text += describedOptions(program.options, false);
  text += describedOptions(program.commands.front().options, true);
  text += ".SH COMMANDS\n";
  for (const DeclaredCommand& command : program.commands) {
    text += ".SS " + roff(program.name + " " + command.name) + "\n" + roff(command.summary) + ".\n";
    for (const std::string& part : paragraphs(command.details)) text += paragraph(part);
    text += describedOptions(command.options, false);
  }
  std::string notes, exits;
  for (const std::string& part : paragraphs(program.details))
    (part.starts_with("Exit codes") ? exits : notes) += paragraph(part);
  return text + ".SH NOTES\n" + withoutBreak(notes) + ".SH EXIT STATUS\n" + withoutBreak(exits);
}

}  // namespace carom::cli

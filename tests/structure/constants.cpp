// SPDX-License-Identifier: MIT
#include "tests/structure/constants.h"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace carom::structure {
namespace {

// Where the constants of the search are; of editing/solve those that its steps use.
bool isOfSearch(const std::string& path) {
  static const std::regex files("editing/(strategy/.*|solve/(edit_evaluator|projection|reduced_hessian|minimise)\\.(cpp|hpp))");
  return std::regex_match(path, files);
}

std::vector<std::string> parts(const std::string& text, const std::string& separator) {
  std::vector<std::string> found;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(separator, from)) != std::string::npos; from = at + separator.size())
    found.push_back(text.substr(from, at - from));
  found.push_back(text.substr(from));
  return found;
}

// Up to the comma or semicolon after it, outside of braces.
std::string valueAt(const std::string& source, std::size_t from) {
  int depth = 0;
  std::string value;
  for (std::size_t i = from; i < source.size(); ++i) {
    const char c = source[i];
    if (depth == 0 && (c == ',' || c == ';' || c == '}')) break;
    depth += (c == '{') - (c == '}');
    const bool blank = c == ' ' || c == '\n';
    if (!blank) value += c;
    if (blank && !value.empty() && value.back() != ' ') value += ' ';
  }
  while (!value.empty() && value.back() == ' ') value.pop_back();
  return value;
}

std::string planValues(const std::string& name, const std::string& source) {
  std::string values;
  bool any = false;
  for (const char* plan : {"SearchPlan kFast{", "SearchPlan kNormal{", "SearchPlan kThorough{"}) {
    const std::size_t from = source.find(plan);
    const std::string text = from == std::string::npos ? "" : source.substr(from, source.find("};", from) + 1 - from);
    const std::size_t at = text.find("." + name + " = ");
    any = any || at != std::string::npos;
    values += (values.empty() ? "" : "; ") + (at == std::string::npos ? "-" : valueAt(text, at + name.size() + 4));
  }
  return any ? values : "";
}

}  // namespace

std::vector<ToldConstant> toldConstants(const std::string& page) {
  static const std::regex row("\\| (`\\w+`(?:, `\\w+`)*) \\| `([\\w.]+)` \\| ([^|]*) \\| [^|]+ \\|(?: [^|]+ \\|)?");
  std::vector<ToldConstant> told;
  std::istringstream lines(page);
  std::smatch match;
  bool in_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("| constant | file | value |")) in_table = true;
    if (!line.starts_with("|")) in_table = false;
    if (!in_table || !std::regex_match(line, match, row)) continue;
    const std::vector<std::string> names = parts(match[1], ", "), values = parts(match[3], "; ");
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string name = names[k].substr(1, names[k].size() - 2);
      const bool one_each = names.size() > 1;
      told.push_back({name, match[2], one_each ? (k < values.size() ? values[k] : "") : match[3].str()});
    }
  }
  return told;
}

std::string valueOf(const std::string& name, const std::string& file, const std::string& source) {
  if (file == "effort.cpp") return planValues(name, source);
  const std::regex definition("\\b" + name + "(\\[\\])?( = |(?=\\{))");
  std::smatch match;
  if (!std::regex_search(source, match, definition)) return "";
  return valueAt(source, static_cast<std::size_t>(match.position() + match.length()));
}

std::vector<std::string> constantsOf(const std::string& source) {
  static const std::regex declaration("constexpr [^;]*;"), name("\\b(k[A-Z]\\w*)(?=(?:\\[\\])? = |\\{)");
  static const std::set<std::string> plans = {"kFast", "kNormal", "kThorough"};
  std::vector<std::string> found;
  for (std::sregex_iterator it(source.begin(), source.end(), declaration), end; it != end; ++it) {
    const std::string text = it->str();
    for (std::sregex_iterator n(text.begin(), text.end(), name); n != end; ++n)
      if (!plans.contains((*n)[1])) found.push_back((*n)[1]);
  }
  return found;
}

std::vector<std::string> constantViolations(const std::string& page, const Sources& sources) {
  const std::vector<ToldConstant> told = toldConstants(page);
  std::set<std::pair<std::string, std::string>> rows;
  std::vector<std::string> found;
  for (const auto& [name, file, value] : told) {
    rows.emplace(file, name);
    const auto source = std::find_if(sources.begin(), sources.end(), [&, &file = file](const auto& entry) {
      return isOfSearch(entry.first) && entry.first.ends_with("/" + file);
    });
    const std::string real = source == sources.end() ? "" : valueOf(name, file, source->second);
    if (real != value) found.push_back("the table says " + name + " = " + value + ", " + file + " says '" + real + "'");
  }
  for (const auto& [path, text] : sources)
    if (isOfSearch(path))
      for (const std::string& name : constantsOf(text))
        if (const std::string file = path.substr(path.rfind('/') + 1); !rows.contains({file, name}))
          found.push_back("the table has no row for " + name + " of " + file);
  return found;
}

}  // namespace carom::structure

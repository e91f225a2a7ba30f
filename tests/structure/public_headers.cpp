// SPDX-License-Identifier: MIT
#include "tests/structure/public_headers.h"

#include <map>
#include <regex>
#include <sstream>

namespace carom::structure {
namespace {

bool inLibrary(const std::string& path) {
  static const std::regex library("(adjoint|ode_bridge|editing|formats|explore)/.*");
  return std::regex_match(path, library);
}

}  // namespace

std::vector<std::string> privateIncludes(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const bool is_public = inLibrary(path) && path.ends_with(".h");
  if (!is_public && !path.starts_with("python/")) return found;  // the bindings are a user of the public headers
  for (const std::string& include : includesOf(text))
    if (inLibrary(include) && include.ends_with(".hpp"))
      found.push_back(path + " includes " + include + ", which is not installed");
  return found;
}

// The sources are formatted: what stands in a namespace begins a line.
std::vector<std::string> definedTypes(const std::string& text) {
  static const std::regex space("namespace ([\\w:]+) \\{"), closing("\\}  // namespace.*"),
      type("(?:struct|class|enum class|enum|union) (\\w+)(?: final)?(?: :[^:].*)? \\{.*"), alias("using (\\w+) = .*");
  std::vector<std::string> found, spaces;
  std::istringstream lines(text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, space)) {
      spaces.push_back(match[1]);
    } else if (std::regex_match(line, closing) && !spaces.empty()) {
      spaces.pop_back();
    } else if (std::regex_match(line, match, type) || std::regex_match(line, match, alias)) {
      std::string name;
      for (const std::string& part : spaces) name += part + "::";
      found.push_back(name + match[1].str());
    }
  }
  return found;
}

std::vector<std::string> privateNamesInCarom(const std::string& path, const std::string& text) {
  static const std::regex directly("carom::\\w+");
  std::vector<std::string> found;
  if (!inLibrary(path) || !path.ends_with(".hpp")) return found;
  for (const std::string& type : definedTypes(text))
    if (std::regex_match(type, directly)) found.push_back(path + " defines " + type + " beside the public names");
  return found;
}

std::vector<std::string> typesDefinedTwice(const Sources& sources) {
  std::map<std::string, std::string> first;
  std::vector<std::string> found;
  for (const auto& [path, text] : sources) {
    if (!inLibrary(path) || path.ends_with(".cpp")) continue;
    for (const std::string& type : definedTypes(text)) {
      const auto [known, is_new] = first.emplace(type, path);
      if (!is_new) found.push_back(type + " is defined in " + known->second + " and in " + path);
    }
  }
  return found;
}

std::vector<std::string> typesWithoutExample(const Sources& sources) {
  std::string examples;
  for (const auto& [path, text] : sources)
    if (path.starts_with("examples/")) examples += text;
  std::vector<std::string> found;
  for (const auto& [path, text] : sources) {
    if (!inLibrary(path) || !path.ends_with(".h")) continue;
    for (const std::string& type : definedTypes(text)) {
      const std::string name = type.substr(type.rfind(':') + 1);
      if (name.ends_with("Of") || std::regex_search(examples, std::regex("\\b" + name + "\\b"))) continue;
      found.push_back(type + " of " + path + " is in no example");
    }
  }
  return found;
}

}  // namespace carom::structure

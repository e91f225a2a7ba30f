// SPDX-License-Identifier: MIT
#include "tests/structure/pages.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <sstream>

namespace carom::structure {
namespace {

constexpr int kMostDecisions = 60, kMostDecisionLines = 5;
constexpr std::size_t kWidestDecisionLine = 140;

/// Lines outside of fenced code.
std::vector<std::string> proseLines(const std::string& page) {
  std::vector<std::string> found;
  std::istringstream lines(page);
  bool in_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(' ') != std::string::npos && line.substr(line.find_first_not_of(' ')).starts_with("```"))
      in_code = !in_code;
    else if (!in_code)
      found.push_back(line);
  }
  return found;
}

std::string slugOf(const std::string& heading) {
  std::string slug;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      slug += '-';
    else if (std::isalnum(byte) || byte >= 0x80 || c == '-' || c == '_')
      slug += static_cast<char>(std::tolower(byte));
  }
  return slug;
}

std::string fileOf(const std::string& page, const std::string& link) {
  if (link.empty()) return page;
  return (std::filesystem::path(page).parent_path() / link).lexically_normal().generic_string();
}

long charactersOf(const std::string& line) {  // of UTF-8
  return std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

}  // namespace

std::set<std::string> anchorsOf(const std::string& page) {
  static const std::regex heading("#+ +(.*?)( *\\{#([\\w-]+)\\})?"), link("\\[([^\\]]*)\\]\\([^)]*\\)");
  std::set<std::string> anchors;
  std::map<std::string, int> times;
  std::smatch match;
  for (const std::string& line : proseLines(page)) {
    if (!std::regex_match(line, match, heading)) continue;
    const std::string slug = slugOf(std::regex_replace(match[1].str(), link, "$1"));
    const int before = times[slug]++;
    anchors.insert(before == 0 ? slug : slug + "-" + std::to_string(before));
    if (match[3].matched) anchors.insert(match[3]);
  }
  return anchors;
}

std::vector<std::string> linksOf(const std::string& page) {
  static const std::regex code("`[^`]*`"), link("\\]\\(([^)\\s]+)\\)");
  std::string prose;
  for (const std::string& line : proseLines(page)) prose += line + "\n";
  prose = std::regex_replace(prose, code, "");
  std::vector<std::string> found;
  for (std::sregex_iterator it(prose.begin(), prose.end(), link), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

std::vector<std::string> deadLinks(const Pages& pages, const std::function<bool(const std::string&)>& exists) {
  std::map<std::string, std::set<std::string>> anchors;
  for (const auto& [path, text] : pages) anchors[path] = anchorsOf(text);
  std::vector<std::string> found;
  for (const auto& [path, text] : pages) {
    for (const std::string& link : linksOf(text)) {
      if (link.find("://") != std::string::npos || link.starts_with("mailto:")) continue;
      const std::size_t hash = link.find('#');
      const std::string file = fileOf(path, link.substr(0, hash));
      if (!exists(file))
        found.push_back(path + " links to " + link + ", where there is no file");
      else if (hash != std::string::npos && !anchors[file].contains(link.substr(hash + 1)))
        found.push_back(path + " links to " + link + ", where there is no such heading");
    }
  }
  return found;
}

std::vector<std::string> pagesNotIndexed(const Pages& pages) {
  const std::string index = "docs/index.md";
  if (!pages.contains(index)) return {"there is no " + index};
  std::set<std::string> linked = {index};
  for (const std::string& link : linksOf(pages.at(index))) linked.insert(fileOf(index, link.substr(0, link.find('#'))));
  std::vector<std::string> found;
  for (const auto& [path, text] : pages)
    if (path.starts_with("docs/") && !linked.contains(path)) found.push_back(index + " does not link to " + path);
  return found;
}

std::vector<std::string> lostSources(const Pages& pages, const std::vector<std::string>& paths) {
  static const std::regex source("`([\\w./-]*\\w\\.(?:h|hpp|cpp))`");
  std::vector<std::string> found;
  for (const auto& [path, text] : pages) {
    for (std::sregex_iterator it(text.begin(), text.end(), source), end; it != end; ++it) {
      const std::string name = (*it)[1];
      const bool is_there = std::any_of(paths.begin(), paths.end(), [&](const std::string& known) {
        return known == name || known.ends_with("/" + name);
      });
      if (!is_there) found.push_back(path + " names " + name + ", which there is not");
    }
  }
  return found;
}

std::vector<std::string> pagesWithoutExample(const Pages& pages) {
  constexpr int kOpening = 16;
  std::vector<std::string> found;
  for (const auto& [path, text] : pages) {
    std::istringstream lines(text);
    bool has_example = false;
    std::string line;
    for (int i = 0; i < kOpening && std::getline(lines, line); ++i)
      has_example = has_example || line.starts_with("```") || line.starts_with("![") || line.starts_with("|");
    if (!has_example) found.push_back(path + " opens without an example or a picture");
  }
  return found;
}

std::vector<std::string> decisionViolations(const std::string& page) {
  static const std::regex entry("(\\d+)\\. \\*\\*.*");
  std::vector<std::string> found;
  std::istringstream lines(page);
  std::smatch match;
  int entries = 0, length = 0;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, entry)) {
      length = 0;
      if (std::stoi(match[1]) != ++entries) found.push_back("decision " + match[1].str() + " should be " + std::to_string(entries));
    } else if (line.empty() || line.starts_with("#")) {
      length = -1;  // not in an entry
    }
    if (length < 0) continue;
    if (++length == kMostDecisionLines + 1 && entries > 0) found.push_back("decision " + std::to_string(entries) + " has more than five lines");
    if (entries > 0 && charactersOf(line) > static_cast<long>(kWidestDecisionLine))
      found.push_back("decision " + std::to_string(entries) + " has a line of more than 140 characters");
  }
  if (entries > kMostDecisions) found.push_back("there are " + std::to_string(entries) + " decisions; the most is 60");
  if (entries == 0) found.push_back("there are no decisions");
  return found;
}

}  // namespace carom::structure

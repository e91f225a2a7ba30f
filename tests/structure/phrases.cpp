// SPDX-License-Identifier: MIT
#include "tests/structure/phrases.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace carom::structure {
namespace {

namespace fs = std::filesystem;

/// The words of a text in small letters with one space between them, without the marks that begin lines of comments,
/// quotations and lists; and the line of each character.
struct Words {
  std::string text;
  std::vector<int> lines;
};

Words wordsOf(const std::string& text) {
  Words words;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::size_t from = line.find_first_not_of(" \t/*#>");
    if (from == std::string::npos) from = line.size();
    line += ' ';
    for (const char c : line.substr(from)) {
      const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (blank && (words.text.empty() || words.text.back() == ' ')) continue;
      words.text += blank ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      words.lines.push_back(number);
    }
  }
  return words;
}

bool isProse(const std::string& path) {
  static const std::vector<std::string> kinds = {".md", ".h", ".hpp", ".cpp", ".js", ".html", ".json", ".py"};
  return path.find("node_modules") == std::string::npos && !path.ends_with("package-lock.json") &&
         std::any_of(kinds.begin(), kinds.end(), [&](const std::string& kind) { return path.ends_with(kind); });
}

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

}  // namespace

std::vector<Phrase> readPhrases(const std::string& list) {
  std::vector<Phrase> phrases;
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    if (trimmed(line).empty() || line.starts_with("#")) continue;
    const std::size_t bar = line.find('|');
    const Phrase phrase = {trimmed(line.substr(0, bar)), bar == std::string::npos ? "" : trimmed(line.substr(bar + 1))};
    if (phrase.text.empty() || phrase.better.empty()) throw std::runtime_error("no phrase, or nothing better: " + line);
    phrases.push_back(phrase);
  }
  return phrases;
}

std::map<std::string, std::string> readProse(const fs::path& root) {
  std::map<std::string, std::string> prose;
  const auto take = [&](const fs::path& file) {
    const std::string path = file.lexically_relative(root).generic_string();
    if (!isProse(path)) return;
    std::ifstream in(file, std::ios::binary);
    prose[path] = {std::istreambuf_iterator<char>(in), {}};
  };
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.is_regular_file() && entry.path().extension() == ".md") take(entry.path());
  for (const char* folder : {"docs", "adjoint", "ode_bridge", "editing", "formats", "explore", "studio", "cli", "python"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file()) take(entry.path());
  return prose;
}

std::vector<std::string> phrasesIn(const std::string& path, const std::string& text, const std::vector<Phrase>& phrases) {
  const Words words = wordsOf(text);
  std::vector<std::string> found;
  for (const Phrase& phrase : phrases) {
    const std::string sought = trimmed(wordsOf(phrase.text).text);
    for (std::size_t at = words.text.find(sought); at != std::string::npos; at = words.text.find(sought, at + 1))
      found.push_back(path + ":" + std::to_string(words.lines[at]) + " says \"" + phrase.text + "\"; better: " + phrase.better);
  }
  return found;
}

}  // namespace carom::structure

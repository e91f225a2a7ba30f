// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "adjoint/base/errors.h"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

constexpr std::size_t kMaxDepth = 48;                 // a scene with 16 compounds in one another needs 40
constexpr double kExactInteger = 9007199254740992.0;  // 2^53

bool isWordCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.' || c == '_';
}

/// The word of `text` that holds the character at `index`, or that character.
std::string_view wordAt(std::string_view text, std::size_t index) {
  constexpr std::size_t kReach = 30;
  std::size_t begin = index, end = index;
  while (begin > 0 && index - begin < kReach && isWordCharacter(text[begin - 1])) --begin;
  while (end < text.size() && end - index < kReach && isWordCharacter(text[end])) ++end;
  return text.substr(begin, std::max<std::size_t>(end - begin, 1));
}

/// "line 3, column 12" of a byte.
std::string lineAndColumn(std::string_view text, std::size_t index) {
  const std::string_view before = text.substr(0, index);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = newline == std::string_view::npos ? index + 1 : index - newline;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

bool meansNonFinite(std::string_view word) {
  std::string lower;
  for (const char c : word)
    if (c != '+' && c != '-') lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 3> kWords{"nan", "inf", "infinity"};
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

/// What the parser itself says, without its prefix and without the part of the document that it repeats.
std::string parserDetail(const std::string& what) {
  const std::size_t colon = what.find(": ");
  std::string detail = colon == std::string::npos ? what : what.substr(colon + 2);
  const std::string prefix = "syntax error while parsing ";
  if (detail.rfind(prefix, 0) == 0) detail = detail.substr(prefix.size());
  const std::size_t read = detail.find("; last read: ");
  const std::size_t expected = detail.rfind("; expected ");
  if (read != std::string::npos) {
    const bool keep = expected != std::string::npos && expected > read;
    detail = detail.substr(0, read) + (keep ? detail.substr(expected) : "");
  }
  return detail;
}

/// Builds the tree; refuses members given twice, which a tree cannot show any more.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(std::string_view text, std::size_t most_values) : text_(text), most_values_(most_values) {}
  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr) != nullptr; }
  bool boolean(bool value) override { return add(value) != nullptr; }
  bool number_integer(number_integer_t value) override {
    const auto real = static_cast<double>(value);
    return (std::abs(real) < kExactInteger ? add(value) : add(real)) != nullptr;
  }
  bool number_unsigned(number_unsigned_t value) override {
    const auto real = static_cast<double>(value);
    return (real < kExactInteger ? add(value) : add(real)) != nullptr;
  }
  bool number_float(number_float_t value, const string_t&) override { return add(value) != nullptr; }
  bool string(string_t& value) override { return add(std::move(value)) != nullptr; }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.member = std::move(name);
    if (!level.members.insert(level.member).second)
      fail(path(), "the member " + quotedText(level.member) + " a second time", "every member once");
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    const std::size_t index = std::min(position > 0 ? position - 1 : 0, text_.size());
    const std::string place = lineAndColumn(text_, index);
    const std::string_view word = index < text_.size() ? wordAt(text_, index) : std::string_view();
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow)
      fail(path(), std::string(wordAt(text_, index > 0 ? index - 1 : 0)) + " (" + place + ")",
           "a number that a double can hold");
    if (index >= text_.size() || std::string_view(error.what()).find("unexpected end of input") != std::string::npos)
      fail(place, "the end of the text", "the rest of the JSON (" + parserDetail(error.what()) + ")");
    if (meansNonFinite(word)) fail(place, std::string(word), "a number (JSON has no infinity and no NaN)");
    fail(place, quotedText(word), "valid JSON (" + parserDetail(error.what()) + ")");
  }

 private:
  struct Level {
    Json* node;
    std::string member;                       // of an object: the one that is being read
    std::unordered_set<std::string> members;  // of an object: those seen
  };

  /// Pointer of the value that is being read.
  std::string path() const {
    std::string pointer;
    for (const Level& level : levels_) {
      const bool last = &level == &levels_.back();  // the items of an array above it hold the one that is being read
      pointer = level.node->is_object() ? pointerTo(pointer, level.member)
                                        : pointerTo(pointer, level.node->size() - (last ? 0 : 1));
    }
    return pointer;
  }

  Json* add(Json&& value) {
    if (++values_ > most_values_)
      throw InputError("found more than " + std::to_string(most_values_) + " values, expected a smaller document");
    if (levels_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Level& level = levels_.back();
    if (level.node->is_array()) {
      level.node->push_back(std::move(value));
      return &level.node->back();
    }
    // Past the search for an equal member, which `key` has done already in less than linear time.
    auto& members = level.node->get_ref<Json::object_t&>();
    members.push_back({level.member, std::move(value)});
    return &members.back().second;
  }

  bool open(Json&& structure) {
    if (levels_.size() >= kMaxDepth)
      fail(path(), "more than " + std::to_string(kMaxDepth) + " levels of nesting", "fewer");
    levels_.push_back({add(std::move(structure)), {}, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  Json root_;
  std::vector<Level> levels_;
  std::size_t values_ = 0, most_values_;
};

/// The document begins with the member `name` with the value 1.
void requireVersion(const Json& document, const std::string& name) {
  const std::string member = '"' + name + '"';
  if (!document.is_object()) fail("", describe(document), "an object that begins with " + member + ": 1");
  const auto version = document.find(name);
  if (version == document.end()) fail("", "no member " + member, member + ": 1, the version of the format");
  if (*version != 1) fail('/' + name, describe(*version), "1, the version of the format that this program reads");
}

}  // namespace

Json parseJson(std::string_view text, std::size_t most_values) {
  // the parser takes a NUL byte for the end of the text, whatever follows
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    fail(lineAndColumn(text, nul), "a NUL byte", "text");
  TreeBuilder builder(text, most_values);
  Json::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

Json treeOf(std::string_view text, NoJson no_json) { return Json::parse(text, nullptr, no_json == NoJson::throws); }

std::string compactText(const Json& tree, Json::error_handler_t not_utf8) {
  return tree.dump(-1, ' ', false, not_utf8);
}

Json parseJson(std::string_view text, DocumentKind kind, std::size_t most_bytes) {
  constexpr std::size_t kMostJournalValues = 8'000'000;
  const bool scene = kind == DocumentKind::scene;
  if (text.size() > most_bytes)
    throw InputError("found a text of " + std::to_string(text.size()) + " bytes, expected at most " +
                     std::to_string(most_bytes) + " bytes");
  Json document = parseJson(text, scene ? kMostValues : kMostJournalValues);
  requireVersion(document, scene ? "carom" : "carom_journal");  // another version may break every other rule
  requireSchema(document, kind);
  return document;
}

}  // namespace carom::formats_detail

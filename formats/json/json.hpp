// SPDX-License-Identifier: MIT
// Private to formats/*.cpp: a .hpp is not installed, so that no public header shows a JSON type.
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace carom::formats_detail {

using Json = nlohmann::ordered_json;  // members in the order of the document

inline constexpr std::size_t kMostValues = 400'000;  ///< keeps the memory of a hostile document small

/// Text -> tree, within limits of nesting and number of values. Throws InputError for text that is not JSON (where =
/// line and column), numbers too large for a double, and members given twice (where = JSON pointer).
Json parseJson(std::string_view text, std::size_t most_values = kMostValues);

enum class NoJson { throws, discards };
/// Text -> tree, without limits: for the program's own texts. Text that is not JSON throws Json::parse_error, or gives a
/// discarded tree. What parses and dumps is large: it is compiled here once, and not where it is called.
Json treeOf(std::string_view text, NoJson no_json = NoJson::throws);
/// Tree -> text without blanks, as Json::dump writes it.
std::string compactText(const Json& tree, Json::error_handler_t not_utf8 = Json::error_handler_t::strict);

enum class DocumentKind { scene, journal };
/// The tree of a document of a kind, of at most so many bytes, in the version of this program and by its schema. Throws
/// InputError.
Json parseJson(std::string_view text, DocumentKind kind, std::size_t most_bytes);

/// A JSON schema (draft 7) that explains what breaks it.
class Schema {
 public:
  explicit Schema(Json tree);
  Schema(Schema&&) noexcept;
  ~Schema();
  /// Throws InputError at the deepest place where the value breaks it, in the words of its titles.
  void require(const Json& value) const;

 private:
  struct Compiled;
  Json tree_;
  std::unique_ptr<Compiled> compiled_;
};

/// A schema for each definition of a text, which may refer to those of scene.schema.json.
std::map<std::string, Schema> schemasOfDefinitions(const char* text);

/// Throws InputError at the deepest place where the document breaks formats/documents/scene.schema.json or journal.schema.json.
void requireSchema(const Json& document, DocumentKind kind = DocumentKind::scene);

/// One step deeper, escaped as RFC 6901 asks, and control characters as in a JSON text; members of more than 400 bytes
/// are cut, as pointers are for messages.
std::string pointerTo(const std::string& parent, std::string_view member);
std::string pointerTo(const std::string& parent, std::size_t index);

/// A short text for messages: the value itself when it is small, what it is otherwise.
std::string describe(const Json& value);

/// The text with blanks in place of control characters: names from files stand in messages of one line.
std::string oneLine(std::string text);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);
/// What `word`, none of them, most likely should have been: "; did you mean \"b\"?", or nothing.
std::string hintFor(std::string_view word, const std::vector<std::string>& known);
/// Both: "a, b, c; did you mean \"b\"?"
std::string expectedOf(std::string_view word, const std::vector<std::string>& known);

[[noreturn]] void fail(const std::string& where, const std::string& found, const std::string& expected);

}  // namespace carom::formats_detail

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// The shortest decimal text that reads back as exactly this double (at most 17 significant digits).
/// "null" for a number that is not finite: JSON has no such numbers.
std::string numberText(double value);

/// `text` as a JSON string in quotes. Bytes that are not UTF-8 become U+FFFD.
std::string quotedText(std::string_view text);

/// The text, for JsonWriter::value; nothing where it is empty.
inline std::optional<std::string_view> textOrNone(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// Writes one JSON document as text, indented by two spaces; a list or object begun with Layout::line stays, with all
/// that is in it, on one line. The caller keeps begin/end and key/value in order.
class JsonWriter {
 public:
  enum class Layout { block, line };

  JsonWriter& beginObject(Layout layout = Layout::block) { return begin('{', layout); }
  JsonWriter& endObject() { return end('}'); }
  JsonWriter& beginArray(Layout layout = Layout::block) { return begin('[', layout); }
  JsonWriter& endArray() { return end(']'); }

  JsonWriter& key(std::string_view name);
  JsonWriter& null() { return raw("null"); }
  /// Anything that JSON has a form for; lists on one line, an optional that is empty as null, rotations as [w, x, y,
  /// z].
  template <class T>
  JsonWriter& value(const T& value) {
    if constexpr (std::same_as<T, bool>)
      return raw(value ? "true" : "false");
    else if constexpr (std::integral<T>)
      return raw(std::to_string(value));
    else if constexpr (std::floating_point<T> || std::same_as<T, Seconds>)
      return raw(numberText(value));
    else if constexpr (std::convertible_to<const T&, std::string_view>)
      return raw(quotedText(value));
    else if constexpr (std::same_as<T, Quat>)
      return list(std::array{value.w(), value.x(), value.y(), value.z()});
    else if constexpr (requires { value.has_value(); })
      return value.has_value() ? this->value(*value) : null();
    else
      return list(value);
  }

  /// Members of an object: name, value, name, value, ...
  template <class T, class... Rest>
  JsonWriter& members(std::string_view name, const T& first, const Rest&... rest) {
    key(name).value(first);
    if constexpr (sizeof...(Rest) > 0) members(rest...);
    return *this;
  }
  /// The same, left out where the text or list is empty.
  template <class T>
  JsonWriter& unlessEmpty(std::string_view name, const T& value) {
    return value.empty() ? *this : members(name, value);
  }
  /// A member that is a list of objects, one an item; `write` writes the members of each.
  template <class Items, class Write>
  JsonWriter& objects(std::string_view name, const Items& items, Layout layout, const Write& write) {
    key(name).beginArray();
    for (const auto& item : items) {
      beginObject(layout);
      write(item);
      endObject();
    }
    return endArray();
  }

  /// The document, with a newline at its end.
  std::string take();

 private:
  struct Level {
    bool line = false, empty = true;
  };
  JsonWriter& begin(char bracket, Layout layout);
  JsonWriter& end(char bracket);
  JsonWriter& raw(std::string_view token);
  template <class Items>
  JsonWriter& list(const Items& items) {
    beginArray(Layout::line);
    for (const auto& item : items) value(item);
    return endArray();
  }
  void separate();

  std::string out_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace carom::formats_detail

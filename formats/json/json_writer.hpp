// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::formats_detail {

/// The shortest decimal text that reads back as exactly this double (at most 17 significant digits).
/// "null" for a number that is not finite: JSON has no such numbers.
std::string numberText(double value);

/// `text` as a JSON string in quotes. Bytes that are not UTF-8 become U+FFFD.
std::string quotedText(std::string_view text);

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
  JsonWriter& number(double value) { return raw(numberText(value)); }
  JsonWriter& integer(long long value) { return raw(std::to_string(value)); }
  JsonWriter& boolean(bool value) { return raw(value ? "true" : "false"); }
  JsonWriter& text(std::string_view value) { return raw(quotedText(value)); }
  JsonWriter& null() { return raw("null"); }

  /// On one line.
  JsonWriter& numbers(std::span<const double> values);
  JsonWriter& vector(const Vec3& v) { return numbers({v.data(), 3}); }
  /// As [w, x, y, z].
  JsonWriter& quaternion(const Quat& q);
  JsonWriter& texts(const std::vector<std::string>& values);

  /// The document, with a newline at its end.
  std::string take();

 private:
  struct Level {
    bool line = false, empty = true;
  };
  JsonWriter& begin(char bracket, Layout layout);
  JsonWriter& end(char bracket);
  JsonWriter& raw(std::string_view token);
  void separate();

  std::string out_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace carom::formats_detail

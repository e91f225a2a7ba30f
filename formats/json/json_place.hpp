// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "adjoint/base/types.h"
#include "formats/json/json.hpp"

namespace carom::formats_detail {

/// A value in a JSON tree and the pointer to it, for members that may be missing. All functions throw InputError with
/// the pointer for a value of another kind.
struct JsonPlace {
  const Json& value;
  std::string pointer;

  void requireObject() const;
  /// A member of an object.
  std::optional<JsonPlace> find(const char* member) const;
  JsonPlace require(const char* member) const;
  /// Items of an array.
  std::size_t size() const;
  JsonPlace at(std::size_t index) const;

  double number() const;
  bool boolean() const;
  const std::string& text() const;
  Vec3 vector() const;
  Quat quaternion() const;  ///< written x, y, z, w; a unit quaternion, as far as floats go
  int index(std::size_t count, const char* what) const;

  // Of members that may be missing.
  std::optional<double> findNumber(const char* member) const { return findAs(member, &JsonPlace::number); }
  std::optional<Vec3> findVector(const char* member) const { return findAs(member, &JsonPlace::vector); }
  double numberOr(const char* member, double otherwise) const { return findNumber(member).value_or(otherwise); }
  bool booleanOr(const char* member, bool otherwise) const {
    return findAs(member, &JsonPlace::boolean).value_or(otherwise);
  }
  std::string textOr(const char* member, const std::string& otherwise) const {
    return findAs(member, &JsonPlace::text).value_or(otherwise);
  }

 private:
  template <class T>
  std::optional<std::decay_t<T>> findAs(const char* member, T (JsonPlace::*as)() const) const {
    const auto found = find(member);
    return found ? std::optional<std::decay_t<T>>(((*found).*as)()) : std::nullopt;
  }
};

/// extensions/<name> of an object that may have neither.
std::optional<JsonPlace> extensionOf(const JsonPlace& place, const char* name);
/// extras/carom likewise, when it is an object; what other programs write there is none of ours.
std::optional<JsonPlace> caromExtrasOf(const JsonPlace& place);

}  // namespace carom::formats_detail

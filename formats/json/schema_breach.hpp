// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/json/json.hpp"

namespace carom::formats_detail {

/// Finds where documents break a schema (JSON Schema, draft 7). It takes long to make.
class BreachFinder {
 public:
  explicit BreachFinder(const Json& schema);
  ~BreachFinder();

  /// The path to the deepest place of the first breach, in steps as valijson writes them: the document itself, then
  /// "[name]" or "[2]". Nothing: the document keeps the schema.
  std::optional<std::vector<std::string>> breachIn(const Json& document) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace carom::formats_detail

// SPDX-License-Identifier: MIT
#include "formats/json/schema_breach.hpp"

#include <algorithm>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace carom::formats_detail {

struct BreachFinder::Compiled {
  valijson::Schema schema;
};

BreachFinder::BreachFinder(const Json& schema) : compiled_(std::make_unique<Compiled>()) {
  const nlohmann::json plain = schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(plain), compiled_->schema);
}
BreachFinder::~BreachFinder() = default;

std::optional<std::vector<std::string>> BreachFinder::breachIn(const Json& document) const {
  const nlohmann::json plain = document;
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(compiled_->schema, valijson::adapters::NlohmannJsonAdapter(plain), &results))
    return std::nullopt;

  // Causes are reported before what follows from them, and outer alternatives before inner ones: so the first error
  // counts, unless a later one lies deeper inside the same place.
  std::vector<std::string> deepest;
  bool first = true;
  for (const valijson::ValidationResults::Error& error : results) {
    const auto& path = error.context;
    const bool inside = path.size() > deepest.size() && std::equal(deepest.begin(), deepest.end(), path.begin());
    if (first || inside) deepest = path;
    first = false;
  }
  return deepest;
}

}  // namespace carom::formats_detail

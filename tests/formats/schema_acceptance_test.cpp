// SPDX-License-Identifier: MIT
// The quick walk along a schema against the library that judges in full: never yes where that says no, and no only where
// that says no, but for numbers beside integers.
#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "examples/support/project_file.h"
#include "formats/json/schema_acceptance.hpp"
#include "tests/formats/broken_documents.h"
#include "tests/formats/scene_documents.h"

namespace carom {

using namespace formats_detail;

namespace {

class Judge {
 public:
  explicit Judge(const Json& schema) {
    const nlohmann::json plain = schema;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(plain), schema_);
  }
  bool accepts(const Json& document) const {
    const nlohmann::json plain = document;
    valijson::Validator validator;
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(plain), nullptr);
  }

 private:
  valijson::Schema schema_;
};

Json sceneSchema() { return Json::parse(formats_test::textOf(projectFile("formats/documents/scene.schema.json"))); }

std::vector<Json> goodDocuments() {
  std::vector<Json> documents{Json::parse(formats_test::documentWithEverything())};
  for (const std::string& path : formats_test::exampleScenes()) documents.push_back(Json::parse(formats_test::textOf(path)));
  return documents;
}

/// One place of a document, chosen at random, given another value, taken away, or joined by another.
class DocumentMutator {
 public:
  DocumentMutator(unsigned seed, const std::vector<Json>& documents) : random_(seed), documents_(documents) {}

  Json mutated() {
    Json document = documents_[below(documents_.size())];
    for (std::size_t n = 1 + below(2); n > 0; --n) change(somewhere(document));
    return document;
  }

 private:
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  Json& somewhere(Json& document) {
    Json* place = &document;
    while (place->is_structured() && !place->empty() && below(6) > 0)
      place = &std::next(place->begin(), static_cast<std::ptrdiff_t>(below(place->size()))).value();
    return *place;
  }

  void change(Json& place) {
    if (place.is_object() && !place.empty() && below(2) == 0) {
      place.erase(std::next(place.begin(), static_cast<std::ptrdiff_t>(below(place.size()))).key());
    } else if (place.is_object() && below(2) == 0) {
      place[std::vector<std::string>{"name", "body", "size", "weight", "stray"}[below(5)]] = value();
    } else if (place.is_array() && below(2) == 0) {
      place.push_back(value());
    } else {
      place = value();
    }
  }

  Json value() {
    static const std::vector<std::string> kValues{
        "null", "true", "0", "-0.0", "1", "1.0", "-1", "0.5", "1e-320", "1e9", "1.1e9", "1e60", "1e308", "\"\"", "\"x\"",
        "\"\\u00e9\"", "\"density\"", "\"multiply\"", "[]", "{}", "[1,2,3]", "[1,2]", "[0,0,0,1]", "{\"impact\": 1}",
        "18446744073709551615", "-9223372036854775808", "{\"kind\": \"velocity\"}"};
    if (below(3) > 0) return Json::parse(kValues[below(kValues.size())]);
    Json other = documents_[below(documents_.size())];
    return somewhere(other);
  }

  std::mt19937 random_;
  const std::vector<Json>& documents_;
};

TEST(SchemaAcceptance, SaysYesToGoodDocuments) {
  const Json schema = sceneSchema();
  for (const Json& document : goodDocuments()) EXPECT_TRUE(keepsSchema(document, schema)) << document.dump().substr(0, 200);
}

TEST(SchemaAcceptance, AgreesWithTheLibraryOnBrokenDocuments) {
  const Json schema = sceneSchema();
  const Judge judge(schema);
  int compared = 0;
  for (const auto& list : {formats_test::brokenMembers(), formats_test::brokenEdits(), formats_test::brokenShapes(), formats_test::brokenMeaning()})
    for (const formats_test::BrokenDocument& broken : list) {
      const std::string text =
          broken.from.empty() ? broken.text
                              : formats_test::replaced(formats_test::documentWithEverything(), broken.from, broken.text);
      const Json document = Json::parse(text, nullptr, false);
      if (document.is_discarded() || text.size() > 100'000) continue;  // the library takes seconds over large ones
      ++compared;
      if (broken.name == std::string("hugeInteger")) continue;  // read as a number with a fraction: in doubt
      EXPECT_EQ(keepsSchema(document, schema), judge.accepts(document)) << broken.name;
    }
  EXPECT_GT(compared, 100);
}

/// What the walk leaves to the library: 1.0 where an integer is asked for, and integers that doubles do not have.
bool isInDoubt(const std::string& text) {
  return std::regex_search(text, std::regex("[0-9]\\.0[,}\\]]")) || text.find("18446744073709551615") != std::string::npos;
}

TEST(SchemaAcceptance, AgreesWithTheLibraryOnChangedDocuments) {
  const Json schema = sceneSchema();
  const Judge judge(schema);
  const std::vector<Json> documents = goodDocuments();
  DocumentMutator mutator(20261122, documents);
  int accepted = 0, refused = 0;
  for (int k = 0; k < 500; ++k) {
    const Json document = mutator.mutated();
    const bool quick = keepsSchema(document, schema), full = judge.accepts(document);
    (full ? accepted : refused) += 1;
    ASSERT_FALSE(quick && !full) << "document " << k << " of seed 20261122: " << document.dump();
    if (full && !quick) EXPECT_TRUE(isInDoubt(document.dump())) << "document " << k << " of seed 20261122: " << document.dump();
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

// A false yes would let anything in: what the walk does not know makes its answer no, wherever it stands.
TEST(SchemaAcceptance, IsInDoubtAboutOtherRules) {
  for (const char* schema : {
           R"({"pattern": "a"})",
           R"({"anyOf": [{"format": "date"}, {"type": "string"}]})",
           R"({"oneOf": [{"not": {}}, {"type": "string"}]})",
           R"({"type": ["text", "null"]})",
           R"({"$ref": "other.json#/definitions/x"})",
           R"({"$ref": "#/definitions/missing"})",
           R"(7)",
       })
    EXPECT_FALSE(keepsSchema("a text", Json::parse(schema))) << schema;
  EXPECT_FALSE(keepsSchema(Json::parse(R"({"a": 1})"),
                           Json::parse(R"({"patternProperties": {"a": {}}, "additionalProperties": true})")));
  EXPECT_FALSE(keepsSchema(2.0, Json::parse(R"({"type": "integer"})")));
  EXPECT_TRUE(keepsSchema(2, Json::parse(R"({"type": "integer"})")));
}

}  // namespace
}  // namespace carom

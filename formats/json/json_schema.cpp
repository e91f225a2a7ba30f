// SPDX-License-Identifier: MIT
#include <cctype>
#include <cmath>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/json/json.hpp"
#include "formats/json/schema_acceptance.hpp"
#include "formats/json/schema_breach.hpp"

namespace carom::formats_detail {

extern const char* const kSceneSchema;    // made from scene.schema.json
extern const char* const kJournalSchema;  // made from journal.schema.json

namespace {

constexpr const char* kSceneFile = "scene.schema.json";

/// Journals refer to the definitions of scene documents: they become their own, and the scene document one more.
void pointInside(Json& node) {
  if (node.is_array())
    for (Json& item : node) pointInside(item);
  if (!node.is_object()) return;
  for (auto& member : node.items()) {
    if (member.key() != "$ref") {
      pointInside(member.value());
      continue;
    }
    const auto target = member.value().get<std::string>();
    if (target == kSceneFile) member.value() = "#/definitions/scene_document";
    if (target.starts_with(std::string(kSceneFile) + "#")) member.value() = target.substr(std::strlen(kSceneFile));
  }
}

/// What a reference says, and whatever that refers to, becomes a definition of `schema`.
void takeDefinitions(const Json& node, const Json& from, Json& schema) {
  constexpr std::string_view kPrefix = "#/definitions/";
  if (node.is_structured())
    for (const Json& item : node) takeDefinitions(item, from, schema);
  if (!node.is_object() || !node.contains("$ref")) return;
  const std::string name = node["$ref"].get<std::string>().substr(kPrefix.size());
  if (schema["definitions"].contains(name) || !from.contains(name)) return;
  schema["definitions"][name] = from[name];
  takeDefinitions(from[name], from, schema);
}

Json withScene(Json journal) {
  Json scene = treeOf(kSceneSchema);
  pointInside(journal);
  for (const auto& definition : scene["definitions"].items())
    journal["definitions"][definition.key()] = definition.value();
  scene.erase("definitions");
  scene.erase("$schema");
  journal["definitions"]["scene_document"] = std::move(scene);
  return journal;
}

const Schema& schemaOf(DocumentKind kind) {
  static const Schema scene(treeOf(kSceneSchema));
  if (kind == DocumentKind::scene) return scene;
  static const Schema journal(withScene(treeOf(kJournalSchema)));
  return journal;
}

const Json* memberOf(const Json* object, const char* name) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(name);
  return found == object->end() ? nullptr : &*found;
}

/// The definition that a node refers to.
const Json* resolved(const Json* node, const Json& tree) {
  while (const Json* reference = memberOf(node, "$ref"))
    node = &tree.at(Json::json_pointer(reference->get<std::string>().substr(1)));
  return node;
}

bool typeMatches(const Json* node, const Json& value) {
  const Json* type = memberOf(node, "type");
  return type == nullptr || (*type == "object" && value.is_object()) || (*type == "array" && value.is_array()) ||
         (*type == "number" && value.is_number());
}

/// The definition that says what is inside `value`: of alternatives the one of its type.
const Json* alternativeFor(const Json* node, const Json& value, const Json& tree) {
  node = resolved(node, tree);
  if (const Json* alternatives = memberOf(node, "anyOf"))
    for (const Json& alternative : *alternatives)
      if (const Json* candidate = resolved(&alternative, tree); typeMatches(candidate, value)) return candidate;
  return node;
}

/// A place in the document, and what the schema says about it (null where it says nothing).
struct TreePlace {
  const Json* value;
  const Json* node;
  std::string pointer;
  const Json* tree;  // the whole schema
};

/// One step of a path as valijson writes it: "[name]" or "[2]".
bool step(TreePlace& place, const std::string& context) {
  const std::string token = context.substr(1, context.size() - 2);
  const Json* node = alternativeFor(place.node, *place.value, *place.tree);
  if (place.value->is_object()) {
    const auto member = place.value->find(token);
    if (member == place.value->end()) return false;
    const Json* known = memberOf(memberOf(node, "properties"), token.c_str());
    place = {&*member, known != nullptr ? known : memberOf(node, "additionalProperties"),
             pointerTo(place.pointer, token), place.tree};
    return true;
  }
  if (!place.value->is_array()) return false;
  const auto index = static_cast<std::size_t>(std::stoul(token));
  if (index >= place.value->size()) return false;
  place = {&(*place.value)[index], memberOf(node, "items"), pointerTo(place.pointer, index), place.tree};
  return true;
}

std::vector<std::string> keysOf(const Json* object) {
  std::vector<std::string> keys;
  if (object != nullptr)
    for (const auto& member : object->items()) keys.push_back(member.key());
  return keys;
}

/// Of words of other programs for what is not modelled: what happens instead.
std::string notModelled(std::string word) {
  std::erase_if(word, [](char c) { return c == '_' || c == '-'; });
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto has = [&](const char* part) { return word.find(part) != std::string::npos; };
  if (has("rolling")) return "; rolling resistance is not modelled: a ball rolls until something else stops it";
  if (has("spinning") || has("torsional")) return "; torsional friction is not modelled: a body spins about a contact until something else stops it";
  if (has("damping") || has("drag")) return "; damping and air resistance are not modelled";
  return "";
}

[[noreturn]] void failUnknown(const TreePlace& place, const std::string& member, const Json* node) {
  const std::vector<std::string> known = keysOf(memberOf(node, "properties"));
  fail(pointerTo(place.pointer, member), "an unknown member " + describe(Json(member)),
       "one of " + expectedOf(member, known) + notModelled(member));
}

/// "exactly one shape" goes on with the words that there are: those of the shapes among the node's members.
std::string withWords(std::string title, const Json* node, const Json& tree) {
  constexpr std::string_view kPhrase = "exactly one shape";
  const std::size_t at = title.find(kPhrase);
  if (at == std::string::npos) return title;
  const Json* shapes = memberOf(memberOf(memberOf(&tree, "definitions"), "shape"), "properties");
  std::vector<std::string> words;
  for (const std::string& word : keysOf(memberOf(node, "properties")))
    if (memberOf(shapes, word.c_str()) != nullptr) words.push_back('"' + word + '"');
  std::string list = "exactly one of ";
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return title.replace(at, kPhrase.size(), list);
}

/// What `value` must be, in the words of the schema.
std::string expected(const Json* node, const Json& value, const Json& tree) {
  const Json* named = resolved(node, tree);
  const Json* title = memberOf(named, "title");
  if (title == nullptr) {
    named = alternativeFor(node, value, tree);
    title = memberOf(named, "title");
  }
  const std::string text = title != nullptr ? withWords(title->get<std::string>(), named, tree) : "what the schema says";
  constexpr double kLargest = 1e9;  // of most numbers; smaller limits stand in the titles
  const Json* maximum = memberOf(alternativeFor(node, value, tree), "maximum");
  const double limit = std::max(kLargest, maximum != nullptr ? maximum->get<double>() : 0);
  const bool large = value.is_number() && !(std::abs(value.get<double>()) <= limit);
  return large ? text + " of magnitude at most 1e" + std::to_string(std::lround(std::log10(limit))) : text;
}

[[noreturn]] void failMissing(const TreePlace& place, const Json& name, const std::string& beside, const Json* properties) {
  fail(place.pointer, "no member " + compactText(name) + beside,
       compactText(name) + ": " +
           expected(memberOf(properties, name.get_ref<const std::string&>().c_str()), Json(), *place.tree));
}

/// Throws what is wrong at a place that the schema refuses.
[[noreturn]] void explain(const TreePlace& place) {
  const Json& value = *place.value;
  const Json* node = alternativeFor(place.node, value, *place.tree);
  if (value.is_object()) {
    const Json* properties = memberOf(node, "properties");
    const Json* others = memberOf(node, "additionalProperties");
    if (others != nullptr && others->is_boolean())
      for (const auto& member : value.items())
        if (memberOf(properties, member.key().c_str()) == nullptr) failUnknown(place, member.key(), node);
    if (const Json* required = memberOf(node, "required"))
      for (const Json& name : *required)
        if (!value.contains(name.get<std::string>())) failMissing(place, name, "", properties);
    if (const Json* dependencies = memberOf(node, "dependencies"))
      for (const auto& given : dependencies->items())
        for (const Json& name : given.value())
          if (value.contains(given.key()) && !value.contains(name.get<std::string>()))
            failMissing(place, name, " beside \"" + given.key() + "\"", properties);
  }
  const Json* words = memberOf(node, "enum");
  const bool misspelt = words != nullptr && value.is_string();
  fail(place.pointer, describe(value),
       expected(place.node, value, *place.tree) +
           (misspelt ? hintFor(value.get_ref<const std::string&>(), *words) : ""));
}

}  // namespace

struct Schema::Compiled {
  std::once_flag once;
  std::optional<BreachFinder> finder;
};

Schema::Schema(Json tree) : tree_(std::move(tree)), compiled_(std::make_unique<Compiled>()) {}
Schema::Schema(Schema&&) noexcept = default;
Schema::~Schema() = default;

void Schema::require(const Json& document) const {
  if (keepsSchema(document, tree_)) return;
  std::call_once(compiled_->once, [this] { compiled_->finder.emplace(tree_); });
  const auto breach = compiled_->finder->breachIn(document);
  if (!breach) return;
  TreePlace place{&document, &tree_, "", &tree_};
  for (std::size_t i = 1; i < breach->size(); ++i)  // the first is the document itself
    if (!step(place, (*breach)[i])) break;
  explain(place);
}

void requireSchema(const Json& document, DocumentKind kind) { schemaOf(kind).require(document); }

std::map<std::string, Schema> schemasOfDefinitions(const char* text) {
  Json all = treeOf(text);
  pointInside(all);
  Json definitions = treeOf(kSceneSchema)["definitions"];
  for (const auto& own : all["definitions"].items()) definitions[own.key()] = own.value();
  std::map<std::string, Schema> schemas;
  for (const auto& own : all["definitions"].items()) {
    Json tree = *resolved(&own.value(), all);
    const Json rules = tree;
    tree["definitions"] = Json::object();
    takeDefinitions(rules, definitions, tree);
    schemas.emplace(own.key(), Schema(std::move(tree)));
  }
  return schemas;
}

}  // namespace carom::formats_detail

// SPDX-License-Identifier: MIT
#include "formats/json/schema_acceptance.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace carom::formats_detail {
namespace {

using Members = Json::object_t;

std::size_t codePoints(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

class Walk {
 public:
  explicit Walk(const Json& schema) : schema_(schema) {}

  bool keeps(const Json& value, const Json& rules) {
    if (rules.is_boolean()) return rules.get<bool>();
    if (!rules.is_object()) return unknown();
    if (const auto reference = rules.find("$ref"); reference != rules.end())
      return keeps(value, target(reference->get_ref<const std::string&>()));
    for (const auto& [word, rule] : rules.get_ref<const Members&>())
      if (!keepsRule(value, word, rule, rules)) return false;
    return true;
  }

  bool certain() const { return certain_; }

 private:
  using Check = bool (Walk::*)(const Json& value, const Json& rule, const Json& rules);
  struct Keyword {
    const char* word;
    Check check;  // none for what only tells people something
  };
  static const std::array<Keyword, 25> kKeywords;

  bool keepsRule(const Json& value, const std::string& word, const Json& rule, const Json& rules) {
    for (const Keyword& keyword : kKeywords)
      if (word == keyword.word) return keyword.check == nullptr || (this->*keyword.check)(value, rule, rules);
    return unknown();
  }

  bool unknown() {
    certain_ = false;
    return false;
  }

  const Json& target(const std::string& reference) {
    static const Json kNone;
    if (!reference.starts_with("#")) return kNone;
    const Json::json_pointer pointer(reference.substr(1));
    return schema_.contains(pointer) ? schema_.at(pointer) : kNone;
  }

  bool type(const Json& value, const Json& rule, const Json&) {
    if (!rule.is_array()) return hasType(value, rule);
    return std::any_of(rule.begin(), rule.end(), [&](const Json& name) { return hasType(value, name); });
  }
  bool hasType(const Json& value, const Json& name) {
    if (name == "number") return value.is_number();
    if (name == "string") return value.is_string();
    if (name == "boolean") return value.is_boolean();
    if (name == "null") return value.is_null();
    if (name == "object") return value.is_object();
    if (name == "array") return value.is_array();
    // Whether 2.0 is an integer is for the library to say.
    if (name == "integer") return value.is_number_integer() || (value.is_number() && unknown());
    return unknown();
  }

  bool constant(const Json& value, const Json& rule, const Json&) { return value == rule; }  // 1 and 1.0 alike
  bool oneOfWords(const Json& value, const Json& rule, const Json&) {
    return std::find(rule.begin(), rule.end(), value) != rule.end();
  }

  bool minimum(const Json& v, const Json& r, const Json&) { return !v.is_number() || v.get<double>() >= r.get<double>(); }
  bool maximum(const Json& v, const Json& r, const Json&) { return !v.is_number() || v.get<double>() <= r.get<double>(); }
  bool above(const Json& v, const Json& r, const Json&) { return !v.is_number() || v.get<double>() > r.get<double>(); }

  bool minItems(const Json& v, const Json& r, const Json&) { return !v.is_array() || v.size() >= r.get<std::size_t>(); }
  bool maxItems(const Json& v, const Json& r, const Json&) { return !v.is_array() || v.size() <= r.get<std::size_t>(); }
  bool minMembers(const Json& v, const Json& r, const Json&) { return !v.is_object() || v.size() >= r.get<std::size_t>(); }
  bool maxMembers(const Json& v, const Json& r, const Json&) { return !v.is_object() || v.size() <= r.get<std::size_t>(); }
  bool minLength(const Json& v, const Json& r, const Json&) {
    return !v.is_string() || codePoints(v.get_ref<const std::string&>()) >= r.get<std::size_t>();
  }
  bool maxLength(const Json& v, const Json& r, const Json&) {
    return !v.is_string() || codePoints(v.get_ref<const std::string&>()) <= r.get<std::size_t>();
  }

  bool items(const Json& value, const Json& rule, const Json&) {
    if (rule.is_array()) return unknown();
    return !value.is_array() ||
           std::all_of(value.begin(), value.end(), [&](const Json& item) { return keeps(item, rule); });
  }

  bool properties(const Json& value, const Json& rule, const Json&) {
    if (!value.is_object()) return true;
    for (const auto& [name, member] : value.get_ref<const Members&>())
      if (const auto known = rule.find(name); known != rule.end() && !keeps(member, *known)) return false;
    return true;
  }

  bool otherProperties(const Json& value, const Json& rule, const Json& rules) {
    if (!value.is_object()) return true;
    if (rules.contains("patternProperties")) return unknown();
    const auto known = rules.find("properties");
    for (const auto& [name, member] : value.get_ref<const Members&>())
      if ((known == rules.end() || !known->contains(name)) && !keeps(member, rule)) return false;
    return true;
  }

  bool hasAll(const Json& value, const Json& names) {
    return std::all_of(names.begin(), names.end(),
                       [&](const Json& name) { return value.contains(name.get_ref<const std::string&>()); });
  }
  bool required(const Json& value, const Json& rule, const Json&) { return !value.is_object() || hasAll(value, rule); }
  bool dependencies(const Json& value, const Json& rule, const Json&) {
    if (!value.is_object()) return true;
    for (const auto& [name, needed] : rule.get_ref<const Members&>()) {
      if (!needed.is_array()) return unknown();
      if (value.contains(name) && !hasAll(value, needed)) return false;
    }
    return true;
  }

  bool anyOf(const Json& value, const Json& rule, const Json&) {
    return std::any_of(rule.begin(), rule.end(), [&](const Json& rules) { return keeps(value, rules); });
  }
  bool oneOf(const Json& value, const Json& rule, const Json&) {
    return std::count_if(rule.begin(), rule.end(), [&](const Json& rules) { return keeps(value, rules); }) == 1;
  }

  const Json& schema_;
  bool certain_ = true;  // no answer so far rests on a rule that the walk does not know
};

const std::array<Walk::Keyword, 25> Walk::kKeywords{{
    {"title", nullptr},
    {"description", nullptr},
    {"type", &Walk::type},
    {"minimum", &Walk::minimum},
    {"maximum", &Walk::maximum},
    {"exclusiveMinimum", &Walk::above},
    {"minItems", &Walk::minItems},
    {"maxItems", &Walk::maxItems},
    {"items", &Walk::items},
    {"required", &Walk::required},
    {"properties", &Walk::properties},
    {"additionalProperties", &Walk::otherProperties},
    {"enum", &Walk::oneOfWords},
    {"const", &Walk::constant},
    {"minLength", &Walk::minLength},
    {"maxLength", &Walk::maxLength},
    {"minProperties", &Walk::minMembers},
    {"maxProperties", &Walk::maxMembers},
    {"dependencies", &Walk::dependencies},
    {"anyOf", &Walk::anyOf},
    {"oneOf", &Walk::oneOf},
    {"definitions", nullptr},
    {"$comment", nullptr},
    {"$schema", nullptr},
    {"$id", nullptr},
}};

}  // namespace

bool keepsSchema(const Json& document, const Json& schema) {
  Walk walk(schema);
  return walk.keeps(document, schema) && walk.certain();
}

}  // namespace carom::formats_detail

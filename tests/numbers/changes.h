// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace carom::test {

/// What stands in place of a number, as JSON text; some of it is no JSON.
const std::vector<std::string>& strangeValues();

/// JSON pointers to the numbers of a document. Of lists of objects only the first ones are looked at: the five
/// hundredth ball is like the fifth.
std::vector<nlohmann::json::json_pointer> numbersOf(const nlohmann::json& document);

/// The document as text with other text in place of one of its values.
std::string changed(const nlohmann::json& document, const nlohmann::json::json_pointer& place, const std::string& text);

}  // namespace carom::test

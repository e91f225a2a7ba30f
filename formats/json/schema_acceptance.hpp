// SPDX-License-Identifier: MIT
#pragma once

#include "formats/json/json.hpp"

namespace carom::formats_detail {

/// Whether `document` keeps the rules of `schema` (JSON Schema, draft 7), found by walking both side by side. True is
/// certain. False says only that something else must judge and explain: a rule is broken, or is of a kind that the
/// walk does not know. Needs no compiled schema, whose making takes longer than most commands.
bool keepsSchema(const Json& document, const Json& schema);

}  // namespace carom::formats_detail

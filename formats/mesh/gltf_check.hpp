// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include "formats/json/json.hpp"

namespace carom::formats_detail {

/// Holds the geometry of a glTF document to the specification: types, indices in range, accessors within their views
/// and views within their buffers (by the lengths that the document states), no node below itself. Throws InputError
/// with the JSON pointer.
void checkGltf(const Json& document);

}  // namespace carom::formats_detail

// Private to formats/*.cpp.
#pragma once

#include <string>

#include "adjoint/shape.h"

namespace carom {

class JsonWriter;

namespace detail {

/// Writes a shape as an object with its word: { "sphere": { "radius": 1 } }.
void writeShape(JsonWriter& out, const Shape& shape);

/// Throws InputError for a mesh without a file: the document has no other form for it.
void requireFiles(const Shape& shape, const std::string& where);

}  // namespace detail
}  // namespace carom

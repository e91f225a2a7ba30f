// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <string>

#include "adjoint/scene/shape.h"
#include "editing/distribution.h"

namespace carom {
struct Constraint;
struct Control;
struct Document;
}  // namespace carom

namespace carom::formats_detail {

class JsonWriter;

/// Writes a whole document as an object. Throws InputError for what the format cannot hold.
void writeDocument(JsonWriter& out, const Document& document);

void writeControl(JsonWriter& out, const Control& control);
/// Its members that say what varies: vary, body, material, impact, components.
void writeVaried(JsonWriter& out, const Control& control);

/// The member of a control that says how likely its values are.
void writeDistribution(JsonWriter& out, const Distribution& distribution);

/// Writes a shape as an object with its word: { "sphere": { "radius": 1 } }.
void writeShape(JsonWriter& out, const Shape& shape);
/// The same without its end, for members that follow.
void beginShape(JsonWriter& out, const Shape& shape);
/// Members that are left out at the origin, and where nothing is turned.
void writePlace(JsonWriter& out, const Vec3& position, const Quat& orientation);

/// Writes a constraint as an object, or as several where it has two targets of one kind.
void writeConstraint(JsonWriter& out, const Constraint& constraint);

// Both throw InputError starting at `where`.
void requireFinite(const std::string& where, double value);
/// What a document cannot say. The components that are left free are the only numbers that may be NaN.
void requireWritable(const Constraint& constraint, const std::string& where);
void requireWritable(const Distribution& distribution, const std::string& where);

/// Throws InputError for a mesh without a file: the document has no other form for it.
void requireFiles(Shape shape, const std::string& where);

}  // namespace carom::formats_detail

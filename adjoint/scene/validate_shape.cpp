// SPDX-License-Identifier: MIT
#include "adjoint/scene/validation.hpp"

namespace carom::validation {

void validateShape(const Place& where, const Body& body) {
  const Place shape = where / "shape";
  const char* derived = nullptr;
  if (!body.fixed) {
    if (std::holds_alternative<Plane>(body.shape)) fail(shape, "a moving plane", "\"fixed\": true");
    if (body.inertia.source == Inertia::Source::derived) derived = "inertia is to be derived from its volume";
    if (body.density) derived = "mass is to be derived from its volume";
  }
  const ShapeKind& kind = kindOf(body.shape);
  const Place word = shape / kind.name;
  kind.check(body.shape, {.where = word, .derived = derived});
}

}  // namespace carom::validation

// SPDX-License-Identifier: MIT
#include "adjoint/scene/validation.hpp"

namespace carom::validation {

void validateShape(const Place& where, const Body& body) {
  const Place shape = where / "shape";
  const char* derived = nullptr;
  const ShapeKind& kind = kindOf(body.shape);
  if (!body.fixed) {
    if (kind.endless) fail(shape, std::string("a moving ") + kind.name, "\"fixed\": true");
    if (body.inertia.source == Inertia::Source::derived) derived = "inertia is to be derived from its volume";
    if (body.density) derived = "mass is to be derived from its volume";
  }
  const Place word = shape / kind.name;
  kind.check(body.shape, {.where = word, .derived = derived});
}

}  // namespace carom::validation

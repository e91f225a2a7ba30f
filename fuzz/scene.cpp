// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <string>

#include "adjoint/scene/body_model.h"
#include "formats/documents/scene_json.h"
#include "fuzz/require.h"
#include "fuzz/targets.h"

namespace carom::fuzz {
namespace {

std::optional<Document> documentFrom(std::string_view bytes) try {
  return parseDocument(bytes, "fuzz");
} catch (const FormatError& error) {
  requireMessage(error);
  return std::nullopt;
}

void requireMassProperties(const Body& body) {
  if (body.fixed) return;
  const BodyModel model = modelOf(body);
  require(std::isfinite(model.mass) && model.mass > 0, "a mass > 0");
  require(model.inertia.allFinite() && (model.inertia.array() > 0).all(), "moments > 0");
  require(model.center.allFinite() && model.R_BG.allFinite(), "finite mass properties");
}

}  // namespace

void readScene(std::string_view bytes) {
  const std::optional<Document> document = documentFrom(bytes);
  if (!document) return;
  const std::string written = writeDocument(*document);
  require(writeDocument(parseDocument(written, "again")) == written, "what is written is read as what it was");
  for (const Body& body : document->scene.bodies) requireMassProperties(body);
}

}  // namespace carom::fuzz

// SPDX-License-Identifier: MIT
#include "explore/store/question.h"

#include <carom/version.h>

#include <string_view>
#include <variant>

#include "adjoint/scene/surface.h"
#include "explore/numbers/fnv.hpp"
#include "formats/documents/scene_json.h"

namespace carom {
namespace {

template <class T>
std::uint64_t hashOf(const std::vector<T>& entries) {
  return explore_detail::fnv({reinterpret_cast<const char*>(entries.data()), entries.size() * sizeof(T)});
}

std::string surfaceLine(const std::string& file, const Surface& surface) {
  return file + " " + std::to_string(hashOf(surface.vertices)) + " " + std::to_string(hashOf(surface.corners)) + "\n";
}

std::string filesOf(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape))
    return hull->file.empty() ? "" : surfaceLine(hull->file, *hull->surface);
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return surfaceLine(mesh->file, *mesh->surface);
  std::string lines;
  if (const auto* compound = std::get_if<Compound>(&shape))
    for (const CompoundPart& part : compound->parts) lines += filesOf(part.shape);
  return lines;
}

/// Without what is for readers alone.
Document plain(Document document) {
  document.name.clear(), document.notes.clear(), document.schema.clear();
  for (Body& body : document.scene.bodies) body.notes.clear();
  for (Material& material : document.scene.materials) material.notes.clear();
  for (Control& control : document.controls) control.notes.clear();
  for (Constraint& constraint : document.constraints) constraint.notes.clear();
  return document;
}

}  // namespace

std::string questionOf(const Document& document, const ExploreOptions& options) {
  std::string text = std::string("carom ") + kVersion + "\npoints " +
                     (options.points == Points::sobol ? "sobol" : "random") + "\nseed " + std::to_string(options.seed) +
                     "\ngradients " + (options.gradients ? "yes" : "no") + "\nstep_limit " +
                     std::to_string(options.step_limit) + "\n";
  for (const Body& body : document.scene.bodies) text += filesOf(body.shape);
  return text + writeDocument(plain(document));
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "formats/mesh/repair/mesh_repair.hpp"

#include <charconv>
#include <optional>

#include "adjoint/base/errors.h"
#include "formats/mesh/repair/loose_mesh.hpp"

namespace carom::formats_detail {

using namespace mesh_repair;

namespace {

/// Null, and why, where the triangles are not taken as they are.
std::shared_ptr<const Surface> asWritten(const TriangleSoup& soup, std::optional<InputError>& why) {
  try {
    return meshSurface(soup.vertices, soup.triangles);
  } catch (const InputError& error) {
    why = error;
    return nullptr;
  }
}

/// " (line 7)" for the place "triangle 3" of a file that has lines.
std::string lineOf(const std::vector<int>& lines, const std::string& where) {
  constexpr std::string_view kTriangle = "triangle ";
  if (where.rfind(kTriangle, 0) != 0) return {};
  std::size_t index = lines.size();
  std::from_chars(where.data() + kTriangle.size(), where.data() + where.size(), index);
  return index < lines.size() && lines[index] > 0 ? " (line " + std::to_string(lines[index]) + ")" : "";
}

bool refersToVertices(const TriangleSoup& soup) {
  const auto count = static_cast<int>(soup.vertices.size());
  for (const auto& triangle : soup.triangles)
    for (const int v : triangle)
      if (v < 0 || v >= count) return false;
  return true;
}

RepairedSurface repaired(const TriangleSoup& soup, bool solid) {
  LooseMesh mesh{soup.vertices, soup.triangles, soup.lines, {}};
  mesh.lines.resize(mesh.triangles.size(), 0);
  RepairedSurface out;
  dropUseless(mesh, out.repairs);
  weldBoundary(mesh, out.repairs);
  dropUseless(mesh, out.repairs);
  dropCovered(mesh, out.repairs);
  splitAtVertices(mesh, out.repairs);
  dropCovered(mesh, out.repairs);  // what the splits laid on each other
  turnAlike(mesh, out.repairs);
  pairEdges(mesh, out.repairs);
  if (solid) closeHoles(mesh, out.repairs), dropLoose(mesh, out.repairs);
  turnOutward(mesh, out.repairs);
  separateEdges(mesh);
  Repairs told;  // already
  for (int round = 0; round < 4 && hasCrowdedEdges(mesh); ++round) pairEdges(mesh, told), separateEdges(mesh);
  out.surface = meshSurface(mesh.vertices, mesh.triangles);
  return out;
}

}  // namespace

RepairedSurface surfaceOf(const TriangleSoup& soup, bool solid) {
  std::optional<InputError> why;
  RepairedSurface written{asWritten(soup, why), {}};
  if (written.surface && (!solid || written.surface->closed)) return written;
  std::string still;
  try {
    if (refersToVertices(soup) && !soup.triangles.empty()) {
      RepairedSurface mended = repaired(soup, solid);
      if (!written.surface || mended.surface->closed) return mended;
    }
  } catch (const InputError& error) {
    still = "; repaired as far as it can be: " + std::string(error.what());
  }
  if (!written.surface) throw InputError(why->where() + lineOf(soup.lines, why->where()), why->message() + still);
  return written;
}

}  // namespace carom::formats_detail

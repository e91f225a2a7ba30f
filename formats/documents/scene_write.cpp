// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/problem/controls/control_kinds.hpp"
#include "formats/documents/scene_json.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom {

using namespace editing_detail;
using namespace formats_detail;

namespace {

using Layout = JsonWriter::Layout;

const std::string& wordOf(Combine rule) { return combineWords()[static_cast<std::size_t>(rule)]; }

void writeMaterial(JsonWriter& out, const Material& m) {
  out.key(m.name).beginObject(Layout::line);
  out.members("elasticity", m.elasticity, "friction", m.friction, "tangential_elasticity", m.tangential_elasticity);
  if (m.combine_elasticity != Combine::average || m.combine_friction != Combine::average) {
    out.key("combine").beginObject();
    out.members("elasticity", wordOf(m.combine_elasticity), "friction", wordOf(m.combine_friction)).endObject();
  }
  out.unlessEmpty("notes", m.notes).endObject();
}

/// Entries to so many decimals.
Mat3 rounded(Mat3 matrix, int decimals) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      char text[400];
      std::snprintf(text, sizeof text, "%.*f", std::max(decimals, 0), matrix(i, j));
      matrix(i, j) = matrix(j, i) = std::strtod(text, nullptr) + 0.0;  // no -0
    }
  return matrix;
}

/// Entries to 15 digits of the largest one, below which they hold only the rounding of moments and axes, and to fewer
/// where that rounding alone is lost: so a matrix that a person wrote comes back as it was.
Mat3 roundedMatrix(const Inertia& inertia) {
  const Mat3 matrix = inertia.matrix();
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return matrix;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * largest;
  const int most = 14 - static_cast<int>(std::floor(std::log10(largest)));
  for (int decimals = most - 3; decimals < most; ++decimals)
    if (const Mat3 shorter = rounded(matrix, decimals); (shorter - matrix).cwiseAbs().maxCoeff() <= rounding)
      return shorter;
  return rounded(matrix, most);
}

void writeInertia(JsonWriter& out, const Inertia& inertia) {
  if (inertia.source == Inertia::Source::derived) return;
  if (inertia.source == Inertia::Source::moments) {
    out.members("inertia", inertia.moments);
    return;
  }
  const Mat3 matrix = roundedMatrix(inertia);
  out.members("inertia", std::array<Vec3, 3>{matrix.row(0), matrix.row(1), matrix.row(2)});
}

void writeFilter(JsonWriter& out, const CollisionFilter& filter) {
  if (filter.empty()) return;
  out.key("collision_filter").beginObject(Layout::line);
  out.unlessEmpty("systems", filter.systems).unlessEmpty("collide_with", filter.collide_with);
  out.unlessEmpty("not_collide_with", filter.not_collide_with).endObject();
}

void writeBody(JsonWriter& out, const Body& body) {
  out.members("name", body.name).unlessEmpty("notes", body.notes);
  if (body.fixed) out.members("fixed", true);
  if (body.kinematic) out.members("kinematic", true);
  if (body.gravity_factor != 1) out.members("gravity_factor", body.gravity_factor);
  writeFilter(out, body.collision_filter);
  out.unlessEmpty("material", body.material);
  if (body.mass) out.members("mass", *body.mass);
  if (body.density) out.members("density", *body.density);
  writeInertia(out, body.inertia);
  writeShape(out.key("shape"), body.shape);
  if (body.center_of_mass) out.members("center_of_mass", *body.center_of_mass);
  // A floor need not say that it lies at the origin.
  if (!body.fixed || !body.position.isZero(0)) out.members("position", body.position);
  if (!body.fixed || body.orientation.coeffs() != Quat::Identity().coeffs())
    out.members("orientation", body.orientation);
  if (!body.fixed) out.members("velocity", body.velocity, "angular_velocity", body.angular_velocity);
  if (!body.surface_velocity.isZero(0)) out.members("surface_velocity", body.surface_velocity);
  if (!body.surface_angular_velocity.isZero(0)) out.members("surface_angular_velocity", body.surface_angular_velocity);
}

void writeBound(JsonWriter& out, const char* member, const std::vector<double>& bound) {
  if (bound.size() == 1)
    out.members(member, bound[0]);
  else
    out.unlessEmpty(member, bound);
}

/// What `validate` does not see. The components that a constraint leaves free are the only numbers that may be NaN.
void requireWritableDocument(const Document& document) {
  validate(document.scene);
  for (std::size_t i = 0; i < document.scene.bodies.size(); ++i)
    requireFiles(document.scene.bodies[i].shape, "/bodies/" + std::to_string(i) + "/shape");
  requireFinite("/duration", document.duration);
  for (std::size_t i = 0; i < document.controls.size(); ++i) {
    const Control& control = document.controls[i];
    const std::string where = "/controls/" + std::to_string(i);
    for (const double bound : control.min) requireFinite(where + "/min", bound);
    for (const double bound : control.max) requireFinite(where + "/max", bound);
    requireFinite(where + "/weight", control.weight);
    if (control.distribution) requireWritable(*control.distribution, where + "/distribution");
  }
  for (std::size_t i = 0; i < document.constraints.size(); ++i)
    requireWritable(document.constraints[i], "/constraints/" + std::to_string(i));
}

}  // namespace

void formats_detail::writeVaried(JsonWriter& out, const Control& control) {
  const ControlKind* kind = findControlKind(control.vary);
  out.members("vary", control.vary).unlessEmpty("body", control.body).unlessEmpty("material", control.material);
  if (kind != nullptr && kind->owner == OwnerKind::impact) out.members("impact", control.impact);
  out.unlessEmpty("components", control.components);
}

void formats_detail::writeControl(JsonWriter& out, const Control& control) {
  out.beginObject(Layout::line);
  writeVaried(out, control);
  writeBound(out, "min", control.min);
  writeBound(out, "max", control.max);
  if (control.weight != 1) out.members("weight", control.weight);
  if (control.distribution) writeDistribution(out, *control.distribution);
  out.unlessEmpty("notes", control.notes).endObject();
}

void formats_detail::writeDocument(JsonWriter& out, const Document& document) {
  requireWritableDocument(document);
  const Scene& scene = document.scene;
  out.beginObject().unlessEmpty("$schema", document.schema).members("carom", 1);
  out.unlessEmpty("name", document.name).unlessEmpty("notes", document.notes);
  out.members("gravity", scene.gravity, "duration", document.duration);
  if (!scene.materials.empty()) {
    out.key("materials").beginObject();
    for (const Material& material : scene.materials) writeMaterial(out, material);
    out.endObject();
  }
  const auto list = [&](const char* member, const auto& items, auto write) {
    if (items.empty()) return;
    out.key(member).beginArray();
    for (const auto& item : items) write(out, item);
    out.endArray();
  };
  if (!scene.bodies.empty())
    out.objects("bodies", scene.bodies, Layout::block, [&](const Body& body) { writeBody(out, body); });
  if (!scene.tilts.empty())
    out.objects("tilts", scene.tilts, Layout::line,
                [&](const Tilt& tilt) { out.members("body", tilt.body, "impact", tilt.impact, "value", tilt.value); });
  list("controls", document.controls, formats_detail::writeControl);
  list("constraints", document.constraints, writeConstraint);
  out.endObject();
}

std::string writeDocument(const Document& document) {
  JsonWriter out;
  writeDocument(out, document);
  return out.take();
}

}  // namespace carom

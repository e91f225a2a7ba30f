// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

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

void writeText(JsonWriter& out, const char* member, const std::string& text) {
  if (!text.empty()) out.key(member).text(text);
}

void writeMaterial(JsonWriter& out, const Material& m) {
  out.key(m.name).beginObject(Layout::line);
  out.key("elasticity").number(m.elasticity);
  out.key("friction").number(m.friction);
  out.key("tangential_elasticity").number(m.tangential_elasticity);
  if (m.combine_elasticity != Combine::average || m.combine_friction != Combine::average) {
    out.key("combine").beginObject();
    out.key("elasticity").text(wordOf(m.combine_elasticity));
    out.key("friction").text(wordOf(m.combine_friction));
    out.endObject();
  }
  writeText(out, "notes", m.notes);
  out.endObject();
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
  out.key("inertia");
  if (inertia.source == Inertia::Source::moments) {
    out.vector(inertia.moments);
    return;
  }
  const Mat3 matrix = roundedMatrix(inertia);
  out.beginArray(Layout::line);
  for (int i = 0; i < 3; ++i) out.vector(matrix.row(i));
  out.endArray();
}

void writeFilter(JsonWriter& out, const CollisionFilter& filter) {
  if (filter.empty()) return;
  out.key("collision_filter").beginObject(Layout::line);
  const auto names = [&](const char* member, const std::vector<std::string>& list) {
    if (!list.empty()) out.key(member).texts(list);
  };
  names("systems", filter.systems);
  names("collide_with", filter.collide_with);
  names("not_collide_with", filter.not_collide_with);
  out.endObject();
}

void writeBody(JsonWriter& out, const Body& body) {
  out.beginObject();
  out.key("name").text(body.name);
  writeText(out, "notes", body.notes);
  if (body.fixed) out.key("fixed").boolean(true);
  if (body.kinematic) out.key("kinematic").boolean(true);
  if (body.gravity_factor != 1) out.key("gravity_factor").number(body.gravity_factor);
  writeFilter(out, body.collision_filter);
  writeText(out, "material", body.material);
  if (body.mass) out.key("mass").number(*body.mass);
  if (body.density) out.key("density").number(*body.density);
  writeInertia(out, body.inertia);
  writeShape(out.key("shape"), body.shape);
  if (body.center_of_mass) out.key("center_of_mass").vector(*body.center_of_mass);
  // A floor need not say that it lies at the origin.
  if (!body.fixed || !body.position.isZero(0)) out.key("position").vector(body.position);
  if (!body.fixed || body.orientation.coeffs() != Quat::Identity().coeffs())
    out.key("orientation").quaternion(body.orientation);
  if (!body.fixed) {
    out.key("velocity").vector(body.velocity);
    out.key("angular_velocity").vector(body.angular_velocity);
  }
  out.endObject();
}

void writeTilt(JsonWriter& out, const Tilt& tilt) {
  out.beginObject(Layout::line);
  out.key("body").text(tilt.body);
  out.key("impact").integer(tilt.impact);
  out.key("value").numbers({tilt.value.data(), 2});
  out.endObject();
}

void writeBound(JsonWriter& out, const char* member, const std::vector<double>& bound) {
  if (bound.empty()) return;
  out.key(member);
  if (bound.size() == 1) {
    out.number(bound[0]);
  } else {
    out.numbers(bound);
  }
}

void writeControlObject(JsonWriter& out, const Control& control) {
  const ControlKind* kind = findControlKind(control.vary);
  out.beginObject(Layout::line);
  out.key("vary").text(control.vary);
  writeText(out, "body", control.body);
  writeText(out, "material", control.material);
  if (kind != nullptr && kind->owner == OwnerKind::impact) out.key("impact").integer(control.impact);
  if (!control.components.empty()) out.key("components").texts(control.components);
  writeBound(out, "min", control.min);
  writeBound(out, "max", control.max);
  if (control.weight != 1) out.key("weight").number(control.weight);
  writeText(out, "notes", control.notes);
  out.endObject();
}

template <class Items, class Write>
void writeList(JsonWriter& out, const char* member, const Items& items, Write write) {
  if (items.empty()) return;
  out.key(member).beginArray();
  for (const auto& item : items) write(out, item);
  out.endArray();
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
  }
  for (std::size_t i = 0; i < document.constraints.size(); ++i)
    requireWritable(document.constraints[i], "/constraints/" + std::to_string(i));
}

}  // namespace

void formats_detail::writeControl(JsonWriter& out, const Control& control) { writeControlObject(out, control); }

void formats_detail::writeDocument(JsonWriter& out, const Document& document) {
  requireWritableDocument(document);
  out.beginObject();
  writeText(out, "$schema", document.schema);
  out.key("carom").integer(1);
  writeText(out, "name", document.name);
  writeText(out, "notes", document.notes);
  out.key("gravity").vector(document.scene.gravity);
  out.key("duration").number(document.duration);
  if (!document.scene.materials.empty()) {
    out.key("materials").beginObject();
    for (const Material& material : document.scene.materials) writeMaterial(out, material);
    out.endObject();
  }
  writeList(out, "bodies", document.scene.bodies, writeBody);
  writeList(out, "tilts", document.scene.tilts, writeTilt);
  writeList(out, "controls", document.controls, writeControlObject);
  writeList(out, "constraints", document.constraints, writeConstraint);
  out.endObject();
}

std::string writeDocument(const Document& document) {
  JsonWriter out;
  writeDocument(out, document);
  return out.take();
}

}  // namespace carom

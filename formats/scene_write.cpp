#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "adjoint/errors.h"
#include "editing/control_kinds.h"
#include "formats/detail/scene_reader.hpp"
#include "formats/detail/scene_writer.hpp"
#include "formats/json_writer.h"
#include "formats/scene_json.h"

namespace carom {
namespace {

using Layout = JsonWriter::Layout;

const std::string& wordOf(Combine rule) { return detail::combineWords()[static_cast<std::size_t>(rule)]; }

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
  out.endObject();
}

/// Entries to 15 digits of the largest one: below that they hold only the rounding of moments and axes, and a matrix
/// that a person wrote comes back as it was.
Mat3 roundedMatrix(const Inertia& inertia) {
  Mat3 matrix = inertia.matrix();
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return matrix;
  const int decimals = 14 - static_cast<int>(std::floor(std::log10(largest)));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      char text[400];
      std::snprintf(text, sizeof text, "%.*f", std::max(decimals, 0), matrix(i, j));
      matrix(i, j) = matrix(j, i) = std::strtod(text, nullptr) + 0.0;  // no -0
    }
  return matrix;
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

void writeBody(JsonWriter& out, const Body& body) {
  out.beginObject();
  out.key("name").text(body.name);
  if (body.fixed) out.key("fixed").boolean(true);
  if (!body.material.empty()) out.key("material").text(body.material);
  if (body.mass) out.key("mass").number(*body.mass);
  if (body.density) out.key("density").number(*body.density);
  writeInertia(out, body.inertia);
  detail::writeShape(out.key("shape"), body.shape);
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

void writeControl(JsonWriter& out, const Control& control) {
  const ControlKind* kind = findControlKind(control.vary);
  out.beginObject(Layout::line);
  out.key("vary").text(control.vary);
  if (!control.body.empty()) out.key("body").text(control.body);
  if (!control.material.empty()) out.key("material").text(control.material);
  if (kind != nullptr && kind->owner == OwnerKind::impact) out.key("impact").integer(control.impact);
  if (!control.components.empty()) out.key("components").texts(control.components);
  writeBound(out, "min", control.min);
  writeBound(out, "max", control.max);
  if (control.weight != 1) out.key("weight").number(control.weight);
  out.endObject();
}

void writeWhen(JsonWriter& out, const When& at) {
  out.key("at");
  if (at.impact == 0) {
    out.number(at.time);
    return;
  }
  out.beginObject().key("impact").integer(at.impact);
  if (!at.with.empty()) out.key("with").text(at.with);
  out.endObject();
}

void writeTarget(JsonWriter& out, const Target& target) {
  out.key(target.quantity);
  if (target.quantity == "time") {
    out.number(target.value.at(0));
  } else if (target.quantity == "point") {
    out.beginObject().key("body_point").vector(target.body_point).key("world").numbers(target.value).endObject();
  } else {
    out.numbers(target.value);
  }
}

/// Members of an object differ, so that targets of one kind need objects of their own.
void writeConstraint(JsonWriter& out, const Constraint& constraint) {
  std::vector<const Target*> left;
  for (const Target& target : constraint.targets) left.push_back(&target);
  while (!left.empty()) {
    out.beginObject(Layout::line);
    out.key("body").text(constraint.body);
    writeWhen(out, constraint.at);
    std::vector<const Target*> written, next;
    for (const Target* target : left) {
      const bool again =
          std::any_of(written.begin(), written.end(), [&](auto* w) { return w->quantity == target->quantity; });
      if (!again) writeTarget(out, *target);
      (again ? next : written).push_back(target);
    }
    out.endObject();
    left = std::move(next);
  }
}

template <class Items, class Write>
void writeList(JsonWriter& out, const char* member, const Items& items, Write write) {
  if (items.empty()) return;
  out.key(member).beginArray();
  for (const auto& item : items) write(out, item);
  out.endArray();
}

void requireFinite(const std::string& where, double value) {
  if (!std::isfinite(value)) throw InputError(where, "found a number that is not finite, expected a number");
}

/// What `validate` does not see. The components that a constraint leaves free are the only numbers that may be NaN.
void requireWritable(const Document& document) {
  validate(document.scene);
  for (std::size_t i = 0; i < document.scene.bodies.size(); ++i)
    detail::requireFiles(document.scene.bodies[i].shape, "/bodies/" + std::to_string(i) + "/shape");
  requireFinite("/duration", document.duration);
  for (std::size_t i = 0; i < document.controls.size(); ++i) {
    const Control& control = document.controls[i];
    const std::string where = "/controls/" + std::to_string(i);
    for (const double bound : control.min) requireFinite(where + "/min", bound);
    for (const double bound : control.max) requireFinite(where + "/max", bound);
    requireFinite(where + "/weight", control.weight);
  }
  for (std::size_t i = 0; i < document.constraints.size(); ++i) {
    const std::string where = "/constraints/" + std::to_string(i);
    requireFinite(where + "/at", document.constraints[i].at.time);
    for (const Target& target : document.constraints[i].targets) {
      if (target.quantity == "time" && target.value.size() != 1)
        throw InputError(where + "/time", "found " + std::to_string(target.value.size()) + " numbers, expected 1");
      for (const double value : target.value)
        if (std::isinf(value)) requireFinite(where + "/" + target.quantity, value);
      for (const double value : target.body_point) requireFinite(where + "/" + target.quantity + "/body_point", value);
    }
  }
}

}  // namespace

std::string writeDocument(const Document& document) {
  requireWritable(document);
  JsonWriter out;
  out.beginObject();
  out.key("carom").integer(1);
  out.key("gravity").vector(document.scene.gravity);
  out.key("duration").number(document.duration);
  if (!document.scene.materials.empty()) {
    out.key("materials").beginObject();
    for (const Material& material : document.scene.materials) writeMaterial(out, material);
    out.endObject();
  }
  writeList(out, "bodies", document.scene.bodies, writeBody);
  writeList(out, "tilts", document.scene.tilts, writeTilt);
  writeList(out, "controls", document.controls, writeControl);
  writeList(out, "constraints", document.constraints, writeConstraint);
  out.endObject();
  return out.take();
}

}  // namespace carom

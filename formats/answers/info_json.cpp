// SPDX-License-Identifier: MIT
#include "formats/answers/info_json.h"

#include "adjoint/scene/body_model.h"
#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

namespace {

void writeShapeOf(JsonWriter& out, const Body& body) {
  const ShapeKind& kind = kindOf(body.shape);
  out.key("shape").text(kind.name);
  const std::vector<std::string> names = kind.dimension_names(body.shape);
  const Eigen::VectorXd values = kind.dimensions(body.shape);
  out.key("dimensions").beginObject(JsonWriter::Layout::line);
  for (std::size_t i = 0; i < names.size(); ++i) out.key(names[i]).number(values[static_cast<Eigen::Index>(i)]);
  out.endObject();
}

void writeMassProperties(JsonWriter& out, const Body& body) {
  if (body.fixed) return;
  const BodyModel model = modelOf(body);
  if (!body.kinematic) out.key("mass").number(model.mass);
  out.key("center_of_mass").vector(model.center);
  if (body.kinematic) return;
  out.key("moments").vector(model.inertia);
}

void writeFilter(JsonWriter& out, const CollisionFilter& filter) {
  if (filter.empty()) return;
  out.key("collision_filter").beginObject();
  out.key("systems").texts(filter.systems);
  out.key("collide_with").texts(filter.collide_with);
  out.key("not_collide_with").texts(filter.not_collide_with);
  out.endObject();
}

void writeBody(JsonWriter& out, const Body& body, const BodyPlan& plan) {
  out.beginObject();
  out.key("name").text(body.name);
  if (!body.notes.empty()) out.key("notes").text(body.notes);
  writeShapeOf(out, body);
  writeMassProperties(out, body);
  if (body.kinematic) out.key("kinematic").boolean(true);
  if (body.gravity_factor != 1) out.key("gravity_factor").number(body.gravity_factor);
  writeFilter(out, body.collision_filter);
  out.key("tier").text(nameOf(plan.tier));
  out.key("why").text(plan.why);
  out.key("derivative_tier").text(nameOf(plan.derivative_tier));
  out.key("derivative_why").text(plan.derivative_why);
  out.endObject();
}

void writePair(JsonWriter& out, const Scene& scene, const ScenePlan::Pair& pair) {
  const auto nameAt = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].name; };
  out.beginObject();
  out.key("bodies").texts({nameAt(pair.a), nameAt(pair.b)});
  out.key("law").text(pair.law == Law::friction ? "friction" : "frictionless");
  out.key("why").text(pair.why);
  out.key("elasticity").number(pair.coefficients.elasticity);
  out.key("friction").number(pair.coefficients.friction);
  out.key("tangential_elasticity").number(pair.coefficients.tangential_elasticity);
  out.endObject();
}

}  // namespace

std::string infoJson(const Scene& scene, const ScenePlan& plan) {
  JsonWriter out;
  const auto textOrNull = [&](const char* member, const std::string& text) {
    out.key(member);
    text.empty() ? out.null() : out.text(text);
  };
  out.beginObject();
  textOrNull("name", plan.name);
  textOrNull("notes", plan.notes);
  out.key("duration").number(plan.duration);
  out.key("asked").text(plan.asked);
  out.key("bodies").beginArray();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) writeBody(out, scene.bodies[i], plan.plan.bodies[i]);
  out.endArray();
  out.key("overlaps").beginArray();
  for (const StartOverlap& overlap : plan.overlaps) {
    const auto nameAt = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].name; };
    out.beginObject(JsonWriter::Layout::line);
    out.key("bodies").texts({nameAt(overlap.a), nameAt(overlap.b)});
    out.key("depth").number(overlap.depth);
    out.endObject();
  }
  out.endArray();
  out.key("pairs").beginArray();
  for (const ScenePlan::Pair& pair : plan.pairs) writePair(out, scene, pair);
  out.endArray();
  out.key("controls").integer(plan.controls);
  out.key("rows").integer(plan.rows);
  out.endObject();
  return out.take();
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "formats/answers/info_json.hpp"

#include "adjoint/scene/body_model.h"
#include "formats/answers/status_json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

namespace {

using Layout = JsonWriter::Layout;

void writeShapeOf(JsonWriter& out, const Body& body) {
  const ShapeKind& kind = kindOf(body.shape);
  const std::vector<std::string> names = kind.dimension_names(body.shape);
  const Eigen::VectorXd values = kind.dimensions(body.shape);
  out.members("shape", kind.name).key("dimensions").beginObject(Layout::line);
  for (std::size_t i = 0; i < names.size(); ++i) out.members(names[i], values[static_cast<Eigen::Index>(i)]);
  out.endObject();
}

void writeMassProperties(JsonWriter& out, const Body& body) {
  if (body.fixed) return;
  const BodyModel model = modelOf(body);
  if (!body.kinematic) out.members("mass", model.mass);
  out.members("center_of_mass", model.center);
  if (!body.kinematic) out.members("moments", model.inertia);
}

void writeFilter(JsonWriter& out, const CollisionFilter& filter) {
  if (filter.empty()) return;
  out.key("collision_filter").beginObject();
  out.members("systems", filter.systems, "collide_with", filter.collide_with);
  out.members("not_collide_with", filter.not_collide_with).endObject();
}

void writeLasting(JsonWriter& out, const ScenePlan::Lasting& lasting) {
  if (lasting.kinds.empty()) return;
  std::vector<std::string> kinds;
  for (const ArcKind kind : lasting.kinds) kinds.push_back(nameOf(kind));
  out.members("lasting_contact", kinds, "lasting_contact_ends", lasting.ends);
}

void writeBodyPlan(JsonWriter& out, const Body& body, const BodyPlan& plan, const ScenePlan::Lasting& lasting) {
  out.members("name", body.name).unlessEmpty("notes", body.notes);
  writeShapeOf(out, body);
  writeMassProperties(out, body);
  if (body.kinematic) out.members("kinematic", true);
  if (body.gravity_factor != 1) out.members("gravity_factor", body.gravity_factor);
  if (body.surfaceMoves())
    out.members("surface_velocity", body.surface_velocity, "surface_angular_velocity", body.surface_angular_velocity);
  writeFilter(out, body.collision_filter);
  out.members("tier", nameOf(plan.tier), "why", plan.why);
  out.members("derivative_tier", nameOf(plan.derivative_tier), "derivative_why", plan.derivative_why);
  writeLasting(out, lasting);
}

}  // namespace

std::string infoJson(const Document& document, const ScenePlan& plan) {
  const Scene& scene = document.scene;
  const auto names = [&](const auto& pair) {
    const auto name = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].name; };
    return std::array{name(pair.a), name(pair.b)};
  };
  JsonWriter out;
  out.beginObject();
  out.members("name", textOrNone(document.name), "notes", textOrNone(document.notes));
  out.members("duration", document.duration, "asked", plan.asked);
  std::size_t i = 0;
  out.objects("bodies", scene.bodies, Layout::block, [&](const Body& body) {
    writeBodyPlan(out, body, plan.plan.bodies[i], plan.lasting[i]);
    ++i;
  });
  out.objects("components", plan.components, Layout::line, [&](const ScenePlan::Component& component) {
    std::vector<std::string> bodies;
    for (const int body : component.bodies) bodies.push_back(scene.bodies[static_cast<std::size_t>(body)].name);
    out.members("bodies", bodies, "rests", component.rests, "why", component.why);
  });
  out.objects("overlaps", plan.overlaps, Layout::line,
              [&](const StartOverlap& overlap) { out.members("bodies", names(overlap), "depth", overlap.depth); });
  writeRepairs(out, document);
  out.objects("pairs", plan.pairs, Layout::block, [&](const ScenePlan::Pair& pair) {
    out.members("bodies", names(pair), "law", pair.law == Law::friction ? "friction" : "frictionless");
    out.members("why", pair.why, "elasticity", pair.coefficients.elasticity, "friction", pair.coefficients.friction);
    out.members("tangential_elasticity", pair.coefficients.tangential_elasticity);
  });
  out.members("controls", plan.controls, "rows", plan.rows);
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail

// SPDX-License-Identifier: MIT
#include "adjoint/constrained/contact_columns.hpp"

#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void ContactColumns::addSupport(const SupportColumns& columns, const Support& support, double t) {
  Supporting& added = supports_.emplace_back(Supporting{columns, std::nullopt});
  if (support.moves() && !support.isGiven()) added.start.emplace(fromSceneStart(motion_, columns.body, support, t));
}

void ContactColumns::addFriction(int column, int a, int b) {
  const Scene& scene = *motion_.scene;
  const Rule<double> rule = rulesOf(materialOf(scene, scene.bodies[at(a)]), materialOf(scene, scene.bodies[at(b)])).friction;
  friction_.push_back({column, materialIndexOf(scene, a), materialIndexOf(scene, b), rule.by_a, rule.by_b});
}

void ContactColumns::tangent(const SceneTangent& dscene, Eigen::VectorXd& d) const {
  for (const auto& [columns, start] : supports_) {
    const BodyDerivative& body = dscene.bodies[at(columns.body)];
    if (columns.velocity < 0) {
      d.segment<3>(columns.pose) = body.position;
      d.segment<3>(columns.pose + 3) = body.orientation;
    } else if (start) {
      const StateDerivative start_of = start->tangent(body);
      d.segment<6>(columns.pose) << start_of.x, start_of.theta;
      d.segment<6>(columns.velocity) << start_of.v, start_of.L;
    }
    if (columns.surface >= 0) d.segment<6>(columns.surface) << body.surface_velocity, body.surface_angular_velocity;
    d.segment(columns.sizes, columns.size_count) = body.size;
  }
  const auto of = [&](int m) { return m < 0 ? 0 : dscene.materials[at(m)].friction; };
  for (const Friction& f : friction_) d[f.column] = f.by_a * of(f.a) + f.by_b * of(f.b);
}

void ContactColumns::pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar) const {
  for (const auto& [columns, start] : supports_) {
    BodyDerivative& body = scene_bar.bodies[at(columns.body)];
    if (columns.velocity < 0) {
      body.position += bar.segment<3>(columns.pose);
      body.orientation += bar.segment<3>(columns.pose + 3);
    } else if (start) {
      Eigen::Matrix<double, 12, 1> at_start;
      at_start << bar.segment<6>(columns.pose), bar.segment<6>(columns.velocity);
      start->pullback(asState(at_start), body);
    }
    if (columns.surface >= 0) {
      body.surface_velocity += bar.segment<3>(columns.surface);
      body.surface_angular_velocity += bar.segment<3>(columns.surface + 3);
    }
    if (columns.size_count > 0) body.size += bar.segment(columns.sizes, columns.size_count);
  }
  for (const Friction& f : friction_) {
    if (f.a >= 0) scene_bar.materials[at(f.a)].friction += f.by_a * bar[f.column];
    if (f.b >= 0) scene_bar.materials[at(f.b)].friction += f.by_b * bar[f.column];
  }
}

}  // namespace carom::adjoint_detail

// SPDX-License-Identifier: MIT
// Ghosts and nails of exported glTF: nodes without physics.
#include <tiny_gltf.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "formats/base/short_text.hpp"
#include "formats/drawing/motion_extent.hpp"
#include "formats/drawing/nail_marks.hpp"
#include "formats/gltf/write/stage.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

namespace {

constexpr double kGhostAlpha = 0.25, kPoseAlpha = 0.5, kRegionAlpha = 0.2;
constexpr double kBallShare = 0.15;  // of a nail's ball in the radius of its body
constexpr Colour kNail{0.07, 0.57, 0.31}, kAvoid{0.76, 0.25, 0.05};

/// One node above others, so that they can be hidden together; none where there is nothing below.
std::vector<int> grouped(tinygltf::Model& model, const std::string& name, std::vector<int> children) {
  if (children.empty()) return {};
  tinygltf::Node node;
  node.name = name;
  node.children = std::move(children);
  return {append(model.nodes, node)};
}

int addNode(tinygltf::Model& model, const std::string& name, int mesh, const Vec3& x, const Quat& q) {
  tinygltf::Node node;
  node.name = name;
  node.mesh = mesh;
  setPose(node, x, q);
  return append(model.nodes, node);
}

int addRegion(tinygltf::Model& model, GltfLook& look, const RegionMark& region) {
  const bool avoid = region.side == Region::Side::avoid;
  const int mesh = look.shape(region.shape, region.label, {avoid ? kAvoid : kNail, kRegionAlpha, 0.9, true});
  return addNode(model, region.label, mesh, region.position, region.orientation);
}

}  // namespace

std::vector<int> addGhosts(tinygltf::Model& model, GltfLook& look, const Motion& motion, double interval) {
  const auto& bodies = motion.scene->bodies;
  const auto moving = static_cast<double>(movingCount(*motion.scene));
  const double times = std::floor(motion.end / interval * (1 + 1e-12)) + 1;
  if (!(times * moving <= kMaxGhosts))
    throw InputError("ghosts", "found " + numberText(interval) + " s between ghosts, which makes " +
                                   numberText(times * moving) + " of them, expected at most " + numberText(kMaxGhosts));
  std::vector<int> ghosts;
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    if (bodies[static_cast<std::size_t>(body)].fixed) continue;
    const int mesh = look.body(body, kGhostAlpha);
    for (double k = 0; k < times; ++k) {
      const double t = std::min(k * interval, motion.end);
      const BodyState state = motion.stateAt(body, t);
      const std::string name = bodies[static_cast<std::size_t>(body)].name + " at " + shortNumber(t) + " s";
      ghosts.push_back(addNode(model, name, mesh, state.position, state.orientation));
    }
  }
  return grouped(model, "ghosts", std::move(ghosts));
}

std::vector<int> addNails(tinygltf::Model& model, GltfLook& look, const Document& document, const Motion& motion) {
  std::vector<int> marks;
  for (const NailMark& nail : nailsOf(document, motion)) {
    const Body& body = motion.scene->bodies[static_cast<std::size_t>(nail.body)];
    if (nail.place) {
      const Sphere ball{kBallShare * radiusAbout(body.shape, Vec3::Zero())};
      marks.push_back(addNode(model, nail.label, look.shape(ball, nail.label, {kNail}), *nail.place, Quat::Identity()));
    }
    if (nail.orientation && nail.pose_origin) {
      const int mesh = look.shape(body.shape, nail.label + " pose", {kNail, kPoseAlpha});
      marks.push_back(addNode(model, nail.label + " pose", mesh, *nail.pose_origin, *nail.orientation));
    }
  }
  for (const RegionMark& region : regionsOf(document)) marks.push_back(addRegion(model, look, region));
  return grouped(model, "nails", std::move(marks));
}

}  // namespace carom::formats_detail

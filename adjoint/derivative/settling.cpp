// SPDX-License-Identifier: MIT
#include "adjoint/derivative/settling.h"

#include <variant>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/base/refuse.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/motion/pair_rules.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

/// Its derivatives: by the time and the velocity of the event, which are those of a reading, and by what of the scene
/// stands in the formula itself.
struct Settling {
  StateSeed seed;
  SceneGradient direct;
};

// The first bounce of the cascade that ends with an event: between the same features, with nothing else in between, and
// with impulses along the normal, so that each bounce takes the same share of the speed.
int firstBounce(const Motion& motion, int index) {
  const auto eventOf = [&](int e) -> const Event& { return motion.events[static_cast<std::size_t>(e)]; };
  const Contact& last = eventOf(index).contacts[0];
  const WorldLine& line = motion.world_lines[static_cast<std::size_t>(eventOf(index).participants[0].body)];
  for (int arc = eventOf(index).participants[0].arc; arc > 0; --arc) {
    const int earlier = line.events[static_cast<std::size_t>(arc) - 1];
    const Event& event = eventOf(earlier);
    const Contact& c = event.contacts[0];
    if (event.kind != EventKind::impact || event.contacts.size() > 1 || c.a != last.a || c.b != last.b ||
        !(c.features == last.features) || c.tilt_a >= 0 || c.tilt_b >= 0)
      break;
    index = earlier;
  }
  return index;
}

// Of the one contact, whether d(normal) has nothing of the ball: then its normal is that of a flat face.
bool isFlat(const ContactJacobian& J, bool is_a) { return J.pose.block<3, 6>(1, is_a ? 0 : 6).isZero(0); }

Settling settlingOf(const Motion& motion, int index) {
  if (!motion.events[checkedIndex("settlesAt", "event", index, motion.events.size())].settles_at)
    refuse("settlesAt", "found event ", index, ", which has no settles_at, expected one that has");
  index = firstBounce(motion, index);
  const Event& event = motion.events[static_cast<std::size_t>(index)];
  const Contact& c = event.contacts[0];
  const Scene& scene = *motion.scene;
  const Participant& p = event.participants[0];
  const bool is_a = p.body == c.a;
  const auto body = static_cast<std::size_t>(p.body), face = static_cast<std::size_t>(is_a ? c.b : c.a);
  const BodyModel& model = (*motion.models)[body];
  const ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, poseBefore(motion, event, c.a),
                                                      poseBefore(motion, event, c.b));
  if (!std::holds_alternative<Sphere>(scene.bodies[body].shape) || !model.center.isZero(0) ||
      !scene.bodies[face].fixed || !isFlat(J, is_a))
    throw NotComputable(textOf(6, "the derivative of the time at which '", scene.bodies[body].name, "' settles on '",
                               scene.bodies[face].name, "' exists for balls on flat faces of fixed bodies only"));

  const Material &of_a = materialOf(scene, scene.bodies[static_cast<std::size_t>(c.a)]),
                 &of_b = materialOf(scene, scene.bodies[static_cast<std::size_t>(c.b)]);
  const PairRules<double> rules = rulesOf(of_a, of_b);
  const double e = rules.elasticity.value, bounces = 2 * e / (1 - e);
  const Vec3 n = (is_a ? 1 : -1) * c.at.normal, G = model.gravity_factor * scene.gravity;
  const double pull = n.dot(G), q = n.dot(p.before.v) / pull;

  Settling out{{}, SceneGradient(scene)};
  out.seed.body = p.body;
  out.seed.at = Instant::before(index);
  out.seed.velocity = bounces / pull * n;
  out.seed.time = 1;
  const Vec3 by_normal = (is_a ? 1 : -1) * bounces / pull * (p.before.v - q * G);
  out.direct.gravity = -bounces * q / pull * model.gravity_factor * n;
  BodyDerivative& fixed = out.direct.bodies[face];
  const auto by_face = J.pose.block<3, 6>(1, is_a ? 6 : 0);
  fixed.position += by_face.leftCols<3>().transpose() * by_normal;
  fixed.orientation += by_face.rightCols<3>().transpose() * by_normal;
  const auto& sizes = is_a ? J.size_b : J.size_a;
  if (sizes.cols() > 0) fixed.size += sizes.middleRows<3>(1).transpose() * by_normal;
  MaterialDerivative unused;
  const auto slot = [&](int b) -> MaterialDerivative& {
    const int m = materialIndexOf(scene, b);
    return m < 0 ? unused : out.direct.materials[static_cast<std::size_t>(m)];
  };
  rules.pullback({2 * q / ((1 - e) * (1 - e)), 0, 0}, slot(c.a), slot(c.b));
  return out;
}

void add(SceneGradient& sum, const SceneGradient& more) {
  sum.gravity += more.gravity;
  for (std::size_t m = 0; m < sum.materials.size(); ++m) sum.materials[m].elasticity += more.materials[m].elasticity;
  for (std::size_t b = 0; b < sum.bodies.size(); ++b) {
    sum.bodies[b].position += more.bodies[b].position;
    sum.bodies[b].orientation += more.bodies[b].orientation;
    sum.bodies[b].size += more.bodies[b].size;
  }
}

}  // namespace

SceneGradient settlesAtGradient(DerivativeTape& tape, int event, Reliability* reliability) {
  const Settling settling = settlingOf(tape.motion(), event);
  SceneGradient gradient = adjoint(tape, std::span(&settling.seed, 1), reliability);
  add(gradient, settling.direct);
  return gradient;
}

double settlesAtRate(DerivativeTape& tape, const SceneTangent& direction, int event) {
  const Settling settling = settlingOf(tape.motion(), event);
  return tangent(tape, direction).at(settling.seed.body, settling.seed.at).dot(settling.seed) +
         settling.direct.dot(direction);
}

}  // namespace carom

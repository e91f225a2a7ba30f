// SPDX-License-Identifier: MIT
#include "adjoint/contact/closed_path_linearization.hpp"

#include <vector>

#include "adjoint/contact/block_spin.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {
namespace {

std::size_t placeOf(int i) { return static_cast<std::size_t>(i); }

const Material& materialOfBody(const Scene& scene, int body) { return materialOf(scene, scene.bodies[placeOf(body)]); }

}  // namespace

ClosedPathLinearization::ClosedPathLinearization(const Motion& motion, const ContactPath& path, int k, double elapsed)
    : motion_(motion),
      path_(path),
      friction_(rulesOf(materialOfBody(*motion.scene, path.body), materialOfBody(*motion.scene, path.face)).friction),
      k_(k),
      elapsed_(elapsed),
      orientation_(motion.plan.bodies[placeOf(path.body)].derivative_tier != Tier::none) {}

PathInputsDerivative<double> ClosedPathLinearization::inputs(const SceneTangent& dscene,
                                                             const BodyModelDerivative& dmodel) const {
  PathInputsDerivative<double> d;
  const auto friction_of = [&](int body) {
    const int m = materialIndexOf(*motion_.scene, body);
    return m < 0 ? 0 : dscene.materials[placeOf(m)].friction;
  };
  const Eigen::VectorXd& size = dscene.bodies[placeOf(path_.body)].size;
  d.gravity = dscene.gravity;
  d.normal = dscene.bodies[placeOf(path_.face)].orientation.cross(path_.inputs.normal);
  d.friction = friction_.by_a * friction_of(path_.body) + friction_.by_b * friction_of(path_.face);
  d.mass = dmodel.mass;
  d.inertia = dmodel.inertia;
  d.products = dmodel.products;
  if (path_.reach_rates.size() > 0) d.reach = path_.reach_rates.dot(size);
  return d;
}

// Of a block that does not turn, what its angular momentum about the normal makes of it.
void ClosedPathLinearization::addSpin(PathSensitivity<double>& sensitivity) const {
  const PathInputs<double>& in = path_.inputs;
  const BodyModel& model = (*motion_.models)[placeOf(path_.body)];
  const Pose own{in.x, model.shapeToWorld(in.R)};
  const WorldLine& line = motion_.world_lines[placeOf(path_.body)];
  const Event& begin = motion_.events[placeOf(line.events[placeOf(k_) - 1])];
  std::vector<BlockSupport> supports;
  for (const Contact& c : begin.contacts) {
    if (!c.lasts || (c.a != path_.body && c.b != path_.body)) continue;
    const bool is_first = c.a == path_.body;
    const int other = is_first ? c.b : c.a;  // stands still
    const Pose with = shapePose(motion_, other, motion_.world_lines[placeOf(other)].arcs[0].startState());
    const Pose &of_a = is_first ? own : with, &of_b = is_first ? with : own;
    supports.push_back({motion_.geometry->contact(c.a, c.b, c.features, of_a, of_b).point - in.x,
                        motion_.geometry->jacobian(c.a, c.b, c.features, of_a, of_b).pose.block<3, 3>(4, is_first ? 0 : 6)});
  }
  const BlockSpin by = blockSpin(in, supports, elapsed_, elapsed_ == path_.slip_end);
  const Vec3 &n = in.normal, momentum = in.R * (in.J * (in.R.transpose() * n));  // of 1 rad/s
  Eigen::Matrix<double, 12, 1> column;
  column << by.x, by.turn * n, by.v, by.spin * momentum;
  sensitivity.J.block<12, 3>(0, 9) += column * n.transpose() / n.dot(momentum);
}

const PathSensitivity<double>& ClosedPathLinearization::sensitivity(bool turns) const {
  if (whole_) return *whole_;
  std::optional<PathSensitivity<double>>& slot = turns && orientation_ ? whole_ : without_turn_;
  if (!slot) slot = closedForm(turns && orientation_);
  return *slot;
}

PathSensitivity<double> ClosedPathLinearization::closedForm(bool orientation) const {
  PathSensitivity<double> out = pathSensitivity<double>(path_.variedForm(), path_.inputs, elapsed_, orientation);
  if (path_.form == PathForm::glide_block) addSpin(out);
  return out;
}

StateDerivative ClosedPathLinearization::tangent(const StateDerivative& dstart, const SceneTangent& dscene,
                                                 const BodyModelDerivative& dmodel) const {
  return adjoint_detail::tangent(sensitivity(true), dstart, inputs(dscene, dmodel));
}

StateDerivative ClosedPathLinearization::pullback(const StateDerivative& end_bar, SceneGradient& scene_bar,
                                                  BodyModelDerivative& model_bar) const {
  PathInputsDerivative<double> inputs_bar;
  const StateDerivative start_bar = adjoint_detail::pullback(sensitivity(!end_bar.theta.isZero(0)), end_bar, inputs_bar);
  pathInputsPullback<double>(*motion_.scene, path_, path_.inputs.normal, friction_, inputs_bar, scene_bar, model_bar);
  return start_bar;
}

}  // namespace carom::adjoint_detail

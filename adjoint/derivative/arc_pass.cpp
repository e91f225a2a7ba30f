// SPDX-License-Identifier: MIT
#include "adjoint/derivative/arc_pass.hpp"

#include <algorithm>

#include "adjoint/held/block_spin.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {

PathInputsDerivative<double> PathLinearization::inputs(const ContactPath& path, const SceneTangent& dscene,
                                                       const BodyModelDerivative& dmodel) const {
  PathInputsDerivative<double> d;
  const auto friction_of = [&](int body) {
    const int m = materialIndexOf(scene, body);
    return m < 0 ? 0 : dscene.materials[static_cast<std::size_t>(m)].friction;
  };
  const Eigen::VectorXd& size = dscene.bodies[static_cast<std::size_t>(path.body)].size;
  d.gravity = dscene.gravity;
  d.normal = dscene.bodies[static_cast<std::size_t>(path.face)].orientation.cross(path.inputs.normal);
  d.friction = friction.by_a * friction_of(path.body) + friction.by_b * friction_of(path.face);
  d.mass = dmodel.mass;
  d.inertia = dmodel.inertia;
  d.products = dmodel.products;
  if (path.reach_rates.size() > 0) d.reach = path.reach_rates.dot(size);
  return d;
}

namespace {

// The event with which a path starts.
const Event& startOf(const Motion& motion, const ContactPath& path) {
  const WorldLine& line = motion.world_lines[static_cast<std::size_t>(path.body)];
  auto arc = std::ranges::lower_bound(line.arcs, path.start, {}, &Arc::start);
  while (arc->path() != &path) ++arc;
  return motion.events[static_cast<std::size_t>(line.events[static_cast<std::size_t>(arc - line.arcs.begin()) - 1])];
}

// Of a block that does not turn, what its angular momentum about the normal makes of it.
void addSpin(const Motion& motion, const ContactPath& path, double elapsed, PathSensitivity<double>& sensitivity) {
  const PathInputs<double>& in = path.inputs;
  const BodyModel& model = (*motion.models)[static_cast<std::size_t>(path.body)];
  const Pose own{in.x, model.shapeToWorld(in.R)};
  std::vector<BlockSupport> supports;
  for (const Contact& c : startOf(motion, path).contacts) {
    if (!c.lasts || (c.a != path.body && c.b != path.body)) continue;
    const bool is_first = c.a == path.body;
    const int other = is_first ? c.b : c.a;  // stands still
    const Pose with = shapePose(motion, other, motion.world_lines[static_cast<std::size_t>(other)].arcs[0].startState());
    const Pose &of_a = is_first ? own : with, &of_b = is_first ? with : own;
    supports.push_back({motion.geometry->contact(c.a, c.b, c.features, of_a, of_b).point - in.x,
                        motion.geometry->jacobian(c.a, c.b, c.features, of_a, of_b).pose.block<3, 3>(4, is_first ? 0 : 6)});
  }
  const BlockSpin by = blockSpin(in, supports, elapsed, elapsed == path.slip_end);
  const Vec3 &n = in.normal, momentum = in.R * (in.J * (in.R.transpose() * n));  // of 1 rad/s
  Eigen::Matrix<double, 12, 1> column;
  column << by.x, by.turn * n, by.v, by.spin * momentum;
  sensitivity.J.block<12, 3>(0, 9) += column * n.transpose() / n.dot(momentum);
}

const Material& materialOfBody(const Scene& scene, int body) {
  return materialOf(scene, scene.bodies[static_cast<std::size_t>(body)]);
}

}  // namespace

PathLinearization::PathLinearization(const Motion& motion, const ContactPath& path, double elapsed)
    : scene(*motion.scene),
      friction(rulesOf(materialOfBody(scene, path.body), materialOfBody(scene, path.face)).friction),
      motion_(motion),
      path_(path),
      elapsed_(elapsed),
      orientation_(motion.plan.bodies[static_cast<std::size_t>(path.body)].derivative_tier != Tier::none) {
  if (path.integrated) columns_.emplace(motion, static_cast<const HeldPath&>(*path.integrated.get()));
}

const Eigen::MatrixXd& PathLinearization::matrix() const {
  if (!matrix_)
    matrix_ = heldSensitivity(static_cast<const HeldPath&>(*path_.integrated.get()), columns_->inputs(), path_.start + elapsed_);
  return *matrix_;
}

const PathSensitivity<double>& PathLinearization::sensitivity(bool turns) const {
  if (whole_) return *whole_;
  std::optional<PathSensitivity<double>>& slot = turns && orientation_ ? whole_ : without_turn_;
  if (!slot) slot = closedForm(turns && orientation_);
  return *slot;
}

PathSensitivity<double> PathLinearization::closedForm(bool orientation) const {
  PathSensitivity<double> out = pathSensitivity<double>(path_.form, path_.inputs, elapsed_, orientation);
  if (path_.form == PathForm::glide_block) addSpin(motion_, path_, elapsed_, out);
  return out;
}

std::shared_ptr<const PathLinearization> linearizedPath(const Motion& motion, const ContactPath& path,
                                                        double elapsed) {
  return std::make_shared<PathLinearization>(motion, path, elapsed);
}

StateDerivative arcTangent(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& dstart,
                           const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
  if (!S.path) return flightTangent(arc, t, S, dstart, dscene.gravity, dmodel);
  if (const HeldColumns* columns = S.path->columns())
    return asState(S.path->matrix() * columns->tangent(dstart, dscene, dmodel));
  return tangent(S.path->sensitivity(true), dstart, S.path->inputs(*arc.path(), dscene, dmodel));
}

StateDerivative arcPullback(const Arc& arc, double t, const ArcSensitivity& S, const StateDerivative& end_bar,
                            SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
  if (!S.path) return flightPullback(arc, t, S, end_bar, scene_bar.gravity, model_bar);
  if (const HeldColumns* columns = S.path->columns())
    return columns->pullback(S.path->matrix().transpose() * asVector(end_bar), scene_bar, model_bar);
  PathInputsDerivative<double> inputs_bar;
  const StateDerivative start_bar = pullback(S.path->sensitivity(!end_bar.theta.isZero(0)), end_bar, inputs_bar);
  const ContactPath& path = *arc.path();
  pathInputsPullback<double>(S.path->scene, path, path.inputs.normal, S.path->friction, inputs_bar, scene_bar, model_bar);
  return start_bar;
}

}  // namespace carom::adjoint_detail

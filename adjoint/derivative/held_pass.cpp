// SPDX-License-Identifier: MIT
#include "adjoint/derivative/held_pass.hpp"

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {

namespace {

std::size_t placeOf(int i) { return static_cast<std::size_t>(i); }

}  // namespace

const HeldPath* heldPathOf(const Arc& arc) { return static_cast<const HeldPath*>(arc.integrated()); }

std::shared_ptr<const PathStart> pathStartOf(const Motion& motion, const Event& event) {
  for (std::size_t i = 0; i < event.participants.size(); ++i) {
    const Participant& p = event.participants[i];
    const HeldPath* path = heldPathOf(motion.world_lines[placeOf(p.body)].arcs[placeOf(p.arc) + 1]);
    if (!path || !path->stopsSpeeds()) continue;
    const auto columns = std::make_shared<const HeldColumns>(motion, *path);
    const auto stop = std::make_shared<const Eigen::MatrixXd>(heldStop(*path, columns->inputs()));
    auto start = std::make_shared<PathStart>();
    start->participant = i;
    start->tangent = [columns, stop](const StateDerivative& d, const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
      return asState(*stop * columns->tangent(d, dscene, dmodel));
    };
    start->pullback = [columns, stop](const StateDerivative& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
      return columns->pullback(stop->transpose() * asVector(bar), scene_bar, model_bar);
    };
    return start;
  }
  return nullptr;
}

HeldColumns::HeldColumns(const Motion& motion, const HeldScene& held, const std::vector<HeldContact>& contacts,
                         const State& state)
    : body_(held.body), inputs_(held, contacts, state) {
  const Scene& scene = *motion.scene;
  const auto material = [&](int body) -> const Material& { return materialOf(scene, scene.bodies[placeOf(body)]); };
  for (const HeldContact& c : contacts) {
    const int a = c.is_first ? body_ : c.with, b = c.is_first ? c.with : body_;
    const Rule<double> rule = rulesOf(material(a), material(b)).friction;
    friction_.push_back({materialIndexOf(scene, body_), materialIndexOf(scene, c.with), c.is_first ? rule.by_a : rule.by_b,
                         c.is_first ? rule.by_b : rule.by_a});
  }
}

Eigen::VectorXd HeldColumns::tangent(const StateDerivative& start, const SceneTangent& dscene,
                                     const BodyModelDerivative& dmodel) const {
  using I = HeldInputs;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(inputs_.count);
  d.head<12>() = asVector(start);
  d.segment<3>(I::kGravity) = dscene.gravity;
  d[I::kMass] = dmodel.mass;
  d.segment<3>(I::kInertia) = dmodel.inertia;
  d.segment<3>(I::kProducts) = dmodel.products;
  d.segment(I::kSizes, inputs_.size_count) = dscene.bodies[placeOf(body_)].size;
  for (const I::Partner& p : inputs_.partners) {
    const BodyDerivative& body = dscene.bodies[placeOf(p.body)];
    d.segment<3>(p.pose) = body.position;
    d.segment<3>(p.pose + 3) = body.orientation;
    d.segment(p.sizes, p.size_count) = body.size;
  }
  const auto of = [&](int m) { return m < 0 ? 0 : dscene.materials[placeOf(m)].friction; };
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const Friction& f = friction_[k];
    d[inputs_.friction + static_cast<int>(k)] = f.by_own * of(f.own) + f.by_other * of(f.other);
  }
  return d;
}

StateDerivative HeldColumns::pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar,
                                      BodyModelDerivative& model_bar) const {
  using I = HeldInputs;
  scene_bar.gravity += bar.segment<3>(I::kGravity);
  model_bar.mass += bar[I::kMass];
  model_bar.inertia += bar.segment<3>(I::kInertia);
  model_bar.products += bar.segment<3>(I::kProducts);
  if (inputs_.size_count > 0) scene_bar.bodies[placeOf(body_)].size += bar.segment(I::kSizes, inputs_.size_count);
  for (const I::Partner& p : inputs_.partners) {
    BodyDerivative& body = scene_bar.bodies[placeOf(p.body)];
    body.position += bar.segment<3>(p.pose);
    body.orientation += bar.segment<3>(p.pose + 3);
    if (p.size_count > 0) body.size += bar.segment(p.sizes, p.size_count);
  }
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const Friction& f = friction_[k];
    const double of = bar[inputs_.friction + static_cast<int>(k)];
    if (f.own >= 0) scene_bar.materials[placeOf(f.own)].friction += f.by_own * of;
    if (f.other >= 0) scene_bar.materials[placeOf(f.other)].friction += f.by_other * of;
  }
  return asState(bar.head<12>());
}

}  // namespace carom::adjoint_detail

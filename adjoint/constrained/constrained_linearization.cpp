// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_linearization.hpp"

#include <algorithm>
#include <optional>

#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {

namespace {

std::size_t constrainedIndex(int i) { return static_cast<std::size_t>(i); }

// By the columns of its inputs, linearised on first use.
class ConstrainedLinearization final : public TrajectoryLinearization {
 public:
  ConstrainedLinearization(const Motion& motion, const ConstrainedPath& path, double time)
      : path_(path), columns_(motion, path), time_(time) {}

  StateDerivative tangent(const StateDerivative& dstart, const SceneTangent& dscene,
                          const BodyModelDerivative& dmodel) const override {
    return asState(matrix() * columns_.tangent(dstart, dscene, dmodel));
  }
  StateDerivative pullback(const StateDerivative& end_bar, SceneGradient& scene_bar,
                           BodyModelDerivative& model_bar) const override {
    return columns_.pullback(matrix().transpose() * asVector(end_bar), scene_bar, model_bar);
  }

 private:
  const Eigen::MatrixXd& matrix() const {
    if (!matrix_) matrix_ = constrainedSensitivity(path_, columns_.inputs(), time_);
    return *matrix_;
  }

  const ConstrainedPath& path_;
  ConstrainedColumns columns_;
  double time_;
  mutable std::optional<Eigen::MatrixXd> matrix_;
};

}  // namespace

std::shared_ptr<const TrajectoryLinearization> ConstrainedPath::linearise(const Motion& motion, int, int, double t) const {
  return std::make_shared<ConstrainedLinearization>(motion, *this, t);
}

std::shared_ptr<const PathStart> ConstrainedPath::mapOfStart(const Motion& motion, int participant) const {
  if (!stopsSpeeds()) return nullptr;
  const auto columns = std::make_shared<const ConstrainedColumns>(motion, *this);
  const auto stop = std::make_shared<const Eigen::MatrixXd>(constrainedStop(*this, columns->inputs()));
  auto start = std::make_shared<PathStart>();
  start->participant = constrainedIndex(participant);
  start->tangent = [columns, stop](const StateDerivative& d, const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
    return asState(*stop * columns->tangent(d, dscene, dmodel));
  };
  start->pullback = [columns, stop](const StateDerivative& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
    return columns->pullback(stop->transpose() * asVector(bar), scene_bar, model_bar);
  };
  return start;
}

std::shared_ptr<const PathGuard> ConstrainedPath::guardOfEnd(const Motion& motion, const Event& event) const {
  ConstrainedGuard guard{event.cause, -1, event.border, {}};
  const Contact& first = event.contacts[0];
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const PersistentContact& c = contacts_[k];
    if (c.features == first.features && c.with == (first.a == scene_.body ? first.b : first.a)) guard.contact = static_cast<int>(k);
  }
  const auto columns = std::make_shared<const ConstrainedColumns>(motion, *this);
  return guardWith(columns, guardRow(*this, columns->inputs(), guard, event.time), timeShift(scene_, columns->inputs(), event.time));
}

std::shared_ptr<const PathGuard> guardWith(std::shared_ptr<const ConstrainedColumns> columns, const ConstrainedRow& row,
                                           const Eigen::VectorXd& shift) {
  auto made = std::make_shared<PathGuard>();
  made->by_state = asState(row.head<12>().transpose());
  made->by_time = row.dot(shift);
  Eigen::VectorXd others = row.transpose();
  others.head<12>().setZero();
  made->tangent = [columns, others](const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
    return others.dot(columns->tangent({}, dscene, dmodel));
  };
  made->pullback = [columns, others](double sigma, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
    columns->pullback(sigma * others, scene_bar, model_bar);
  };
  return made;
}

ConstrainedColumns::ConstrainedColumns(const Motion& motion, const ConstrainedScene& held, const std::vector<PersistentContact>& contacts,
                         const State& state)
    : scene_(motion.scene.get()), body_(held.body), inputs_(held, contacts, state) {
  const Scene& scene = *motion.scene;
  const auto material = [&](int body) -> const Material& { return materialOf(scene, scene.bodies[constrainedIndex(body)]); };
  for (const PersistentContact& c : contacts) {
    const int a = c.is_first ? body_ : c.with, b = c.is_first ? c.with : body_;
    const Rule<double> rule = rulesOf(material(a), material(b)).friction;
    friction_.push_back({materialIndexOf(scene, body_), materialIndexOf(scene, c.with), c.is_first ? rule.by_a : rule.by_b,
                         c.is_first ? rule.by_b : rule.by_a});
  }
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (held.with[k].moves() && !held.with[k].isGiven() && !carriedOf(contacts[k].with))
      carried_.push_back({contacts[k].with, fromSceneStart(motion, contacts[k].with, held.with[k], held.time)});
}

const ConstrainedColumns::Carried* ConstrainedColumns::carriedOf(int body) const {
  const auto at = std::ranges::find(carried_, body, &Carried::body);
  return at == carried_.end() ? nullptr : &*at;
}

Eigen::VectorXd ConstrainedColumns::tangent(const StateDerivative& start, const SceneTangent& dscene,
                                     const BodyModelDerivative& dmodel) const {
  using I = ConstrainedInputs;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(inputs_.count);
  d.head<12>() = asVector(start);
  d.segment<3>(I::kGravity) = dscene.gravity;
  d[I::kMass] = dmodel.mass;
  d.segment<3>(I::kInertia) = dmodel.inertia;
  d.segment<3>(I::kProducts) = dmodel.products;
  d.segment(I::kSizes, inputs_.size_count) = dscene.bodies[constrainedIndex(body_)].size;
  for (const I::Partner& p : inputs_.partners) {
    const BodyDerivative& body = dscene.bodies[constrainedIndex(p.body)];
    if (p.velocity < 0) {
      d.segment<3>(p.pose) = body.position;
      d.segment<3>(p.pose + 3) = body.orientation;
    } else if (const Carried* carried = carriedOf(p.body)) {
      const StateDerivative start_of = carried->start.tangent(body);
      d.segment<6>(p.pose) << start_of.x, start_of.theta;
      d.segment<6>(p.velocity) << start_of.v, start_of.L;
    }
    if (p.surface >= 0) d.segment<6>(p.surface) << body.surface_velocity, body.surface_angular_velocity;
    d.segment(p.sizes, p.size_count) = body.size;
  }
  const auto of = [&](int m) { return m < 0 ? 0 : dscene.materials[constrainedIndex(m)].friction; };
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const Friction& f = friction_[k];
    d[inputs_.friction + static_cast<int>(k)] = f.by_own * of(f.own) + f.by_other * of(f.other);
  }
  return d;
}

StateDerivative ConstrainedColumns::pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar,
                                      BodyModelDerivative& model_bar) const {
  using I = ConstrainedInputs;
  scene_bar.gravity += bar.segment<3>(I::kGravity);
  model_bar.mass += bar[I::kMass];
  model_bar.inertia += bar.segment<3>(I::kInertia);
  model_bar.products += bar.segment<3>(I::kProducts);
  if (inputs_.size_count > 0) scene_bar.bodies[constrainedIndex(body_)].size += bar.segment(I::kSizes, inputs_.size_count);
  for (const I::Partner& p : inputs_.partners) {
    BodyDerivative& body = scene_bar.bodies[constrainedIndex(p.body)];
    if (p.velocity < 0) {
      body.position += bar.segment<3>(p.pose);
      body.orientation += bar.segment<3>(p.pose + 3);
    } else if (const Carried* carried = carriedOf(p.body)) {
      Eigen::Matrix<double, 12, 1> at_start;
      at_start << bar.segment<6>(p.pose), bar.segment<6>(p.velocity);
      carried->start.pullback(asState(at_start), body);
    }
    if (p.surface >= 0) {
      body.surface_velocity += bar.segment<3>(p.surface);
      body.surface_angular_velocity += bar.segment<3>(p.surface + 3);
    }
    if (p.size_count > 0) body.size += bar.segment(p.sizes, p.size_count);
  }
  for (std::size_t k = 0; k < friction_.size(); ++k) {
    const Friction& f = friction_[k];
    const double of = bar[inputs_.friction + static_cast<int>(k)];
    if (f.own >= 0) scene_bar.materials[constrainedIndex(f.own)].friction += f.by_own * of;
    if (f.other >= 0) scene_bar.materials[constrainedIndex(f.other)].friction += f.by_other * of;
  }
  return asState(bar.head<12>());
}

}  // namespace carom::adjoint_detail

// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_linearization.hpp"

#include <algorithm>
#include <optional>

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
  made->by_state = {asState(row.head<12>().transpose())};
  made->by_time = row.dot(shift);
  Eigen::VectorXd others = row.transpose();
  others.head<12>().setZero();
  made->tangent = [columns, others](const SceneTangent& dscene, std::span<const BodyModelDerivative> dmodels) {
    return others.dot(columns->tangent({}, dscene, dmodels[0]));
  };
  made->pullback = [columns, others](double sigma, SceneGradient& scene_bar, std::span<BodyModelDerivative> model_bars) {
    columns->pullback(sigma * others, scene_bar, model_bars[0]);
  };
  return made;
}

ConstrainedColumns::ConstrainedColumns(const Motion& motion, const ConstrainedScene& held, const std::vector<PersistentContact>& contacts,
                         const State& state)
    : body_(held.body), inputs_(held, contacts, state), contacts_(motion) {
  for (std::size_t p = 0; p < inputs_.partners.size(); ++p) {
    const auto first = std::ranges::find(inputs_.partner_of, p) - inputs_.partner_of.begin();
    contacts_.addSupport(inputs_.partners[p], held.with[static_cast<std::size_t>(first)], held.time);
  }
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PersistentContact& c = contacts[k];
    contacts_.addFriction(inputs_.friction + static_cast<int>(k), c.is_first ? body_ : c.with, c.is_first ? c.with : body_);
  }
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
  contacts_.tangent(dscene, d);
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
  contacts_.pullback(bar, scene_bar);
  return asState(bar.head<12>());
}

}  // namespace carom::adjoint_detail

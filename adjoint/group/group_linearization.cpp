// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/contact_columns.hpp"
#include "adjoint/group/group_sensitivity.hpp"

// Between the inputs of the path of a group and the scene, forward and reverse.

namespace carom::adjoint_detail {
namespace {

// Where the columns of GroupInputs come from.
class GroupColumns {
 public:
  GroupColumns(const Motion& motion, const GroupPath& path) : inputs_(path.scene(), path.contacts(), path.startStates()), contacts_(motion) {
    for (std::size_t p = 0; p < inputs_.partners.size(); ++p) {
      const auto first = std::ranges::find(inputs_.partner_of, static_cast<int>(p)) - inputs_.partner_of.begin();
      contacts_.addSupport(inputs_.partners[p], path.scene().with[static_cast<std::size_t>(first)], path.start());
    }
    for (std::size_t k = 0; k < path.contacts().size(); ++k)
      contacts_.addFriction(inputs_.friction + static_cast<int>(k), path.contacts()[k].a, path.contacts()[k].b);
  }

  const GroupInputs& inputs() const { return inputs_; }

  Eigen::VectorXd tangent(std::span<const StateDerivative> start, std::span<const BodyModelDerivative> model, const SceneTangent& dscene) const {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(inputs_.count);
    d.segment<3>(inputs_.gravity) = dscene.gravity;
    for (std::size_t m = 0; m < inputs_.members.size(); ++m) {
      const GroupInputs::Member& of = inputs_.members[m];
      if (m < start.size()) d.segment<12>(12 * rowAt(m)) = asVector(start[m]);
      d[of.mass] = model[m].mass;
      d.segment<3>(of.inertia()) = model[m].inertia;
      d.segment<3>(of.products()) = model[m].products;
      d.segment(of.sizes, of.size_count) = dscene.bodies[static_cast<std::size_t>(of.body)].size;
    }
    contacts_.tangent(dscene, d);
    return d;
  }

  // Its adjoint: adds to those of the scene and of the models.
  void pullback(const Eigen::VectorXd& bar, std::span<StateDerivative> start_bar, std::span<BodyModelDerivative> model_bar,
                SceneGradient& scene_bar) const {
    scene_bar.gravity += bar.segment<3>(inputs_.gravity);
    for (std::size_t m = 0; m < inputs_.members.size(); ++m) {
      const GroupInputs::Member& of = inputs_.members[m];
      if (m < start_bar.size()) start_bar[m] += asState(bar.segment<12>(12 * rowAt(m)));
      model_bar[m].mass += bar[of.mass];
      model_bar[m].inertia += bar.segment<3>(of.inertia());
      model_bar[m].products += bar.segment<3>(of.products());
      if (of.size_count > 0) scene_bar.bodies[static_cast<std::size_t>(of.body)].size += bar.segment(of.sizes, of.size_count);
    }
    contacts_.pullback(bar, scene_bar);
  }

 private:
  GroupInputs inputs_;
  ContactColumns contacts_;
};

// By the columns of its inputs, linearised on first use.
class GroupLinearization final : public SharedLinearization {
 public:
  GroupLinearization(const Motion& motion, const GroupPath& path, double time) : path_(path), columns_(motion, path), time_(time) {
    members_ = path.membersIn(motion);
  }

  StateDerivative tangent(std::size_t slot, const Starts& starts, const SceneTangent& dscene) const override {
    return asState(rowsOf(slot) * columns_.tangent(starts.state, starts.model, dscene));
  }
  Starts pullback(std::size_t slot, const StateDerivative& end_bar, SceneGradient& scene_bar) const override {
    Starts bars(members_.size());
    columns_.pullback(rowsOf(slot).transpose() * asVector(end_bar), bars.state, bars.model, scene_bar);
    return bars;
  }

 private:
  Eigen::Block<const Eigen::MatrixXd, 12> rowsOf(std::size_t slot) const {
    if (!matrix_) matrix_ = groupSensitivity(path_, columns_.inputs(), time_);
    return std::as_const(*matrix_).middleRows<12>(12 * rowAt(slot));
  }

  const GroupPath& path_;
  GroupColumns columns_;
  double time_;
  mutable std::optional<Eigen::MatrixXd> matrix_;
};

}  // namespace

std::vector<SharedLinearization::Member> GroupPath::membersIn(const Motion& motion) const {
  std::vector<SharedLinearization::Member> found;
  for (std::size_t slot = 0; slot < scene_.members.size(); ++slot) {
    const int body = scene_.members[slot].body;
    const std::vector<Arc>& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
    const auto own = std::ranges::find_if(arcs, [&](const Arc& arc) { return &arc.trajectory() == this && arc.slot() == static_cast<int>(slot); });
    if (own == arcs.end()) throw NotComputable("bodies that move on each other have no common path any more");
    found.push_back({body, static_cast<int>(own - arcs.begin())});
  }
  return found;
}

std::shared_ptr<const SharedLinearization> GroupPath::lineariseShared(const Motion& motion, double t) const {
  return std::make_shared<GroupLinearization>(motion, *this, t);
}

std::shared_ptr<const PathGuard> GroupPath::guardOfEnd(const Motion& motion, const Event& event) const {
  ConstrainedGuard guard{event.cause, -1, event.border, {}};
  const Contact& first = event.contacts[0];
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (contacts_[k].features == first.features && contacts_[k].a == first.a && contacts_[k].b == first.b) guard.contact = static_cast<int>(k);
  const auto columns = std::make_shared<const GroupColumns>(motion, *this);
  const Eigen::RowVectorXd row = guardRow(*this, columns->inputs(), guard, event.time);
  auto made = std::make_shared<PathGuard>();
  for (std::size_t m = 0; m < start_.size(); ++m) made->by_state.push_back(asState(row.segment<12>(12 * rowAt(m)).transpose()));
  if (std::ranges::any_of(scene_.with, &Support::moves)) made->by_time = row.dot(timeShift(scene_, columns->inputs(), event.time));
  Eigen::VectorXd others = row.transpose();
  others.head(columns->inputs().states()).setZero();
  made->tangent = [columns, others](const SceneTangent& dscene, std::span<const BodyModelDerivative> dmodels) {
    return others.dot(columns->tangent({}, dmodels, dscene));
  };
  made->pullback = [columns, others](double sigma, SceneGradient& scene_bar, std::span<BodyModelDerivative> model_bars) {
    columns->pullback(sigma * others, {}, model_bars, scene_bar);
  };
  return made;
}

}  // namespace carom::adjoint_detail

// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>

#include "adjoint/impact/contact_part.hpp"
#include "adjoint/impact/event_guard.hpp"
#include "adjoint/impact/pose_projection.hpp"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// One event, linearised, and its reverse pass, in one kind of number: impact, contact geometry and guard (equations 5.1
/// to 5.3 of docs/equations.md). The weights of the guard are held: they weigh gaps that are all 0 there.
template <class S>
class EventPass {
 public:
  using Vec7 = Eigen::Matrix<S, 7, 1>;
  using Vec12 = Eigen::Matrix<S, 12, 1>;
  using Part = ContactPart<S>;
  using StateBar = StateDerivativeOf<S>;
  using ModelBar = BodyModelDerivativeOf<S>;
  using SceneBar = SceneDerivativeOf<S>;

  /// `wide`: doubles are too short for the impact; `rate_before`, `rate_after`: F- and F+ of the participants.
  EventPass(const Event& event, bool wide, ImpactInputs<S> inputs, std::vector<Part> parts, EventGuard<S> guard,
            std::vector<StateBar> rate_before, std::vector<StateBar> rate_after)
      : event_(event),
        wide_(wide),
        impact_(std::move(inputs)),
        parts_(std::move(parts)),
        guard_(std::move(guard)),
        projection_(parts_, impact_.inputs()),
        rate_before_(std::move(rate_before)),
        rate_after_(std::move(rate_after)) {
    for (const Part& part : parts_) guard_rate_ += part.guard.dot(part.pose * poses(part, rate_before_));
    guard_rate_ += guard_.rate(impact_, rate_before_);
    if (wide_ || !hasLaw()) return;
    if constexpr (std::is_same_v<S, double>) {
      P_.resize(3 * static_cast<Eigen::Index>(event.contacts.size()));
      for (std::size_t k = 0; k < event.contacts.size(); ++k)
        P_.template segment<3>(3 * static_cast<Eigen::Index>(k)) = event.contacts[k].impulse;
    } else {
      P_ = impact_.solve().P;
    }
  }

  const Event& event() const { return event_; }
  const ImpactPass<S>& impact() const { return impact_; }
  bool wide() const { return wide_; }
  const std::vector<Part>& parts() const { return parts_; }
  /// F- and F+, d(state)/dt of the participants just before and just after.
  const std::vector<StateBar>& rateBefore() const { return rate_before_; }
  const std::vector<StateBar>& rateAfter() const { return rate_after_; }
  /// D = d(guard)/dt < 0, m/s; of a slip that ends m/s^2.
  const S& guardRate() const { return guard_rate_; }
  const EventGuard<S>& guard() const { return guard_; }
  const PoseProjection<S>& projection() const { return projection_; }
  /// Whether the map is an impact law; states go through other events as they are.
  bool hasLaw() const { return event_.kind != EventKind::transition; }
  /// Whether its time stays where it is.
  bool hasFixedTime() const { return event_.kind == EventKind::placed; }

  /// (x_a, theta_a, x_b, theta_b) of changes of the participants; fixed bodies stay.
  static Vec12 poses(const Part& part, const std::vector<StateBar>& states) {
    Vec12 d = Vec12::Zero();
    Eigen::Index at = 0;
    for (const auto& side : {part.a, part.b}) {
      if (side.participant >= 0) {
        d.template segment<3>(at) = states[static_cast<std::size_t>(side.participant)].x;
        d.template segment<3>(at + 3) = states[static_cast<std::size_t>(side.participant)].theta;
      }
      at += 6;
    }
    return d;
  }

  /// How the row of a contact's gap varies along a change w of the poses, as a row: by the poses, and by the dimensions.
  struct Bend {
    Vec12 pose = Vec12::Zero();
    VectorOf<S> size_a, size_b;
  };
  using Bends = std::function<Bend(std::size_t contact, const Vec12& w)>;
  /// Of numbers with rates, where the event closes gaps.
  void setBends(Bends bends) { bends_ = std::move(bends); }

  /// Of a path that starts here and changes the state with which it does.
  void setStart(std::shared_ptr<const PathStart> start) { start_ = std::move(start); }
  const PathStart* start() const { return start_.get(); }

  /// Adjoint of (gap, normal, point) of a contact, to the participants or to the scene.
  void scatter(const Part& part, const Vec7& bar, std::vector<StateBar>& before_bar, SceneBar& scene_bar,
               std::vector<ModelBar>& model_bar) const {
    if constexpr (std::is_same_v<S, double>) {
      if (part.rim) {
        const auto body = static_cast<std::size_t>(event_.participants[part.rim->participant].body);
        before_bar[part.rim->participant] += part.rim->pullback(bar, scene_bar, model_bar[body]);
        return;
      }
    }
    Bend d{part.pose.transpose() * bar, {}, {}};
    if (part.size_a.cols() > 0) d.size_a = part.size_a.transpose() * bar;
    if (part.size_b.cols() > 0) d.size_b = part.size_b.transpose() * bar;
    scatter(part, d, before_bar, scene_bar);
  }
  static void scatter(const Part& part, const Bend& bar, std::vector<StateBar>& before_bar, SceneBar& scene_bar) {
    const Vec12& d = bar.pose;
    Eigen::Index at = 0;
    for (const auto& side : {part.a, part.b}) {
      auto& body = scene_bar.bodies[static_cast<std::size_t>(side.body)];
      const auto add = [&](auto& x, auto& theta) {
        x += d.template segment<3>(at);
        theta += d.template segment<3>(at + 3);
      };
      if (side.participant < 0) {
        add(body.position, body.orientation);
      } else {
        StateBar& before = before_bar[static_cast<std::size_t>(side.participant)];
        add(before.x, before.theta);
      }
      at += 6;
    }
    if (bar.size_a.size() > 0) scene_bar.bodies[static_cast<std::size_t>(part.a.body)].size += bar.size_a;
    if (bar.size_b.size() > 0) scene_bar.bodies[static_cast<std::size_t>(part.b.body)].size += bar.size_b;
  }

  /// The same of what the impact sees of contact k: (gap, normal of the impulse, point) and coefficients.
  void contactPullback(std::size_t k, Vec7 bar, const PairCoefficientsOf<S>& pair_bar, std::vector<StateBar>& before_bar,
                       SceneBar& scene_bar, std::vector<ModelBar>& model_bar) const {
    const Part& part = parts_[k];
    const Contact& c = event_.contacts[k];
    if (part.tilted) {
      const Vec7 by = part.tilt.transpose() * bar.template segment<3>(1);
      bar.template segment<3>(1) = by.template head<3>();
      if (c.tilt_a >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_a)] += by.template segment<2>(3);
      if (c.tilt_b >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_b)] += by.template segment<2>(5);
    }
    scatter(part, bar, before_bar, scene_bar, model_bar);
    MaterialDerivativeOf<S> unused;
    const auto slot = [&](int m) -> MaterialDerivativeOf<S>& {
      return m < 0 ? unused : scene_bar.materials[static_cast<std::size_t>(m)];
    };
    part.rules.pullback(pair_bar, slot(part.material_a), slot(part.material_b));
  }

  /// The same of the velocity of the moving surface of a contact.
  void surfacePullback(const Part& part, const V3<S>& bar, std::vector<StateBar>& before_bar, SceneBar& scene_bar,
                       std::vector<ModelBar>& model_bar) const {
    if (!part.surface) return;
    const SurfacePart<S>& surface = *part.surface;
    const auto d = surface.motion.pullback(surface.point, surface.normal, V3<S>(surface.sign * bar));
    auto& body = scene_bar.bodies[static_cast<std::size_t>(surface.body)];
    body.surface_velocity += d.velocity;
    body.surface_angular_velocity += d.spin;
    Vec7 contact;
    contact << S(0), d.normal, d.point;
    scatter(part, contact, before_bar, scene_bar, model_bar);
    if (surface.participant < 0) {
      body.position += d.position;
      body.orientation += d.theta;
      return;
    }
    StateBar& before = before_bar[static_cast<std::size_t>(surface.participant)];  // X = x - R c
    before.x += d.position;
    before.theta += d.theta - surface.center.cross(d.position);
    model_bar[static_cast<std::size_t>(surface.body)].center -= surface.motion.R.transpose() * d.position;
  }

  /// Adjoint just before the event from that just after (`fixed_bar`, at the fixed nominal time), plus adjoints of the state just before
  /// (`read_bar`) and of the time of the event (`time_bar`) that are read at the event itself.
  std::vector<StateBar> pullback(const std::vector<StateBar>& fixed_bar, const std::vector<StateBar>& read_bar,
                                 const S& time_bar, SceneBar& scene_bar, std::vector<ModelBar>& model_bar) const {
    std::vector<StateBar> started_bar;
    const std::vector<StateBar>& after_bar = start_ ? started_bar : fixed_bar;  // at the time of the event
    if (start_) started_bar = startPullback(fixed_bar, scene_bar, model_bar);
    std::vector<StateBar> before_bar(after_bar.size());
    const bool through = std::any_of(after_bar.begin(), after_bar.end(), [](const auto& s) { return !s.isZero(); });
    if (through && !hasLaw()) before_bar = after_bar;
    std::vector<StateBar> turned_bar;
    const auto turned = [&](double share) -> const std::vector<StateBar>& {
      if (!bends_) return after_bar;
      return turned_bar = PoseProjection<S>::turnedBack(after_bar, projection_.moveOf(closedGaps()), share);
    };
    if (through && hasLaw()) {  // lambda- = C_s^T lambda+, u_bar += C_u^T lambda+
      ImpactBars<S> bars =
          wide_ ? doubleDoubleImpactPullback(impact_.inputs(), turned(1)) : impact_.pullback(P_, turned(1));
      before_bar = std::move(bars.before);
      for (std::size_t i = 0; i < bars.model.size(); ++i)
        model_bar[static_cast<std::size_t>(event_.participants[i].body)] += bars.model[i];
      for (std::size_t k = 0; k < parts_.size(); ++k)
        contactPullback(k, bars.contact[k], bars.pair[k], before_bar, scene_bar, model_bar);
      for (std::size_t k = 0; k < parts_.size(); ++k)
        surfacePullback(parts_[k], bars.surface[k], before_bar, scene_bar, model_bar);
    }
    if (through && !projection_.lasting().empty()) {
      const VectorOf<S> gap_bar = projection_.pullback(turned(0.5));
      for (std::size_t k = 0; k < projection_.lasting().size(); ++k) {
        Vec7 bar = Vec7::Zero();
        bar[0] = gap_bar[static_cast<Eigen::Index>(k)];
        scatter(parts_[projection_.lasting()[k]], bar, before_bar, scene_bar, model_bar);
      }
      if (bends_) closingPullback(after_bar, before_bar, scene_bar, model_bar);
    }
    if (hasFixedTime()) {
      for (std::size_t i = 0; i < before_bar.size(); ++i) before_bar[i] += read_bar[i];
      return before_bar;
    }
    // sigma = (lambda+ . F+ - lambda- . F- - time_bar) / D; lambda- += phi_s^T sigma, u_bar += phi_u^T sigma
    S sigma = -time_bar;
    for (std::size_t i = 0; i < before_bar.size(); ++i) {
      before_bar[i] += read_bar[i];
      sigma += fixed_bar[i].dot(rate_after_[i]) - before_bar[i].dot(rate_before_[i]);
    }
    sigma /= guard_rate_;
    for (const Part& part : parts_) scatter(part, Vec7(sigma * part.guard), before_bar, scene_bar, model_bar);
    guardPullback(sigma, before_bar, scene_bar, model_bar);
    return before_bar;
  }

 private:
  std::vector<StateBar> startPullback(std::vector<StateBar> bars, SceneBar& scene_bar,
                                      std::vector<ModelBar>& model_bar) const {
    if constexpr (std::is_same_v<S, double>) {  // held paths have no second derivatives
      StateBar& bar = bars[start_->participant];
      const auto body = static_cast<std::size_t>(event_.participants[start_->participant].body);
      bar = start_->pullback(bar, scene_bar, model_bar[body]);
    }
    return bars;
  }

  VectorOf<S> closedGaps() const {
    const std::vector<std::size_t>& lasting = projection_.lasting();
    VectorOf<S> gaps(lasting.size());
    for (std::size_t k = 0; k < lasting.size(); ++k) gaps[static_cast<Eigen::Index>(k)] = parts_[lasting[k]].gap;
    return gaps;
  }

  // Of the rows and the masses that close the gaps, whose rates are not 0.
  void closingPullback(const std::vector<StateBar>& after_bar, std::vector<StateBar>& before_bar, SceneBar& scene_bar,
                       std::vector<ModelBar>& model_bar) const {
    const std::vector<std::size_t>& lasting = projection_.lasting();
    const auto bars = projection_.bars(closedGaps(), after_bar, impact_.inputs());
    for (std::size_t k = 0; k < lasting.size(); ++k) {
      const Part& part = parts_[lasting[k]];
      Vec12 w = Vec12::Zero();
      Eigen::Index at = 0;
      for (const auto& side : {part.a, part.b}) {
        if (side.participant >= 0)
          w.template segment<6>(at) =
              bars.rows.template block<1, 6>(static_cast<Eigen::Index>(k), 6 * side.participant).transpose();
        at += 6;
      }
      scatter(part, bends_(lasting[k], w), before_bar, scene_bar);
    }
    ImpactBars<S> through = impact_.noBars();
    auto between = impact_.nothingBetween();
    for (std::size_t i = 0; i < before_bar.size(); ++i) {
      if (impact_.inputs().bodies[i].kinematic) continue;
      const auto row = 6 * static_cast<Eigen::Index>(i);
      between.inverse_mass[i] -= bars.held.template segment<3>(row).dot(bars.pushed.template segment<3>(row));
      between.A[i] -= bars.held.template segment<3>(row + 3) * bars.pushed.template segment<3>(row + 3).transpose();
    }
    impact_.betweenPullback(between, through);
    for (std::size_t i = 0; i < before_bar.size(); ++i) {
      before_bar[i] += through.before[i];
      model_bar[static_cast<std::size_t>(event_.participants[i].body)] += through.model[i];
    }
  }

  // Of what the guard has beyond the gaps, normals and points of contacts.
  void guardPullback(const S& sigma, std::vector<StateBar>& before_bar, SceneBar& scene_bar,
                     std::vector<ModelBar>& model_bar) const {
    if constexpr (std::is_same_v<S, double>) {
      if (guard_.by_path) {
        for (std::size_t i = 0; i < guard_.by_path->by_state.size(); ++i) before_bar[i].addScaled(sigma, guard_.by_path->by_state[i]);
        std::vector<ModelBar> models(event_.participants.size());
        guard_.by_path->pullback(sigma, scene_bar, models);
        for (std::size_t i = 0; i < models.size(); ++i) model_bar[static_cast<std::size_t>(event_.participants[i].body)] += models[i];
        return;
      }
    }
    if (guard_.by_slip) {
      const ImpactBars<S> bars = slipPullback(impact_, guard_.slip, sigma);
      for (std::size_t i = 0; i < before_bar.size(); ++i) {
        before_bar[i] += bars.before[i];
        model_bar[static_cast<std::size_t>(event_.participants[i].body)] += bars.model[i];
      }
      scatter(parts_[0], bars.contact[0], before_bar, scene_bar, model_bar);
    }
    if (guard_.border_body < 0) return;
    auto& border = scene_bar.bodies[static_cast<std::size_t>(guard_.border_body)];
    const V3<S> x = -sigma * guard_.weight, theta = -sigma * V3<S>(guard_.border_arm.cross(guard_.weight));
    if (guard_.border_participant < 0) {
      border.position += x;
      border.orientation += theta;
    } else {
      StateBar& before = before_bar[static_cast<std::size_t>(guard_.border_participant)];
      before.x += x;
      before.theta += theta;
    }
    if (guard_.border_rates.size() > 0) border.size -= sigma * guard_.border_rates;
  }

  const Event& event_;
  bool wide_;
  ImpactPass<S> impact_;
  VectorOf<S> P_;
  std::vector<Part> parts_;
  EventGuard<S> guard_;
  PoseProjection<S> projection_;
  Bends bends_;
  std::shared_ptr<const PathStart> start_;
  std::vector<StateBar> rate_before_, rate_after_;
  S guard_rate_ = 0;
};

}  // namespace carom::adjoint_detail

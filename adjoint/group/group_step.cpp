// SPDX-License-Identifier: MIT
#include "adjoint/group/group_step.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/path_limits.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

}  // namespace

std::vector<State> GroupStep::statesAt(double t) const {
  std::vector<State> states;
  for (std::size_t m = 0; m < from.size(); ++m) states.push_back(stateAt(m, t));
  return states;
}

Eigen::VectorXd GroupStepper::scaleOf(double of_x, double of_theta) const {
  Eigen::VectorXd scale(12 * rowAt(scene_.members.size()));
  for (std::size_t m = 0; m < scene_.members.size(); ++m) {
    const BodyModel& model = *scene_.members[m].model;
    const double arm = std::sqrt(model.inertia.maxCoeff() / model.mass);
    scale.segment<12>(12 * rowAt(m)) << Vec3::Constant(of_x), Vec3::Constant(of_theta), Vec3::Constant(scene_.speed),
        Vec3::Constant(scene_.speed * std::max(arm, 0.1 * scene_.length) * model.mass);
  }
  return scale;
}

std::optional<GroupStep> GroupStepper::tried(const Start& start, double length, const GroupStep* like) {
  GroupStep step;
  step.start = start.time, step.length = length, step.from = start.states, step.frozen = start.frozen;
  step.slip.resize(contacts_.size());
  placeInstant(scene_, contacts_, start.states, start.time, start_);
  turning_.clear();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    step.slip[k].fill(start.slip[k]);
    start_.contacts[k].slip = start.slip[k];
    if (contacts_[k].turns() && !step.frozen[k]) turning_.push_back(k);
  }
  slip_rate_.resize(turning_.size()), slope_by_turn_.resize(turning_.size()), rate_by_turn_.resize(turning_.size());
  for (auto& row : rate_by_turn_) row.resize(turning_.size());
  for (Eigen::MatrixXd& by : slope_by_turn_) by.resize(6 * rowAt(scene_.members.size()), Gauss::kNodes);
  Eigen::MatrixXd F;
  try {
    F = guess(step, like);
    if (!solve(step, F)) return std::nullopt;
  } catch (const NotComputable&) {
    if (step.start + 1e-3 * length > step.start) return std::nullopt;  // beyond an end of the path there may be no contact
    throw;
  }
  step.slopes = F * Gauss::get().coefficients.transpose();
  return step;
}

// Slopes as they are at the start, or as another step has them here.
Eigen::MatrixXd GroupStepper::guess(GroupStep& step, const GroupStep* like) {
  const Index n = rowAt(scene_.members.size());
  Eigen::MatrixXd F(12 * n, Gauss::kNodes);
  if (like && step.start + step.length <= like->start + (1 + StepLimits::kGuessed) * like->length) {
    for (int i = 0; i < Gauss::kNodes; ++i) {
      const auto ii = static_cast<std::size_t>(i);
      const double t = step.start + Gauss::get().node[i] * step.length;
      const std::vector<State> states = like->statesAt(t);
      GroupInstant& now = at_[ii];
      placeInstant(scene_, contacts_, states, t, now);
      for (const std::size_t k : turning_) {
        const Vec3 u = now.contacts[k].slipVelocity();
        if (u.dot(step.slip[k][ii]) > 0.5 * u.norm()) step.slip[k][ii] = u.normalized();
      }
      std::vector<Vec3> theta;
      for (std::size_t m = 0; m < states.size(); ++m) theta.push_back(logSO3(states[m].q * step.from[m].q.conjugate()));
      slopesAt(ii, step, states, theta, F);
    }
    return F;
  }
  forces_.solve(contacts_, start_, redundant_);
  for (std::size_t m = 0; m < scene_.members.size(); ++m) {
    ConstrainedVector slope;
    slope << step.from[m].v, start_.members[m].w, forces_.acceleration(m), forces_.moment(m);
    F.middleRows<12>(12 * rowAt(m)) = slope.replicate<1, Gauss::kNodes>();
  }
  return F;
}

// Of the instant that is placed at a node.
void GroupStepper::slopesAt(std::size_t node, const GroupStep& step, const std::vector<State>& states, const std::vector<Vec3>& theta,
                            Eigen::MatrixXd& F) {
  GroupInstant& now = at_[node];
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    GroupContactInstant& c = now.contacts[k];
    c.slip = step.slip[k][node];
    if (contacts_[k].turns()) c.slip = inPlane(c.slip, c.n);
  }
  forces_.solve(contacts_, now, redundant_);
  for (std::size_t m = 0; m < states.size(); ++m)
    F.block<12, 1>(12 * rowAt(m), rowAt(node)) << states[m].v, rotationRate(theta[m], now.members[m].w), forces_.acceleration(m), forces_.moment(m);
}

Eigen::MatrixXd GroupStepper::evaluate(GroupStep& step, const Eigen::MatrixXd& change) {
  Eigen::MatrixXd F(change.rows(), Gauss::kNodes);
  for (std::size_t i = 0; i < Gauss::kNodes; ++i) {
    std::vector<State> states;
    std::vector<Vec3> theta;
    for (std::size_t m = 0; m < step.from.size(); ++m) {
      const ConstrainedVector of = change.block<12, 1>(12 * rowAt(m), rowAt(i));
      states.push_back(ContactStep::moved(step.from[m], of));
      theta.push_back(of.segment<3>(3));
    }
    placeInstant(scene_, contacts_, states, step.start + Gauss::get().node[rowAt(i)] * step.length, at_[i]);
    slopesAt(i, step, states, theta, F);
    for (std::size_t a = 0; a < turning_.size(); ++a) {
      step.slip[turning_[a]][i] = at_[i].contacts[turning_[a]].slip;
      slip_rate_[a].col(rowAt(i)) = forces_.slipRate(turning_[a]);
      const Eigen::VectorXd answer = forces_.answerToTurn(turning_[a]);
      slope_by_turn_[a].col(rowAt(i)) = answer;
      for (std::size_t m = 0; m < step.from.size(); ++m) slope_by_turn_[a].col(rowAt(i)).segment<3>(6 * rowAt(m)) *= at_[i].members[m].inverse_mass;
      for (std::size_t b = 0; b < turning_.size(); ++b) rate_by_turn_[b][a].col(rowAt(i)) = forces_.responseAt(answer, turning_[b]);
    }
  }
  return F;
}

// A step of Newton's method on (n x d).u = 0 for the directions d at all nodes; gives the largest turn, rad.
double GroupStepper::turnSlips(GroupStep& step, Eigen::MatrixXd& next) {
  const Gauss& gauss = Gauss::get();
  const Index turning = rowAt(turning_.size());
  Eigen::VectorXd turn(turning * Gauss::kNodes);
  Eigen::MatrixXd M(turning * Gauss::kNodes, turning * Gauss::kNodes);
  for (Index a = 0; a < turning; ++a) {
    const auto of = static_cast<std::size_t>(a);
    const OfSlip u = (step.length * slip_rate_[of] * gauss.integral.transpose()).colwise() + start_.contacts[turning_[of]].u;
    for (int i = 0; i < Gauss::kNodes; ++i) {
      const GroupContactInstant& c = at_[static_cast<std::size_t>(i)].contacts[turning_[of]];
      const Vec3 across = c.n.cross(c.slip), by = step.length * across;
      const Index row = a * Gauss::kNodes + i;
      turn[row] = -across.dot(u.col(i));
      for (Index b = 0; b < turning; ++b)
        M.row(row).segment<Gauss::kNodes>(b * Gauss::kNodes) =
            gauss.integral.row(i).cwiseProduct(by.transpose() * rate_by_turn_[of][static_cast<std::size_t>(b)]);
      M(row, row) -= c.slip.dot(u.col(i));
    }
  }
  turn = PartialLu(M).solve(turn);
  if (!turn.allFinite()) return kInfinity;
  const double most = turn.cwiseAbs().maxCoeff();
  if (most > 1) turn *= 1 / most;
  for (Index a = 0; a < turning; ++a)
    for (int i = 0; i < Gauss::kNodes; ++i) {
      const auto of = static_cast<std::size_t>(a), ii = static_cast<std::size_t>(i);
      const double by = turn[a * Gauss::kNodes + i];
      const GroupContactInstant& c = at_[ii].contacts[turning_[of]];
      const auto [sine, cosine] = elementary::sincos(by);
      step.slip[turning_[of]][ii] = (cosine * c.slip + sine * c.n.cross(c.slip)).normalized();
      for (std::size_t m = 0; m < step.from.size(); ++m)
        next.col(i).segment<6>(12 * rowAt(m) + 6) += by * slope_by_turn_[of].col(i).segment<6>(6 * rowAt(m));
    }
  return most;
}

bool GroupStepper::solve(GroupStep& step, Eigen::MatrixXd& F) {
  const Eigen::VectorXd weight = step.length * scaleOf(StepLimits::kOfPlaces * scene_.length, StepLimits::kOfPlaces).cwiseInverse();
  double moved_before = kInfinity;
  for (int round = 0; round < StepLimits::kRounds; ++round) {
    const Eigen::MatrixXd change = step.length * F * Gauss::get().integral.transpose();
    if (!change.allFinite()) return false;
    for (std::size_t m = 0; m < step.from.size(); ++m)
      if (change.middleRows<3>(12 * rowAt(m) + 3).cwiseAbs().maxCoeff() > 2) return false;
    Eigen::MatrixXd next = evaluate(step, change);
    double turned = 0;
    if (!turning_.empty()) {
      turned = turnSlips(step, next);
      if (!std::isfinite(turned)) return false;
    }
    const double moved = ((next - F).cwiseAbs().array().colwise() * weight.array()).maxCoeff();
    F = std::move(next);
    if (!std::isfinite(moved)) return false;
    if (moved <= StepLimits::kSettled && turned <= StepLimits::kTurned) return true;
    if (round >= 3 && moved >= 0.5 * moved_before && moved <= StepLimits::kStalled && turned <= StepLimits::kTurned) return true;
    if (round >= 12 && moved > 0.9 * moved_before && moved > 1e-3) return false;
    moved_before = moved;
  }
  return false;
}

double GroupStepper::errorOf(const GroupStep& step) const {
  const Eigen::VectorXd last = step.slopes.col(Gauss::kNodes - 1).cwiseAbs().cwiseMax(0.1 * step.slopes.col(Gauss::kNodes - 2).cwiseAbs());
  return step.length / (2 * (2 * Gauss::kNodes - 1)) * last.cwiseQuotient(scaleOf(scene_.length, 1)).maxCoeff() / StepLimits::kLeftOut;
}

}  // namespace carom::adjoint_detail

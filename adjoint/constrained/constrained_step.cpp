// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_step.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/constrained_forces.hpp"
#include "adjoint/constrained/path_limits.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr int kNodes = Gauss::kNodes;

ConstrainedVector scaleOf(const ConstrainedScene& scene, double of_x, double of_theta) {
  ConstrainedVector scale;
  scale << Vec3::Constant(of_x), Vec3::Constant(of_theta), Vec3::Constant(scene.speed),
      Vec3::Constant(scene.speed * scene.length * scene.model->mass);
  return scale;
}

}  // namespace

Vec3 rotationRate(const Vec3& theta, const Vec3& w) {
  const double a2 = theta.squaredNorm(), a = std::sqrt(a2);
  double c = (1 + a2 / 60 * (1 + a2 / 42 * (1 + a2 / 40))) / 12;
  if (a >= kSmallRotation) {
    const auto [sine, cosine] = elementary::sincos(a / 2);
    c = (1 - a / 2 * cosine / sine) / a2;
  }
  const Vec3 across = theta.cross(w);
  return w - 0.5 * across + c * theta.cross(across);
}

std::vector<Vec3> ContactStep::slipAtNode(int node) const {
  std::vector<Vec3> at;
  for (const auto& of : slip) at.push_back(of[static_cast<std::size_t>(node)]);
  return at;
}

// Directions that are frozen, or of contacts that stick, are the same at all nodes.
void ContactStep::placeSlips(double t, std::vector<Vec3>& at) const {
  const Gauss::Row weights = Gauss::values((t - start) / length) * Gauss::get().coefficients;
  at.resize(slip.size());
  for (std::size_t k = 0; k < slip.size(); ++k) {
    const auto& nodes = slip[k];
    at[k] = nodes.front();
    if (nodes.front() == nodes.back()) continue;
    at[k].setZero();
    for (std::size_t i = 0; i < nodes.size(); ++i) at[k] += weights[static_cast<Eigen::Index>(i)] * nodes[i];
  }
}

State ContactStep::moved(const State& from, const ConstrainedVector& change) {
  const Vec3 theta = change.segment<3>(3);
  return {from.x + change.head<3>(), theta.isZero(0) ? from.q : Quat((expSO3(theta) * from.q).normalized()),
          from.v + change.segment<3>(6), from.L + change.tail<3>()};
}

State ContactStep::goingOn(const State& from, const BodyModel& model, double elapsed) {
  ConstrainedVector change = ConstrainedVector::Zero();
  change.head<3>() = elapsed * from.v;
  change.segment<3>(3) = elapsed * (model.inverseInertiaWorld(from.q.toRotationMatrix()) * from.L);
  return moved(from, change);
}

// |P_k| <= 1 and |P_k'| <= k (k + 1)/2, of (x + 1)/2 twice that; omega = J theta' with |J| <= 1, |J'| <= |theta'|
void widen(TrajectoryBounds& bounds, const ConstrainedSlopes& slopes, double length) {
  const auto most = [&](int row) { return slopes.middleRows<3>(row).colwise().norm().eval(); };
  const auto push = most(6), turn = most(3);
  bounds.variation = std::max(bounds.variation, (Vec3(slopes.block<3, 1>(6, 0)) - bounds.acceleration).norm() +
                                                    push.tail(Gauss::kNodes - 1).sum());
  double bend = 0;
  for (int k = 1; k < Gauss::kNodes; ++k) bend += turn[k] * k * (k + 1) / length;
  const double spin = turn.sum();
  bounds.spin = std::max(bounds.spin, spin);
  bounds.spin_rate = std::max(bounds.spin_rate, bend + spin * spin);
}

// Everything at the nodes of one round, and what it is worked out with.
struct ConstrainedStepper::Nodes {
  using OfSlip = Eigen::Matrix<double, 3, kNodes>;
  ConstrainedForces forces;
  ConstrainedInstant start;
  std::array<ConstrainedInstant, kNodes> at;
  // of each sliding contact with friction: its place in the list of contacts
  std::vector<std::size_t> turning;
  std::vector<OfSlip> slip_rate;  // of these
  // How slopes of v and L answer to a turn of the direction of each of these, and the slip rates of all: [of][by].
  std::vector<Eigen::Matrix<double, 6, kNodes>> slope_by_turn;
  std::vector<std::vector<OfSlip>> rate_by_turn;
  PartialLu turns;
  Eigen::MatrixXd M;
  Eigen::VectorXd turn;
};

ConstrainedStepper::ConstrainedStepper(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, bool redundant)
    : scene_(scene), contacts_(contacts), redundant_(redundant), nodes_(std::make_unique<Nodes>()) {}

ConstrainedStepper::~ConstrainedStepper() = default;

std::optional<ConstrainedStep> ConstrainedStepper::tried(const Start& start, double length, const ConstrainedStep* like) {
  Nodes& nodes = *nodes_;
  ConstrainedStep step;
  step.start = start.time, step.length = length, step.from = start.state, step.frozen = start.frozen;
  step.slip.resize(contacts_.size());
  placeInstant(scene_, contacts_, start.state, start.state.q.toRotationMatrix(), start.time, nodes.start);
  nodes.turning.clear();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    step.slip[k].fill(start.slip[k]);
    nodes.start.contacts[k].slip = start.slip[k];
    if (contacts_[k].mode == ContactMode::slides && contacts_[k].friction > 0 && !step.frozen[k]) nodes.turning.push_back(k);
  }
  const std::size_t turning = nodes.turning.size();
  nodes.slip_rate.resize(turning), nodes.slope_by_turn.resize(turning);
  nodes.rate_by_turn.resize(turning);
  for (auto& row : nodes.rate_by_turn) row.resize(turning);
  ConstrainedSlopes F;
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
ConstrainedSlopes ConstrainedStepper::guess(ConstrainedStep& step, const ConstrainedStep* like) {
  Nodes& nodes = *nodes_;
  ConstrainedSlopes F;
  if (like && step.start + step.length <= like->start + (1 + StepLimits::kGuessed) * like->length) {
    extrapolate(step, *like, F);
    return F;
  }
  nodes.forces.solve(nodes.start, redundant_);
  ConstrainedVector slope;
  slope << step.from.v, nodes.start.body.omega, nodes.forces.acceleration(), nodes.forces.moment();
  return slope.replicate<1, kNodes>();
}

void ConstrainedStepper::extrapolate(ConstrainedStep& step, const ConstrainedStep& like, ConstrainedSlopes& F) {
  Nodes& nodes = *nodes_;
  const Quat back = step.from.q.conjugate();
  for (int i = 0; i < kNodes; ++i) {
    const auto ii = static_cast<std::size_t>(i);
    const double t = step.start + Gauss::get().node[i] * step.length;
    const State s = like.stateAt(t);
    ConstrainedInstant& now = nodes.at[ii];
    placeInstant(scene_, contacts_, s, s.q.toRotationMatrix(), t, now);
    for (const std::size_t k : nodes.turning) {
      const Vec3 u = now.slipAt(k);
      if (u.dot(step.slip[k][ii]) > 0.5 * u.norm()) step.slip[k][ii] = u.normalized();
    }
    slopesAt(ii, step, s, logSO3(s.q * back), F);
  }
}

// Of the instant that is placed at a node.
void ConstrainedStepper::slopesAt(std::size_t node, const ConstrainedStep& step, const State& state, const Vec3& theta,
                           ConstrainedSlopes& F) {
  ConstrainedInstant& now = nodes_->at[node];
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    ContactInstant<double>& c = now.contacts[k];
    c.slip = step.slip[k][node];
    if (c.mode == ContactMode::slides && c.friction > 0) c.slip = inPlane(c.slip, c.n);
  }
  nodes_->forces.solve(now, redundant_);
  F.col(static_cast<Eigen::Index>(node)) << state.v, rotationRate(theta, now.body.omega), nodes_->forces.acceleration(),
      nodes_->forces.moment();
}

// The slopes at the nodes, where the state has changed by so much since the start.
ConstrainedSlopes ConstrainedStepper::evaluate(ConstrainedStep& step, const ConstrainedSlopes& change) {
  Nodes& nodes = *nodes_;
  ConstrainedSlopes F;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const State s = ContactStep::moved(step.from, change.col(column));
    ConstrainedInstant& now = nodes.at[i];
    placeInstant(scene_, contacts_, s, s.q.toRotationMatrix(), step.start + Gauss::get().node[column] * step.length, now);
    slopesAt(i, step, s, change.block<3, 1>(3, column), F);
    for (std::size_t a = 0; a < nodes.turning.size(); ++a) {
      step.slip[nodes.turning[a]][i] = now.contacts[nodes.turning[a]].slip;
      nodes.slip_rate[a].col(column) = nodes.forces.slipRate(nodes.turning[a]);
      const ConstrainedForces::Vec6 answer = nodes.forces.answerToTurn(nodes.turning[a]);
      nodes.slope_by_turn[a].col(column) << answer.head<3>() * now.body.inverse_mass, answer.tail<3>();
      for (std::size_t b = 0; b < nodes.turning.size(); ++b)
        nodes.rate_by_turn[b][a].col(column) = nodes.forces.responseAt(answer, nodes.turning[b]);
    }
  }
  return F;
}

// A step of Newton's method on (n x d).u = 0 for the directions d at all nodes; gives the largest turn, rad.
double ConstrainedStepper::turnSlips(ConstrainedStep& step, ConstrainedSlopes& next, bool anew) {
  Nodes& nodes = *nodes_;
  const Gauss& gauss = Gauss::get();
  const auto turning = static_cast<Eigen::Index>(nodes.turning.size());
  nodes.turn.resize(turning * kNodes);
  if (anew) nodes.M.resize(turning * kNodes, turning * kNodes);
  for (Eigen::Index a = 0; a < turning; ++a) {
    const auto of = static_cast<std::size_t>(a);
    const Nodes::OfSlip u = (step.length * nodes.slip_rate[of] * gauss.integral.transpose()).colwise() +
                            nodes.start.velocityAt(nodes.turning[of]);
    for (int i = 0; i < kNodes; ++i) {
      const ContactInstant<double>& c = nodes.at[static_cast<std::size_t>(i)].contacts[nodes.turning[of]];
      const Vec3 across = c.n.cross(c.slip);
      const Eigen::Index row = a * kNodes + i;
      nodes.turn[row] = -across.dot(u.col(i));
      if (!anew) continue;
      const Vec3 by = step.length * across;
      for (Eigen::Index b = 0; b < turning; ++b)
        nodes.M.row(row).segment<kNodes>(b * kNodes) =
            gauss.integral.row(i).cwiseProduct(by.transpose() * nodes.rate_by_turn[of][static_cast<std::size_t>(b)]);
      nodes.M(row, row) -= c.slip.dot(u.col(i));
    }
  }
  if (anew) nodes.turns.compute(nodes.M);
  nodes.turn = nodes.turns.solve(nodes.turn);
  const double most = nodes.turn.cwiseAbs().maxCoeff();
  if (!nodes.turn.allFinite()) return kInfinity;
  if (most > 1) nodes.turn *= 1 / most;
  for (Eigen::Index a = 0; a < turning; ++a)
    for (int i = 0; i < kNodes; ++i) {
      const auto of = static_cast<std::size_t>(a), ii = static_cast<std::size_t>(i);
      const double by = nodes.turn[a * kNodes + i];
      const ContactInstant<double>& c = nodes.at[ii].contacts[nodes.turning[of]];
      const auto [sine, cosine] = elementary::sincos(by);
      step.slip[nodes.turning[of]][ii] = (cosine * c.slip + sine * c.n.cross(c.slip)).normalized();
      next.col(i).tail<6>() += by * nodes.slope_by_turn[of].col(i);
    }
  return most;
}

bool ConstrainedStepper::solve(ConstrainedStep& step, ConstrainedSlopes& F) {
  const ConstrainedVector weight =
      step.length * scaleOf(scene_, StepLimits::kOfPlaces * scene_.length, StepLimits::kOfPlaces).cwiseInverse();
  double moved_before = kInfinity, turned_before = kInfinity;
  for (int round = 0; round < StepLimits::kRounds; ++round) {
    const ConstrainedSlopes change = step.length * F * Gauss::get().integral.transpose();
    if (!change.allFinite() || change.middleRows<3>(3).cwiseAbs().maxCoeff() > 2) return false;
    ConstrainedSlopes next = evaluate(step, change);
    double turned = 0;
    if (!nodes_->turning.empty()) {
      turned = turnSlips(step, next, round < 2 || turned_before > StepLimits::kTurned);
      if (!std::isfinite(turned)) return false;
    }
    const double moved = ((next - F).cwiseAbs().array().colwise() * weight.array()).maxCoeff();
    F = next;
    if (!std::isfinite(moved)) return false;
    if (moved <= StepLimits::kSettled && turned <= StepLimits::kTurned) return true;
    if (round >= 3 && moved >= 0.5 * moved_before && moved <= StepLimits::kStalled && turned <= StepLimits::kTurned) return true;
    if (round >= 12 && moved > 0.9 * moved_before && moved > 1e-3) return false;
    moved_before = moved, turned_before = turned;
  }
  return false;
}

double ConstrainedStepper::errorOf(const ConstrainedStep& step) const {
  const ConstrainedVector last =
      step.slopes.col(kNodes - 1).cwiseAbs().cwiseMax(0.1 * step.slopes.col(kNodes - 2).cwiseAbs());
  return step.length / (2 * (2 * kNodes - 1)) * last.cwiseQuotient(scaleOf(scene_, scene_.length, 1)).maxCoeff() / StepLimits::kLeftOut;
}

}  // namespace carom::adjoint_detail

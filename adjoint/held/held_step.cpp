// SPDX-License-Identifier: MIT
#include "adjoint/held/held_step.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {


// Rounds of one step, and what the slopes may change by in the last, as a share of the scales.
constexpr int kStageRounds = 40;
constexpr double kStagesSettled = 2e-15, kStagesStalled = 1e-12;
// What polynomials may leave out.
constexpr double kLeftOut = 3e-14;

// Perpendicular to n, unit.
Vec3 inPlane(const Vec3& d, const Vec3& n) { return (d - n.dot(d) * n).normalized(); }

}  // namespace

State HeldStep::moved(const State& from, const HeldVector& change) {
  const Vec3 theta = change.segment<3>(3);
  return {from.x + change.head<3>(), theta.isZero(0) ? from.q : Quat((expSO3(theta) * from.q).normalized()),
          from.v + change.segment<3>(6), from.L + change.tail<3>()};
}

HeldInstant instantOf(const HeldScene& scene, const std::vector<HeldContact>& contacts, const State& state,
                      const std::vector<Vec3>& slip) {
  HeldInstant now;
  const BodyModel& model = *scene.model;
  const Mat3 R = state.q.toRotationMatrix();
  BodyInstant<double>& body = now.body;
  body.v = state.v, body.L = state.L, body.gravity = scene.gravity;
  body.A = model.inverseInertiaWorld(R);
  body.omega = body.A * state.L;
  body.inverse_mass = model.inverse_mass;
  const Pose pose{state.x, model.shapeToWorld(R)};
  now.contacts.resize(contacts.size());
  now.gap_rate.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const HeldContact& held = contacts[k];
    const ContactMotion m = scene.contact(held, k, pose, state.v, body.omega);
    const double sign = held.is_first ? 1 : -1;
    ContactInstant<double>& c = now.contacts[k];
    c.mode = held.mode;
    c.n = sign * m.at.normal, c.normal_rate = sign * m.normal_rate;
    c.r = m.at.point - state.x, c.point_rate = m.point_rate;
    c.friction = held.friction;
    c.slip = slip[k];
    now.gap_rate[k] = m.gap_rate;
  }
  return now;
}

// Everything at the nodes of one round.
struct HeldStepper::Nodes {
  std::array<HeldInstant, Gauss::kNodes> at;
  HeldSlopes slopes;
  // of each sliding contact with friction: its place in the list of contacts
  std::vector<std::size_t> turning;
  std::vector<Eigen::Matrix<double, 3, Gauss::kNodes>> slip_rate;  // of these
  // how slopes of v and L, and the slip rates of all of these, answer to a turn of a direction: by node and contact
  std::vector<std::array<Eigen::Matrix<double, 6, 1>, Gauss::kNodes>> slope_by_turn;
  std::vector<std::vector<std::array<Vec3, Gauss::kNodes>>> rate_by_turn;  // [of][by][node]
};

// Slopes as they are at the start, or as they went on before.
HeldSlopes HeldStepper::guess(HeldStep& step, const HeldInstant& start, const HeldStep* before) const {
  const HeldDynamics<double> forces(start.body, start.contacts, redundant_);
  HeldVector slope;
  slope << step.from.v, start.body.omega, forces.acceleration(), forces.moment();
  HeldSlopes F = slope.replicate<1, Gauss::kNodes>();
  if (!before || step.length > 1.5 * before->length) return F;
  for (int i = 0; i < Gauss::kNodes; ++i)
    F.col(i).tail<6>() = before->slopeAt(step.start + Gauss::get().node[i] * step.length).tail<6>();
  return F;
}

std::optional<HeldStep> HeldStepper::tried(const State& from, double start, double length,
                                           const std::vector<Vec3>& slip, const std::vector<char>& frozen,
                                           const HeldStep* before) const {
  HeldStep step;
  step.start = start, step.length = length, step.from = from, step.frozen = frozen;
  step.slip.resize(contacts_.size());
  for (std::size_t k = 0; k < contacts_.size(); ++k) step.slip[k].fill(slip[k]);
  const HeldInstant at_start = instantOf(scene_, contacts_, from, slip);
  HeldSlopes F = guess(step, at_start, before);
  if (!solve(step, F, at_start)) return std::nullopt;
  step.slopes = F * Gauss::get().coefficients.transpose();
  return step;
}

bool HeldStepper::solve(HeldStep& step, HeldSlopes& F, const HeldInstant& start) const {
  const Gauss& gauss = Gauss::get();
  const double h = step.length;
  Nodes nodes;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (contacts_[k].mode == HeldMode::slides && contacts_[k].friction > 0 && !step.frozen[k]) nodes.turning.push_back(k);
  const std::size_t turning = nodes.turning.size();
  nodes.slip_rate.resize(turning);
  nodes.slope_by_turn.resize(turning);
  nodes.rate_by_turn.assign(turning, std::vector<std::array<Vec3, Gauss::kNodes>>(turning));
  HeldVector scale;
  scale << Vec3::Constant(scene_.speed), Vec3::Constant(scene_.speed / scene_.length), Vec3::Constant(scene_.speed),
      Vec3::Constant(scene_.speed * scene_.length * scene_.model->mass);
  const HeldVector weight = h * scale.cwiseInverse();
  double before = kInfinity;
  std::vector<Vec3> slip(contacts_.size());
  for (int round = 0; round < kStageRounds; ++round) {
    const HeldSlopes change = h * F * gauss.integral.transpose();
    if (!change.allFinite() || change.middleRows<3>(3).cwiseAbs().maxCoeff() > 2) return false;
    HeldSlopes next;
    for (int i = 0; i < Gauss::kNodes; ++i) {
      const auto ii = static_cast<std::size_t>(i);
      const State s = HeldStep::moved(step.from, change.col(i));
      for (std::size_t k = 0; k < contacts_.size(); ++k) slip[k] = step.slip[k][ii];
      HeldInstant& now = nodes.at[ii] = instantOf(scene_, contacts_, s, slip);
      for (std::size_t k = 0; k < contacts_.size(); ++k) {
        ContactInstant<double>& c = now.contacts[k];
        if (c.mode == HeldMode::slides && c.friction > 0) c.slip = step.slip[k][ii] = inPlane(step.slip[k][ii], c.n);
      }
      const HeldDynamics<double> forces(now.body, now.contacts, redundant_);
      next.col(i) << s.v, leftJacobianInverse(Vec3(change.col(i).segment<3>(3))) * now.body.omega, forces.acceleration(),
          forces.moment();
      for (std::size_t a = 0; a < turning; ++a) {
        nodes.slip_rate[a].col(i) = forces.slipRate(nodes.turning[a]);
        const std::vector<Vec3> answer = forces.answerToTurn(nodes.turning[a], redundant_);
        auto& slope = nodes.slope_by_turn[a][ii];
        slope.setZero();
        for (std::size_t k = 0; k < answer.size(); ++k) {
          slope.head<3>() += answer[k] * now.body.inverse_mass;
          slope.tail<3>() += now.contacts[k].r.cross(answer[k]);
        }
        for (std::size_t b = 0; b < turning; ++b) {
          Vec3 d = Vec3::Zero();
          for (std::size_t k = 0; k < answer.size(); ++k)
            d += forces.responseAt(now.contacts[nodes.turning[b]].r, k, answer[k]);
          nodes.rate_by_turn[b][a][ii] = d;
        }
      }
    }
    double turned = 0;
    if (turning > 0) {
      const auto size = static_cast<Eigen::Index>(turning) * Gauss::kNodes;
      Eigen::MatrixXd M(size, size);
      Eigen::VectorXd residual(size);
      for (std::size_t a = 0; a < turning; ++a) {
        const std::size_t k = nodes.turning[a];
        const Vec3 u0 = start.velocityAt(k);
        const Eigen::Matrix<double, 3, Gauss::kNodes> u =
            (h * nodes.slip_rate[a] * gauss.integral.transpose()).colwise() + u0;
        for (int i = 0; i < Gauss::kNodes; ++i) {
          const auto ii = static_cast<std::size_t>(i);
          const ContactInstant<double>& c = nodes.at[ii].contacts[k];
          const Vec3 across = c.n.cross(c.slip);
          const auto row = static_cast<Eigen::Index>(a) * Gauss::kNodes + i;
          residual[row] = across.dot(u.col(i));
          for (std::size_t b = 0; b < turning; ++b)
            for (int j = 0; j < Gauss::kNodes; ++j)
              M(row, static_cast<Eigen::Index>(b) * Gauss::kNodes + j) =
                  h * gauss.integral(i, j) * across.dot(nodes.rate_by_turn[a][b][static_cast<std::size_t>(j)]);
          M(row, row) -= c.slip.dot(u.col(i));
        }
      }
      Eigen::VectorXd turn = -M.partialPivLu().solve(residual);
      if (!turn.allFinite()) return false;
      const double most = turn.cwiseAbs().maxCoeff();
      if (most > 1) turn *= 1 / most;
      turned = most;
      for (std::size_t a = 0; a < turning; ++a)
        for (int i = 0; i < Gauss::kNodes; ++i) {
          const auto ii = static_cast<std::size_t>(i);
          const double by = turn[static_cast<Eigen::Index>(a) * Gauss::kNodes + i];
          const ContactInstant<double>& c = nodes.at[ii].contacts[nodes.turning[a]];
          const auto [sine, cosine] = elementary::sincos(by);
          step.slip[nodes.turning[a]][ii] = (cosine * c.slip + sine * c.n.cross(c.slip)).normalized();
          next.col(i).tail<6>() += by * nodes.slope_by_turn[a][ii];
        }
    }
    const double moved = ((next - F).cwiseAbs().array().colwise() * weight.array()).maxCoeff();
    F = next;
    if (!std::isfinite(moved)) return false;
    if (moved <= kStagesSettled && turned <= 1e-6) return true;
    if (round >= 3 && moved >= 0.5 * before && moved <= kStagesStalled && turned <= 1e-6) return true;
    if (round >= 12 && moved > 0.9 * before && moved > 1e-3) return false;
    before = moved;
  }
  return false;
}

double HeldStepper::errorOf(const HeldStep& step) const {
  HeldVector scale;
  scale << Vec3::Constant(scene_.length), Vec3::Ones(), Vec3::Constant(scene_.speed),
      Vec3::Constant(scene_.speed * scene_.length * scene_.model->mass);
  const HeldVector last = step.slopes.col(Gauss::kNodes - 1).cwiseAbs().cwiseMax(0.1 * step.slopes.col(Gauss::kNodes - 2).cwiseAbs());
  return step.length / (2 * (2 * Gauss::kNodes - 1)) * last.cwiseQuotient(scale).maxCoeff() / kLeftOut;
}

}  // namespace carom::adjoint_detail

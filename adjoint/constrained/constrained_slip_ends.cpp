// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_slip_ends.hpp"

#include <cmath>

#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/constrained/constrained_start_derivative.hpp"
#include "adjoint/constrained/constrained_stretches.hpp"
#include "adjoint/numeric/decompositions.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

// Of the acceleration by a force: what turns a slip less than that does not turn it.
constexpr double kNoTurn = 1e-9;

// Contacts whose slips are 0 at the end of a path: that which ends it, first, and those that come to their end with it, as
// the slips of a body do that slides and spins.
std::vector<std::size_t> contactsThatStop(const ConstrainedPath& path, const ConstrainedInstant& now) {
  const std::optional<std::size_t> first = path.contactThatStops();
  const auto stops = [&](std::size_t k) {
    const PersistentContact& c = path.contacts()[k];
    return c.mode == ContactMode::slides && c.friction > 0 && now.slipAt(k).norm() <= kNoDirectionLeft * path.scene().speed;
  };
  if (!first || !stops(*first)) return {};
  std::vector<std::size_t> found{*first};
  for (std::size_t k = 0; k < path.contacts().size(); ++k)
    if (k != *first && stops(k)) found.push_back(k);
  return found;
}

// The tangents of slips across their ways, by all inputs: a row of each contact.
MatrixXd acrossSlips(const ConstrainedPath& path, const ConstrainedInputs& inputs, double t, const ConstrainedInstant& now,
                     const std::vector<std::size_t>& contacts) {
  MatrixXd rows(contacts.size(), inputs.count);
  ConstrainedRates rates(path.scene(), path.contacts(), inputs, path.stateAt(t), t, followSlips(path));
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vec3 across = acrossSlip(now, contacts[i]);
      const auto u = lanes.body.relativeVelocity(lanes.contacts[contacts[i]]);
      for (int lane = 0; lane < count; ++lane)
        rows(static_cast<Eigen::Index>(i), first + lane) = across.dot(ratesOf(u, static_cast<std::size_t>(lane)));
    }
  });
  return rows;
}

}  // namespace

std::optional<SlipTurns> slipTurns(const ConstrainedPath& path, const ConstrainedInputs& inputs, double t) {
  const ConstrainedInstant now = path.instantAt(t);
  const std::vector<std::size_t> stop = contactsThatStop(path, now);
  if (stop.empty()) return std::nullopt;
  const ConstrainedDynamics forces(now.body, now.contacts, path.redundant());
  const auto count = static_cast<Eigen::Index>(stop.size());
  SlipTurns out{{}, MatrixXd(count, count), Eigen::Matrix<double, 6, Eigen::Dynamic>(6, count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::vector<Vec3> push = forces.answerToTurn(stop[static_cast<std::size_t>(j)], path.redundant());
    const double size = now.body.inverse_mass * push[stop[static_cast<std::size_t>(j)]].norm();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t l = 0; l < push.size(); ++l) force += push[l], moment += now.contacts[l].r.cross(push[l]);
    out.change.col(j) << now.body.inverse_mass * force / size, moment / size;
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t k = stop[static_cast<std::size_t>(i)];
      out.turned(i, j) = acrossSlip(now, k).dot(forces.responseAt(now.contacts[k].r, push)) / size;
    }
  }
  if (!SlipTurns::turns(out.turned)) return std::nullopt;
  out.across = acrossSlips(path, inputs, t, now, stop);
  return out;
}

bool SlipTurns::turns(const MatrixXd& turned) { return std::abs(turned(0, 0)) > kNoTurn; }

MatrixXd SlipTurns::takingBack(const MatrixXd& turned, const MatrixXd& left) {
  const MatrixXd turn = FullLu(turned, kNoTurn).solveColumns(left);
  if ((turned * turn - left).norm() <= kNoTurn * left.norm()) return turn;  // of four corners two turn the rest
  MatrixXd first = MatrixXd::Zero(turn.rows(), turn.cols());  // those that do not turn by themselves follow the first
  first.row(0) = left.row(0) / turned(0, 0);
  return first;
}

}  // namespace carom::adjoint_detail

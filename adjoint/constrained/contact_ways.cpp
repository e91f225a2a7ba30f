// SPDX-License-Identifier: MIT
#include "adjoint/constrained/contact_ways.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/constrained/constrained_share.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// Rank of the rows of contacts: what is smaller than this share of the largest pivot is rounding.
constexpr double kDependentRows = 1e-10;
// Accelerations of contacts at the limit of friction, as a share of the unit, that are none.
constexpr double kHardlyMoves = 1e-7;
constexpr int kDirectionRounds = 60;
constexpr double kMostTurn = 0.5;  // rad, of a direction in one round
// Contacts nearer to each other than this share of their arms are at one point; so are normals whose sine is less.
constexpr double kSameWayPoint = 1e-9;

}  // namespace

ContactWays::ContactWays(const ConstrainedScene& scene, const std::vector<PersistentContact>& candidates, const State& state, double no_slip)
    : candidates_(candidates) {
  std::vector<Vec3> none(candidates.size(), Vec3::Zero());
  now_ = instantOf(scene, candidates, state, scene.time, none);
  pull_ = scene.speed * scene.speed / scene.length;
  force_ = pull_ * scene.model->mass;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Vec3 slip = now_.slipAt(k);
    slips_.push_back(slip.norm() > no_slip);
    direction_.push_back(slips_.back() ? Vec3(slip.normalized()) : Vec3(Vec3::Zero()));
  }
}

void ContactWays::solve(Solved& solved, const std::vector<Way>& ways, const std::vector<Vec3>& direction) const {
  solved.on.clear(), solved.contacts.clear();
  Eigen::Index unknowns = 0;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    if (ways[k] == Way::off) continue;
    solved.on.push_back(k);
    ContactInstant<double> c = now_.contacts[k];
    c.mode = ways[k] == Way::sticks ? ContactMode::sticks : ContactMode::slides;
    c.slip = direction[k];
    unknowns += c.mode == ContactMode::sticks ? 3 : 1;
    solved.contacts.push_back(c);
  }
  solved.forces.emplace(now_.body, solved.contacts, true);
  solved.force.clear();
  for (std::size_t i = 0; i < solved.on.size(); ++i) solved.force.push_back(solved.forces->force(i));
  if (const std::optional<ConstrainedShare> share = shareOf<double>(solved.contacts, *solved.forces))
    for (std::size_t i = 0; i < share->contact.size(); ++i) solved.force[share->contact[i]] += share->push[i];
  solved.redundant = false;
  if (unknowns > 1) {
    solved.redundant = FullLu(solved.forces->matrix(), kDependentRows).rank() < unknowns;
  }
}

bool ContactWays::solveBegins(Solved& solved, const std::vector<Way>& ways) {
  if (std::ranges::none_of(ways, [](Way w) { return w == Way::begins; })) {
    solve(solved, ways, direction_);
    used_ = direction_;
    return true;
  }
  std::optional<std::vector<Vec3>> direction = pulledWays(solved, ways);
  return direction && turnAll(solved, ways, *std::move(direction));
}

std::optional<std::vector<Vec3>> ContactWays::pulledWays(Solved& solved, const std::vector<Way>& ways) const {
  std::vector<Vec3> direction = direction_;
  std::vector<Way> sticking = ways;
  for (Way& w : sticking)
    if (w == Way::begins) w = Way::sticks;
  solve(solved, sticking, direction);
  for (std::size_t i = 0; i < solved.on.size(); ++i) {
    const std::size_t k = solved.on[i];
    if (ways[k] != Way::begins) continue;
    const Vec3 &n = now_.contacts[k].n, f = solved.force[i], along = f - n.dot(f) * n;
    if (!(along.norm() > 0)) return std::nullopt;
    direction[k] = -along.normalized();
  }
  alongGrooves(solved, ways, direction);
  return direction;
}

bool ContactWays::turnAll(Solved& solved, const std::vector<Way>& ways, std::vector<Vec3> direction) {
  for (int round = 0; round < kDirectionRounds; ++round) {
    solve(solved, ways, direction);
    const double turned = turnBegins(solved, ways, direction);
    if (!std::isfinite(turned)) return false;
    if (turned < 1e-14) break;
    if (round == kDirectionRounds - 1 && turned > 1e-9) return false;
  }
  used_ = direction;
  return true;
}

bool ContactWays::accelerates(const Solved& solved, std::size_t i) const {
  const Vec3 &n = now_.contacts[solved.on[i]].n, rate = solved.forces->slipRate(i);
  return (rate - n.dot(rate) * n).norm() > kHardlyMoves * pull_;
}

// A corner that stays on two planes can begin to slip along their line alone.
void ContactWays::alongGrooves(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const {
  for (std::size_t i = 0; i < solved.on.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t k = solved.on[i], l = solved.on[j];
      if (ways[k] != Way::begins || ways[l] != Way::begins) continue;
      const ContactInstant<double>&c = now_.contacts[k], &d = now_.contacts[l];
      const Vec3 line = c.n.cross(d.n);
      if (!((c.r - d.r).norm() <= kSameWayPoint * c.r.norm()) || !(line.norm() > kSameWayPoint)) continue;
      const Vec3 pulled = solved.force[i] + solved.force[j];
      direction[k] = direction[l] = (pulled.dot(line) > 0 ? -1 : 1) * line.normalized();
    }
}

// A step of Newton's method on (n x d).u' = 0 for the directions d of all that begin; gives the largest turn, rad.
double ContactWays::turnBegins(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const {
  std::vector<std::size_t> turning;  // in solved.on
  for (std::size_t i = 0; i < solved.on.size(); ++i)  // at the limit of friction it begins as that pulled
    if (ways[solved.on[i]] == Way::begins && accelerates(solved, i)) turning.push_back(i);
  if (turning.empty()) return 0;
  const auto size = static_cast<Eigen::Index>(turning.size());
  Eigen::MatrixXd J(size, size);
  Eigen::VectorXd r(size);
  for (Eigen::Index b = 0; b < size; ++b) {
    const std::vector<Vec3> answer = solved.forces->answerToTurn(turning[static_cast<std::size_t>(b)], true);
    for (Eigen::Index a = 0; a < size; ++a) {
      const std::size_t i = turning[static_cast<std::size_t>(a)];
      const ContactInstant<double>& c = solved.contacts[i];
      const Vec3 across = c.n.cross(c.slip), rate = solved.forces->slipRate(i);
      J(a, b) = across.dot(solved.forces->responseAt(c.r, answer)) - (a == b ? c.slip.dot(rate) : 0.0);
      r[a] = across.dot(rate);
    }
  }
  Eigen::VectorXd turn = -PartialLu(J).solve(r);
  const double most = turn.cwiseAbs().maxCoeff();
  if (!std::isfinite(most)) return most;
  if (most > kMostTurn) turn *= kMostTurn / most;
  for (Eigen::Index a = 0; a < size; ++a) {
    const std::size_t i = turning[static_cast<std::size_t>(a)];
    const ContactInstant<double>& c = solved.contacts[i];
    const auto [sine, cosine] = elementary::sincos(turn[a]);
    direction[solved.on[i]] = (cosine * c.slip + sine * c.n.cross(c.slip)).normalized();
  }
  return most;
}

}  // namespace carom::adjoint_detail

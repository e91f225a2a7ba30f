// SPDX-License-Identifier: MIT
#include "adjoint/group/group_modes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "adjoint/base/errors.h"
#include "adjoint/contact/cone_program.hpp"
#include "adjoint/contact/cone_terms.hpp"
#include "adjoint/group/group_shares.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// What of a force or an acceleration is rounding, as a share of the unit, and what a mode may be off by at a limit.
constexpr double kModeTolerance = 1e-9;
// The same where ways of a little later are taken.
constexpr double kLaterModes = 1e-3;
// Accelerations of slip below this share of the unit are none.
constexpr double kNoOnset = 1e-9;
constexpr int kGroupRounds = 100, kGroupPrograms = 40, kOnsetRounds = 60;
constexpr double kMostOnsetTurn = 0.5;
// Of so many programs modes are also looked for one contact at a time.
constexpr int kOneByOne = 2;

enum class GroupWay : char { off, sticks, slides, begins };

class GroupModeSearch {
 public:
  GroupModeSearch(const GroupScene& scene, const std::vector<GroupContact>& candidates, const std::vector<State>& states, double t, const GroupHint& hint)
      : scene_(scene), candidates_(candidates), pull_(scene.pull()) {
    now_ = instantOf(scene, candidates, states, t, std::vector<Vec3>(candidates.size(), Vec3::Zero()));
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const Vec3 slip = now_.contacts[k].slipVelocity();
      slips_.push_back(slip.norm() > hint.no_slip);
      direction_.push_back(slips_.back() ? Vec3(slip.normalized()) : Vec3(Vec3::Zero()));
    }
  }

  bool find() { return byPrograms() || newton(closedWays(), direction_) || newton(closedWays(), direction_, false); }

  // The ways of a little later, from the slips of now.
  bool findAs(GroupModeSearch later) {
    later.slips_ = slips_;
    if (!later.find()) return false;
    ways_ = later.ways_;
    tolerance_ = kLaterModes;
    return turnAll(ways_, later.used_) && isConsistent();
  }

  // The ways that the candidates have.
  bool keep() {
    ways_.clear();
    std::vector<Vec3> direction = direction_;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const GroupContact& c = candidates_[k];
      ways_.push_back(c.mode == ContactMode::sticks ? GroupWay::sticks : c.begins ? GroupWay::begins : GroupWay::slides);
      slips_[k] = ways_[k] == GroupWay::slides && rubs(k);
      if (c.begins) direction[k] = c.slip;
    }
    return turnAll(ways_, direction);
  }

  GroupModes answer() const {
    GroupModes modes;
    for (std::size_t k = 0; k < ways_.size(); ++k) {
      if (ways_[k] == GroupWay::off) continue;
      modes.held.push_back(k);
      GroupContact c = candidates_[k];
      c.mode = ways_[k] == GroupWay::sticks ? ContactMode::sticks : ContactMode::slides;
      c.begins = ways_[k] == GroupWay::begins;
      c.slip = c.mode == ContactMode::slides ? used_[k] : Vec3(Vec3::Zero());
      modes.contacts.push_back(c);
    }
    modes.redundant = forces_.dependent();
    return modes;
  }

 private:
  bool rubs(std::size_t k) const { return candidates_[k].friction > 0; }
  GroupWay closedWay(std::size_t k) const { return slips_[k] || !rubs(k) ? GroupWay::slides : GroupWay::sticks; }
  std::vector<GroupWay> closedWays() const {
    std::vector<GroupWay> ways;
    for (std::size_t k = 0; k < candidates_.size(); ++k) ways.push_back(closedWay(k));
    return ways;
  }

  void solve(const std::vector<GroupWay>& ways, const std::vector<Vec3>& direction) {
    on_.clear(), held_.clear(), place_.assign(ways.size(), -1);
    closed_.members = now_.members;
    closed_.contacts.clear();
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (ways[k] == GroupWay::off) continue;
      place_[k] = static_cast<int>(on_.size());
      on_.push_back(k);
      held_.push_back(candidates_[k]);
      closed_.contacts.push_back(now_.contacts[k]);
      GroupContactInstant& c = closed_.contacts.back();
      c.mode = ways[k] == GroupWay::sticks ? ContactMode::sticks : ContactMode::slides;
      c.slip = direction[k];
    }
    forces_.solve(held_, closed_, true);
  }

  Vec3 slipRate(std::size_t k) const { return forces_.slipRateAt(candidates_[k], now_.contacts[k]); }  // whatever its way
  double gapAcceleration(std::size_t k) const {
    const GroupContactInstant& c = now_.contacts[k];
    return c.n.dot(slipRate(k)) + c.normal_rate.dot(c.u);
  }
  Vec3 tangential(std::size_t k, const Vec3& v) const { return v - now_.contacts[k].n.dot(v) * now_.contacts[k].n; }

  // Directions in which contacts begin to slip, from some: those in which they then move. False where these do not come to rest.
  bool turnAll(const std::vector<GroupWay>& ways, std::vector<Vec3> direction) {
    for (int round = 0; round < kOnsetRounds; ++round) {
      for (std::size_t k = 0; k < ways.size(); ++k)
        if (ways[k] == GroupWay::begins) {
          const Vec3 d = tangential(k, direction[k]);
          if (!(d.norm() > 0)) return false;
          direction[k] = d.normalized();
        }
      solve(ways, direction);
      std::vector<std::size_t> turning;
      for (std::size_t k = 0; k < ways.size(); ++k)
        if (ways[k] == GroupWay::begins && tangential(k, slipRate(k)).norm() > kNoOnset * pull_) turning.push_back(k);
      used_ = direction;
      if (turning.empty()) return true;
      const auto size = static_cast<Index>(turning.size());
      Eigen::MatrixXd J(size, size);
      Eigen::VectorXd r(size);
      for (Index b = 0; b < size; ++b) {
        const auto l = static_cast<std::size_t>(place_[turning[static_cast<std::size_t>(b)]]);
        const Eigen::VectorXd answer = forces_.answerToTurn(l);
        for (Index a = 0; a < size; ++a) {
          const std::size_t k = turning[static_cast<std::size_t>(a)];
          const GroupContactInstant& c = closed_.contacts[static_cast<std::size_t>(place_[k])];
          const Vec3 across = c.n.cross(c.slip), rate = slipRate(k);
          J(a, b) = across.dot(forces_.responseAt(answer, static_cast<std::size_t>(place_[k]))) - (a == b ? c.slip.dot(rate) : 0.0);
          r[a] = across.dot(rate);
        }
      }
      Eigen::VectorXd turn = -CompleteOrthogonal(J, 1e-12).solve(r);
      const double most = turn.cwiseAbs().maxCoeff();
      if (!std::isfinite(most)) return false;
      if (most < 1e-14) return true;
      if (round == kOnsetRounds - 1) return most < 1e-9;
      if (most > kMostOnsetTurn) turn *= kMostOnsetTurn / most;
      for (Index a = 0; a < size; ++a) {
        const std::size_t k = turning[static_cast<std::size_t>(a)];
        const GroupContactInstant& c = closed_.contacts[static_cast<std::size_t>(place_[k])];
        const auto [sine, cosine] = elementary::sincos(turn[a]);
        direction[k] = (cosine * c.slip + sine * c.n.cross(c.slip)).normalized();
      }
    }
    return false;
  }

  double forceUnit(std::size_t k) const { return std::max(scene_.forceUnit(candidates_[k]), force(k).norm()); }
  Vec3 force(std::size_t k) const { return place_[k] < 0 ? Vec3(Vec3::Zero()) : share_[static_cast<std::size_t>(place_[k])]; }

  void shareForces() { share_ = sharedForces(scene_, held_, closed_, forces_).force; }

  // How the ways go on where they are not consistent, all at once or that which is furthest off alone; the same where they are.
  std::vector<GroupWay> next(std::vector<Vec3>& direction, bool all) const {
    std::vector<GroupWay> ways = ways_;
    double most = 0;
    const auto change = [&](std::size_t k, GroupWay to, double by) {
      if (!(by > tolerance_) || (!all && !(by > most))) return;
      if (!all) ways = ways_;
      most = by;
      ways[k] = to;
      if (to == GroupWay::begins) direction[k] = -tangential(k, force(k)).normalized();
    };
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const GroupContactInstant& c = now_.contacts[k];
      const Vec3 f = force(k);
      if (ways_[k] == GroupWay::off) {
        change(k, closedWay(k), -gapAcceleration(k) / pull_);
      } else if (c.n.dot(f) < -tolerance_ * forceUnit(k)) {
        change(k, GroupWay::off, -c.n.dot(f) / forceUnit(k));
      } else if (ways_[k] == GroupWay::sticks) {
        change(k, GroupWay::begins, -roomOfFriction(c, f) / forceUnit(k));
      } else if (ways_[k] == GroupWay::begins) {
        change(k, GroupWay::sticks, -used_[k].dot(slipRate(k)) / pull_);
      }
    }
    return ways;
  }
  bool isConsistent() {
    shareForces();
    std::vector<Vec3> direction = used_;
    return next(direction, true) == ways_;
  }

  // On the modes of all contacts at once, until they are consistent.
  bool newton(std::vector<GroupWay> ways, std::vector<Vec3> direction, bool all = true) {
    std::set<std::vector<GroupWay>> seen;
    for (int round = 0; round < kGroupRounds; ++round) {
      if (!seen.insert(ways).second) return false;
      try {
        if (!turnAll(ways, direction)) return false;
      } catch (const NotComputable&) {
        return false;
      }
      ways_ = ways;
      shareForces();
      direction = used_;
      ways = next(direction, all);
      if (ways == ways_) return holdIdle(), true;
    }
    return false;
  }

  // What begins to slip without moving, as the others hold it, sticks: its direction would be any.
  void holdIdle() {
    const std::vector<GroupWay> ways = ways_;
    const std::vector<Vec3> used = used_;
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (ways[k] == GroupWay::begins && tangential(k, slipRate(k)).norm() <= kNoOnset * pull_) ways_[k] = GroupWay::sticks;
    if (ways_ == ways || (turnAll(ways_, used) && isConsistent())) return;
    ways_ = ways;
    turnAll(ways, used);
    shareForces();
  }

  // min f K f / 2 + b f over forces in the cones, those that slip along their normals; then with the shift mu |u'_t| of its last solution,
  // and with the friction of what slips by its last pressures.
  bool byPrograms() {
    const std::size_t n = candidates_.size();
    std::vector<GroupContact> all = candidates_;
    GroupInstant stick = now_;
    for (std::size_t k = 0; k < n; ++k) all[k].mode = stick.contacts[k].mode = ContactMode::sticks;
    GroupForces answers;
    answers.assemble(all, stick);
    const Eigen::MatrixXd& K = answers.matrix();
    ConeProgramOf<double> program;
    program.K = K, program.b = answers.withoutForces();
    for (std::size_t k = 0; k < n; ++k) {
      const GroupContactInstant& c = now_.contacts[k];
      program.normal.push_back(c.n), program.friction.push_back(slips_[k] ? 0 : c.friction);
      program.b.segment<3>(3 * static_cast<Index>(k)) += c.normal_rate.dot(c.u) * c.n;
    }
    program.offset.assign(n, 0.0), program.free.assign(n, 0);
    const Eigen::VectorXd unshifted = program.b;
    for (int i = 0; i < kGroupPrograms; ++i) {
      ConePointOf<double> at;
      try {
        at = solveConeProgram(program);
      } catch (const NotComputable&) {
        return false;
      }
      std::vector<GroupWay> ways;
      std::vector<Vec3> direction = direction_;
      for (std::size_t k = 0; k < n; ++k) {
        if (at.state[k] == ConeState::apex) ways.push_back(GroupWay::off);
        else if (at.state[k] == ConeState::slides && closedWay(k) == GroupWay::sticks) ways.push_back(GroupWay::begins), direction[k] = -at.direction[k];
        else ways.push_back(closedWay(k));
      }
      if (newton(ways, direction) || (i < kOneByOne && newton(ways, direction, false))) return true;
      const ConeTerms<double> terms(program, at);
      Eigen::VectorXd rubs = Eigen::VectorXd::Zero(3 * static_cast<Index>(n)), shift = rubs;
      for (std::size_t k = 0; k < n; ++k) {
        const auto row = 3 * static_cast<Index>(k);
        const GroupContactInstant& c = now_.contacts[k];
        if (slips_[k]) rubs.segment<3>(row) = -c.friction * c.n.dot(Vec3(terms.f.segment<3>(row))) * direction_[k];
        else shift.segment<3>(row) = c.friction * tangential(k, Vec3(terms.V.segment<3>(row))).norm() * c.n;
      }
      program.b = unshifted + K * rubs + shift;
    }
    return false;
  }

  const GroupScene& scene_;
  const std::vector<GroupContact>& candidates_;
  double pull_, tolerance_ = kModeTolerance;
  GroupInstant now_;
  std::vector<char> slips_;
  std::vector<Vec3> direction_, used_;  // of slip: at the start, and as last solved
  std::vector<GroupWay> ways_;
  // of the ways that were solved last
  std::vector<std::size_t> on_;
  std::vector<int> place_;
  std::vector<GroupContact> held_;
  GroupInstant closed_;
  GroupForces forces_;
  std::vector<Vec3> share_;
};

}  // namespace

GroupModes chooseGroupModes(const GroupScene& scene, const std::vector<GroupContact>& candidates, const std::vector<State>& states, double t,
                            const GroupHint& hint) {
  GroupModeSearch search(scene, candidates, states, t, hint);
  if (hint.beyond) {
    GroupModeSearch here = search;
    if (here.findAs(GroupModeSearch(scene, candidates, hint.beyond->first, hint.beyond->second, hint))) return here.answer();
  }
  if (search.find()) return search.answer();
  GroupModes none;
  none.unresolved = "no forces within the friction cones keep them in contact, and none let them separate";
  return none;
}

std::vector<GroupContact> inSameModes(const GroupScene& scene, const std::vector<GroupContact>& contacts, const std::vector<State>& states, double t) {
  GroupModeSearch search(scene, contacts, states, t, {});
  if (!search.keep()) throw NotComputable("the directions in which contacts of bodies that move on each other begin to slip are not known");
  return search.answer().contacts;
}

}  // namespace carom::adjoint_detail

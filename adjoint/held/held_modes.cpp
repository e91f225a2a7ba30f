// SPDX-License-Identifier: MIT
#include "adjoint/held/held_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "adjoint/base/errors.h"
#include "adjoint/base/refuse.hpp"
#include "adjoint/held/held_jam.hpp"
#include "adjoint/held/held_share.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// What of a force or an acceleration is rounding, as a share of the unit; and of a contact that is at its limit.
constexpr double kModeRounding = 1e-10, kAtLimit = 1e-7;
// By what every way is to be inconsistent for a proof that none is.
constexpr double kClearly = 1e-6;
constexpr int kModeRounds = 60, kDirectionRounds = 60;
constexpr double kMostTurn = 0.5;  // rad, of a direction in one round
constexpr std::size_t kEnumerated = 5;
// Contacts nearer to each other than this share of their arms are at one point; so are normals whose sine is less.
constexpr double kOnePoint = 1e-9;

enum class Way : char { off, sticks, slides, begins };  // begins: from no slip

class ModeSearch {
 public:
  ModeSearch(const HeldScene& scene, const std::vector<HeldContact>& candidates, const State& state, double no_slip)
      : candidates_(candidates) {
    std::vector<Vec3> none(candidates.size(), Vec3::Zero());
    now_ = instantOf(scene, candidates, state, none);
    pull_ = scene.speed * scene.speed / scene.length;
    force_ = pull_ * scene.model->mass;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const Vec3 slip = now_.slipAt(k);
      slips_.push_back(slip.norm() > no_slip);
      direction_.push_back(slips_.back() ? Vec3(slip.normalized()) : Vec3(Vec3::Zero()));
    }
  }

  HeldModes run(const ModeHint& hint) {
    std::vector<Way> ways;
    for (std::size_t k = 0; k < candidates_.size(); ++k) ways.push_back(closedWay(k));
    for (const std::size_t k : hint.idle) ways[k] = Way::off;
    if (hint.contact >= 0) {
      const auto at = static_cast<std::size_t>(hint.contact);
      if (hint.cause == TransitionCause::lifts) ways[at] = Way::off, lifted_ = hint.contact;
      if (hint.cause == TransitionCause::slips && !slips_[at]) beginAtLimit(ways, at);
    }
    if (settle(ways) || enumerate()) return answer();
    HeldModes modes;
    modes.unresolved = whyNone();
    return modes;
  }

  HeldModes as() {
    for (const HeldContact& c : candidates_)
      ways_.push_back(c.mode == HeldMode::sticks ? Way::sticks : c.begins ? Way::begins : Way::slides);
    if (solveBegins(found_, ways_)) return answer();
    HeldModes modes;
    modes.unresolved = "the direction in which they begin to slip was not found";
    return modes;
  }

 private:
  struct Solved {
    std::vector<std::size_t> on;
    std::vector<ContactInstant<double>> contacts;
    bool redundant = false;
    std::optional<HeldDynamics> forces;
    std::vector<Vec3> force;  // of the best share

    double pressing(std::size_t i) const { return contacts[i].n.dot(force[i]); }
  };

  std::string whyNone() const {
    std::vector<ContactInstant<double>> contacts = now_.contacts;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      contacts[k].mode = closedWay(k) == Way::sticks ? HeldMode::sticks : HeldMode::slides;
      contacts[k].slip = direction_[k];
    }
    const std::optional<HeldJam> jam = jamOf(now_.body, contacts);
    if (!jam && tried_ > 0)
      return textOf(3, "they jam (Painleve): of the ", tried_, " ways in which they may stick, slide, begin to slip or part none keeps to Coulomb's law");
    if (!jam) return "no forces within the cones of friction hold them, and none part them";
    return textOf(3, "they jam (Painleve): every force within the cones of friction presses some of them deeper, in a weighted mean by ",
                  jam->deeper, " m/s^2 or more");
  }

  bool rubs(std::size_t k) const { return candidates_[k].friction > 0; }
  Way closedWay(std::size_t k) const { return slips_[k] || !rubs(k) ? Way::slides : Way::sticks; }

  void solve(Solved& solved, const std::vector<Way>& ways, const std::vector<Vec3>& direction) const {
    solved.on.clear(), solved.contacts.clear();
    Eigen::Index unknowns = 0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (ways[k] == Way::off) continue;
      solved.on.push_back(k);
      ContactInstant<double> c = now_.contacts[k];
      c.mode = ways[k] == Way::sticks ? HeldMode::sticks : HeldMode::slides;
      c.slip = direction[k];
      unknowns += c.mode == HeldMode::sticks ? 3 : 1;
      solved.contacts.push_back(c);
    }
    solved.forces.emplace(now_.body, solved.contacts, true);
    solved.force.clear();
    for (std::size_t i = 0; i < solved.on.size(); ++i) solved.force.push_back(solved.forces->force(i));
    if (const std::optional<HeldShare> share = shareOf<double>(solved.contacts, *solved.forces))
      for (std::size_t i = 0; i < share->contact.size(); ++i) solved.force[share->contact[i]] += share->push[i];
    solved.redundant = false;
    if (unknowns > 1) {
      solved.redundant = FullLu(solved.forces->matrix(), kModeRounding).rank() < unknowns;
    }
  }

  // All that stick at the limit of friction begin to slip with the one that is known to.
  void beginAtLimit(std::vector<Way>& ways, std::size_t first) {
    solve(found_, ways, direction_);
    for (std::size_t i = 0; i < found_.on.size(); ++i) {
      const std::size_t k = found_.on[i];
      if (ways[k] != Way::sticks) continue;
      const Vec3 &n = now_.contacts[k].n, f = found_.force[i];
      const double pressing = n.dot(f), room = now_.contacts[k].friction * pressing - (f - pressing * n).norm();
      if (k == first || room <= kAtLimit * force_) ways[k] = Way::begins;
    }
  }

  // The directions in which contacts begin to slip: those of the friction that held them last, then those in which they
  // then move. False where these do not come to rest.
  bool solveBegins(Solved& solved, const std::vector<Way>& ways) {
    std::vector<Vec3> direction = direction_;
    if (std::ranges::none_of(ways, [](Way w) { return w == Way::begins; })) {
      solve(solved, ways, direction);
      used_ = direction;
      return true;
    }
    std::vector<Way> sticking = ways;
    for (Way& w : sticking)
      if (w == Way::begins) w = Way::sticks;
    solve(solved, sticking, direction);
    for (std::size_t i = 0; i < solved.on.size(); ++i) {
      const std::size_t k = solved.on[i];
      if (ways[k] != Way::begins) continue;
      const Vec3 &n = now_.contacts[k].n, f = solved.force[i], along = f - n.dot(f) * n;
      if (!(along.norm() > 0)) return false;
      direction[k] = -along.normalized();
    }
    alongGrooves(solved, ways, direction);
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

  // A corner that stays on two planes can begin to slip along their line alone.
  void alongGrooves(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const {
    for (std::size_t i = 0; i < solved.on.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t k = solved.on[i], l = solved.on[j];
        if (ways[k] != Way::begins || ways[l] != Way::begins) continue;
        const ContactInstant<double>&c = now_.contacts[k], &d = now_.contacts[l];
        const Vec3 line = c.n.cross(d.n);
        if (!((c.r - d.r).norm() <= kOnePoint * c.r.norm()) || !(line.norm() > kOnePoint)) continue;
        const Vec3 pulled = solved.force[i] + solved.force[j];
        direction[k] = direction[l] = (pulled.dot(line) > 0 ? -1 : 1) * line.normalized();
      }
  }

  // A step of Newton's method on (n x d).u' = 0 for the directions d of all that begin; gives the largest turn, rad.
  double turnBegins(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const {
    std::vector<std::size_t> turning;  // in solved.on
    for (std::size_t i = 0; i < solved.on.size(); ++i) {
      const Vec3 &n = now_.contacts[solved.on[i]].n, rate = solved.forces->slipRate(i);
      // at the limit of friction it begins as that pulled
      if (ways[solved.on[i]] == Way::begins && (rate - n.dot(rate) * n).norm() > kAtLimit * pull_) turning.push_back(i);
    }
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

  // Whether the ways are consistent; else which is to be changed into what.
  struct Change {
    std::size_t contact = 0;
    Way to = Way::off;
    double by = 0;  // share of the unit of force or acceleration
  };
  std::optional<Change> violated(const Solved& solved, const std::vector<Way>& ways) const {
    double most = 0;
    std::optional<Change> change;
    for (std::size_t i = 0; i < solved.on.size(); ++i) {
      const double share = -solved.pressing(i) / force_;
      if (share > std::max(most, kModeRounding)) most = share, change = {solved.on[i], Way::off, share};
    }
    if (change) return change;
    for (std::size_t i = 0; i < solved.on.size(); ++i) {
      const std::size_t k = solved.on[i];
      const double pressing = solved.pressing(i);
      if (ways[k] == Way::sticks) {
        const double share =
            ((solved.force[i] - pressing * now_.contacts[k].n).norm() - now_.contacts[k].friction * pressing) / force_;
        if (share > std::max(most, kModeRounding)) most = share, change = {k, Way::begins, share};
      }
    }
    if (change) return change;
    for (std::size_t i = 0; i < solved.on.size(); ++i) {
      const std::size_t k = solved.on[i];
      if (ways[k] != Way::begins) continue;
      const double against = -solved.forces->slipRate(i).dot(used_[k]) / pull_;
      if (against > std::max(most, kAtLimit)) most = against, change = {k, Way::sticks, against};
    }
    if (change) return change;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      if (ways[k] != Way::off || static_cast<int>(k) == lifted_) continue;
      const double falls = -solved.forces->gapAcceleration(now_.contacts[k]) / pull_;
      if (falls > std::max(most, kModeRounding)) most = falls, change = {k, closedWay(k), falls};
    }
    return change;
  }

  bool settle(std::vector<Way> ways) {
    std::set<std::vector<Way>> seen;
    for (int round = 0; round < kModeRounds; ++round) {
      if (!seen.insert(ways).second) return false;
      if (!solveBegins(found_, ways)) return false;
      const std::optional<Change> change = violated(found_, ways);
      if (!change) {
        ways_ = ways;
        return true;
      }
      ways[change->contact] = change->to;
    }
    return false;
  }

  // All combinations, those with most that sticks first.
  bool enumerate() {
    if (candidates_.size() > kEnumerated) return false;
    std::vector<std::vector<Way>> all{{}};
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      std::vector<std::vector<Way>> longer;
      for (const auto& ways : all)
        for (const Way w : {Way::sticks, Way::begins, Way::slides, Way::off}) {
          if (slips_[k] || !rubs(k) ? w == Way::sticks || w == Way::begins : w == Way::slides) continue;
          longer.push_back(ways);
          longer.back().push_back(w);
        }
      all = std::move(longer);
    }
    const auto loose = [](const std::vector<Way>& ways) {
      return std::ranges::count_if(ways, [](Way w) { return w != Way::sticks; });
    };
    std::ranges::stable_sort(all, {}, loose);
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<Way>& ways : all) {
      const std::optional<Change> change = solveBegins(found_, ways) ? violated(found_, ways) : Change{};
      if (!change) {
        ways_ = ways;
        return true;
      }
      least = std::min(least, change->by);
    }
    if (least > kClearly) tried_ = all.size();
    return false;
  }

  HeldModes answer() const {
    HeldModes modes;
    modes.redundant = found_.redundant;
    modes.acceleration = found_.forces->acceleration();
    modes.spin_rate = found_.forces->spinRate();
    for (std::size_t i = 0; i < found_.on.size(); ++i) {
      const std::size_t k = found_.on[i];
      HeldContact c = candidates_[k];
      c.mode = found_.contacts[i].mode;
      c.begins = ways_[k] == Way::begins;
      c.slip = c.mode == HeldMode::slides && rubs(k) ? used_[k] : Vec3(Vec3::Zero());
      modes.held.push_back(k);
      modes.contacts.push_back(c);
    }
    return modes;
  }

  const std::vector<HeldContact>& candidates_;
  HeldInstant now_;
  double pull_ = 0, force_ = 0;
  std::vector<char> slips_;
  std::vector<Vec3> direction_, used_;
  std::vector<Way> ways_;
  int lifted_ = -1;
  std::size_t tried_ = 0;  // all ways there are, where none is consistent
  Solved found_;
};

}  // namespace

HeldModes chooseModes(const HeldScene& scene, const std::vector<HeldContact>& candidates, const State& state,
                      const ModeHint& hint, double no_slip) {
  return ModeSearch(scene, candidates, state, no_slip).run(hint);
}

HeldModes modesAs(const HeldScene& scene, const std::vector<HeldContact>& contacts, const State& state) {
  return ModeSearch(scene, contacts, state, 0).as();
}

}  // namespace carom::adjoint_detail

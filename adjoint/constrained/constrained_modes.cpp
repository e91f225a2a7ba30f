// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "adjoint/base/errors.h"
#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/contact_ways.hpp"
#include "adjoint/constrained/constrained_jam.hpp"
#include "adjoint/constrained/constrained_program.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// What of a force or an acceleration is rounding, as a share of the unit; and of a contact that is at its limit.
constexpr double kModeRounding = 1e-10, kAtLimit = 1e-7;
// By what every way is to be inconsistent for a proof that none is.
constexpr double kClearly = 1e-6;
// By what forces and accelerations may change until the ways are decided.
constexpr double kBeyond = 1e-3;
constexpr int kModeRounds = 60;
constexpr std::size_t kEnumerated = 5;
// Directions from which those of slips that begin are looked for all around, for one contact or two.
constexpr int kAround = 16;
constexpr std::size_t kMostAround = 2;
// Directions that are no further apart are one, which has turned a little.
constexpr double kSameWay = 0.03;

class ModeSearch : private ContactWays {
 public:
  using ContactWays::ContactWays;

  ConstrainedModes run(const ModeHint& hint) {
    std::vector<Way> ways = closedWays(hint);
    if (hint.contact >= 0) {
      const auto at = static_cast<std::size_t>(hint.contact);
      if (hint.cause == TransitionCause::lifts) ways[at] = Way::off, lifted_ = hint.contact;
      if (hint.cause == TransitionCause::slips && !slips_[at]) beginAtLimit(ways, at);
    }
    return find(ways) ? answer() : unresolved(whyNone());
  }

  // The ways that hold a little later, if they do here to what changes in between.
  std::optional<ConstrainedModes> runBeyond(ModeSearch later, const ModeHint& hint) {
    later.slips_ = slips_;
    if (!later.find(closedWays(hint))) return std::nullopt;
    ways_ = later.ways_;
    const auto holds = [&] {
      const std::optional<Change> change = violated(found_, ways_);
      return !change || change->by <= kBeyond;
    };
    const bool pulled = solveBegins(found_, ways_) && holds();
    if (pulled && beginsAs(later.used_)) return answer();
    if (turnAll(found_, ways_, later.used_) && holds() && (!pulled || beginsAtOnce())) return answer();
    if (pulled && solveBegins(found_, ways_)) return answer();
    return std::nullopt;
  }

  ConstrainedModes as() {
    for (const PersistentContact& c : candidates_)
      ways_.push_back(c.mode == ContactMode::sticks ? Way::sticks : c.begins ? Way::begins : Way::slides);
    return solveBegins(found_, ways_) ? answer() : unresolved("the direction in which they begin to slip was not found");
  }

 private:
  std::vector<Way> closedWays(const ModeHint& hint) const {
    std::vector<Way> ways;
    for (std::size_t k = 0; k < candidates_.size(); ++k) ways.push_back(closedWay(k));
    for (const std::size_t k : hint.idle) ways[k] = Way::off;
    return ways;
  }
  bool find(const std::vector<Way>& first) { return settle(first) || enumerate(false) || byProgram() || enumerate(true); }
  static ConstrainedModes unresolved(std::string why) {
    ConstrainedModes modes;
    modes.unresolved = std::move(why);
    return modes;
  }

  std::string whyNone() const {
    std::vector<ContactInstant<double>> contacts = now_.contacts;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      contacts[k].mode = closedWay(k) == Way::sticks ? ContactMode::sticks : ContactMode::slides;
      contacts[k].slip = direction_[k];
    }
    const std::optional<ConstrainedJam> jam = jamOf(now_.body, contacts);
    if (!jam && tried_ > 0)
      return textOf(3, "they jam (Painleve): of the ", tried_, " combinations of sticking, sliding, beginning to slip and separating none satisfies Coulomb's law");
    if (!jam) return "no forces within the friction cones keep them in contact, and none let them separate";
    return textOf(3, "they jam (Painleve): every force within the friction cones accelerates some of them into penetration, in a weighted mean by ",
                  jam->deeper, " m/s^2 or more");
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

  bool beginsAs(const std::vector<Vec3>& direction) const {
    for (std::size_t k = 0; k < ways_.size(); ++k)
      if (ways_[k] == Way::begins && !((used_[k] - direction[k]).norm() <= kSameWay)) return false;
    return true;
  }
  // With an acceleration, though the contact stuck until then: friction turns where it begins.
  bool beginsAtOnce() const {
    for (std::size_t i = 0; i < found_.on.size(); ++i)
      if (ways_[found_.on[i]] == Way::begins && accelerates(found_, i)) return true;
    return false;
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

  // As forces within the cones hold what has no slip; where others have, the program is none.
  bool byProgram() {
    if (std::ranges::any_of(slips_, [](char slips) { return slips; })) return false;
    return modesByProgram(now_.body, now_.contacts, [&](const ProgramModes& modes) {
      std::vector<Way> ways;
      std::vector<Vec3> direction = direction_;
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        ways.push_back(modes.state[k] == ConeState::apex ? Way::off : closedWay(k));
        if (modes.state[k] != ConeState::slides || !rubs(k)) continue;
        ways[k] = Way::begins, direction[k] = modes.direction[k];
      }
      if (!turnAll(found_, ways, std::move(direction)) || violated(found_, ways)) return false;
      ways_ = ways;
      return true;
    });
  }

  std::optional<Change> judged(const std::vector<Way>& ways) {
    return solveBegins(found_, ways) ? violated(found_, ways) : Change{};
  }

  // The same with directions of what begins from all around: where friction is high, a slip need not begin as it pulled.
  std::optional<Change> judgedAround(const std::vector<Way>& ways) {
    const std::optional<Change> change = judged(ways);
    std::vector<std::size_t> begin;
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (ways[k] == Way::begins) begin.push_back(k);
    if (!change || begin.empty() || begin.size() > kMostAround) return change;
    const std::optional<std::vector<Vec3>> pulled = pulledWays(found_, ways);
    if (!pulled) return change;
    double least = change->by;
    for (int start = 1; start < (begin.size() == 1 ? kAround : kAround * kAround); ++start) {
      std::vector<Vec3> direction = *pulled;
      for (std::size_t i = 0, left = static_cast<std::size_t>(start); i < begin.size(); ++i, left /= kAround) {
        const Vec3& d = (*pulled)[begin[i]];
        const auto [sine, cosine] = elementary::sincos(2 * std::numbers::pi / kAround * static_cast<double>(left % kAround));
        direction[begin[i]] = cosine * d + sine * now_.contacts[begin[i]].n.cross(d);
      }
      if (!turnAll(found_, ways, std::move(direction))) continue;
      const std::optional<Change> other = violated(found_, ways);
      if (!other) return std::nullopt;
      least = std::min(least, other->by);
    }
    return Change{change->contact, change->to, least};
  }

  // All combinations, those with most that sticks first.
  bool enumerate(bool around) {
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
      const std::optional<Change> change = around ? judgedAround(ways) : judged(ways);
      if (!change) {
        ways_ = ways;
        return true;
      }
      least = std::min(least, change->by);
    }
    if (around && least > kClearly) tried_ = all.size();
    return false;
  }

  ConstrainedModes answer() const {
    ConstrainedModes modes;
    modes.redundant = found_.redundant;
    modes.acceleration = found_.forces->acceleration();
    modes.spin_rate = found_.forces->spinRate();
    for (std::size_t i = 0; i < found_.on.size(); ++i) {
      const std::size_t k = found_.on[i];
      PersistentContact c = candidates_[k];
      c.mode = found_.contacts[i].mode;
      c.begins = ways_[k] == Way::begins;
      c.slip = c.mode == ContactMode::slides && rubs(k) ? used_[k] : Vec3(Vec3::Zero());
      modes.held.push_back(k);
      modes.contacts.push_back(c);
    }
    return modes;
  }

  std::vector<Way> ways_;
  int lifted_ = -1;
  std::size_t tried_ = 0;  // all ways there are, where none is consistent
  Solved found_;
};

}  // namespace

ConstrainedModes chooseModes(const ConstrainedScene& scene, const std::vector<PersistentContact>& candidates, const State& state,
                      const ModeHint& hint, double no_slip) {
  ModeSearch search(scene, candidates, state, no_slip);
  if (hint.beyond) {
    ConstrainedScene later = scene;
    later.time = hint.beyond->second;
    if (std::optional<ConstrainedModes> modes = search.runBeyond(ModeSearch(later, candidates, hint.beyond->first, no_slip), hint))
      return *std::move(modes);
  }
  return search.run(hint);
}

ConstrainedModes modesAs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& state) {
  return ModeSearch(scene, contacts, state, 0).as();
}

}  // namespace carom::adjoint_detail

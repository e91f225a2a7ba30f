// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"

/// Impacts that a motion shall have, by the bodies that meet. Internal to editing/.
namespace carom::editing_detail {

/// Whether a constraint asks for impacts to come: a hit, or a sequence.
inline bool requiresImpacts(const Constraint& constraint) { return constraint.hits || !constraint.sequence.empty(); }

/// What a motion lacks of an impact that shall come: bodies that shall meet, and when they may. Without pairs: of one
/// with anybody, or of a body that shall come to rest.
struct LackingImpact {
  int constraint = -1;                     ///< index of the Constraint
  std::vector<std::pair<int, int>> pairs;  ///< bodies, one of these pairs
  double from = 0, to = 0;                 ///< s
  double share = 0;                        ///< of what was required that came, in [0, 1)
  std::string sentence;                    ///< for people
};

/// A Hit whose names are indices.
class BoundHit {
 public:
  /// Throws InputError that begins with `where`.
  BoundHit(const Scene& scene, const std::string& body, const Hit& hit, const std::string& where);

  /// The event; of those that are allowed, the first in `during`, else the nearest to it.
  std::optional<int> find(const Motion& motion) const;
  /// Whether a motion that goes on may still get another answer.
  bool isSettled(const Motion& motion) const;
  LackingImpact lacking(const Motion& motion) const;
  bool hasSpan() const { return from_ > 0 || to_ < std::numeric_limits<double>::infinity(); }
  double from() const { return from_; }  ///< s, of `during`
  double to() const { return to_; }      ///< s, of `during`

 private:
  struct Other {
    int body = -1, n = 1, with = -1;
  };
  static Other bind(const Scene& scene, const ImpactOf& impact, const std::string& where);
  /// Time of another impact; null where it does not come.
  static std::optional<double> timeOf(const Motion& motion, const Other& other);

  int body_, with_;
  double from_ = 0, to_ = std::numeric_limits<double>::infinity();
  std::optional<Other> after_, before_;
  std::string words_;  // "'cue' hits 'yellow' between 1 s and 2 s"
};

/// A required sequence of impacts whose patterns are sets of bodies.
class BoundSequence {
 public:
  /// Throws InputError that begins with `where`: what matches no body, a text that is not two names and, in parentheses,
  /// features that meet.
  BoundSequence(const Scene& scene, const std::vector<std::string>& impacts, const std::string& where);

  /// The event with which it is complete.
  std::optional<int> find(const Motion& motion) const;
  LackingImpact lacking(const Motion& motion) const;
  /// One of the bodies whose impacts it is about.
  int body() const;

 private:
  struct Entry {
    std::string text;
    bool anything = false;  ///< "..."
    std::vector<bool> a, b;  ///< bodies that match
    std::string features = {};  ///< pattern of what meets, "face -z on *", seen from a; empty: anything
  };
  struct Match {
    std::size_t entries = 0;  ///< that came, as far as it goes
    int last = -1;            ///< event of the last of them
    int against = -1;         ///< the event that did not fit; -1: none came
    bool complete = false;
  };
  static Entry parse(const Scene& scene, const std::string& text, const std::string& where);
  bool isAbout(const Motion& motion, const Event& event) const;
  static bool fits(const Motion& motion, const Event& event, const Entry& entry);
  Match match(const Motion& motion) const;

  std::vector<Entry> entries_;
  std::vector<bool> subjects_, named_;
};

}  // namespace carom::editing_detail

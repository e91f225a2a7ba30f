// SPDX-License-Identifier: MIT
#include "editing/session/session_words.hpp"

#include <algorithm>
#include <cstdlib>

#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"

namespace carom::editing_detail {
namespace {

/// More groups of bodies than this are counted, not named.
constexpr std::size_t kNamedGroups = 3;

/// How the impacts of one group of bodies changed.
struct GroupChange {
  std::string names;
  int more = 0;  ///< impacts that came, without those that went
  bool order = false, contact = false;
};

std::string namesOfGroup(const Motion& motion, int event) {
  std::vector<int> bodies;
  for (const Contact& c : motion.events[static_cast<std::size_t>(event)].contacts)
    if (!c.held) bodies.push_back(c.a), bodies.push_back(c.b);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::vector<std::string> names;
  for (const int b : bodies) names.push_back("'" + motion.scene->bodies[static_cast<std::size_t>(b)].name + "'");
  return listOf(names);
}

std::string wordsOf(const GroupChange& group) {
  if (group.order) return group.names + " meet in another order";
  if (group.contact) return "persistent contact changes";
  if (group.more == 0) return group.names + " meet differently";
  const int times = std::abs(group.more);
  const std::string count = times == 1 ? "once" : std::to_string(times) + " times";
  return group.names + " meet " + count + (group.more > 0 ? " more" : " less");
}

}  // namespace

std::string wordsOf(const When& at) {
  if (at.span) return "between " + brief(at.span->first) + " s and " + brief(at.span->second) + " s";
  if (at.rest) return "at rest";
  return "at " + (at.impact == 0 ? brief(at.time) + " s" : describeImpact(at, "its impact"));
}

std::string wordsOf(const Constraint& constraint) {
  const std::string name = "'" + constraint.body + "'";
  if (constraint.hits) return name + " hits '" + constraint.hits->with + "'";
  if (!constraint.sequence.empty()) return "the required impact sequence";
  return constraint.targets.empty() ? name : name + " " + wordsOf(constraint.at);
}

std::string earlyEnd(const Motion& motion) {
  if (motion.status == MotionStatus::complete) return "";
  // of contact that is not modelled the motion tells place, time and number of impacts, with all digits
  const bool contact = motion.status == MotionStatus::cascade || motion.status == MotionStatus::unresolved_contact;
  const std::size_t digits = std::min(motion.message.find(" from t = "), motion.message.find(", until t = "));
  const std::string why = motion.message.substr(0, contact ? digits : std::string::npos);
  return "The motion ends at " + brief(motion.end) + " s: " + why + ".";
}

std::string otherImpacts(const std::vector<SequenceChange>& changes, const Motion& before, const Motion& after) {
  std::vector<GroupChange> groups;
  for (const SequenceChange& change : changes) {
    GroupChange one;
    one.contact = change.kind == SequenceChange::Kind::contact;
    one.order = change.kind == SequenceChange::Kind::order;
    if (change.before < 0 && change.after < 0) {
      one.contact = true;
    } else if (!one.contact) {
      one.names = change.before >= 0 ? namesOfGroup(before, change.before) : namesOfGroup(after, change.after);
    }
    one.more = (change.kind == SequenceChange::Kind::came) - (change.kind == SequenceChange::Kind::went);
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const GroupChange& g) {
      return g.names == one.names && g.order == one.order && g.contact == one.contact;
    });
    if (known == groups.end()) {
      groups.push_back(std::move(one));
    } else {
      known->more += one.more;
    }
  }
  if (groups.empty()) return "";
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(kNamedGroups, groups.size()); ++i) parts.push_back(wordsOf(groups[i]));
  if (groups.size() > kNamedGroups) parts.push_back(std::to_string(groups.size() - kNamedGroups) + " more groups differ");
  return "The impacts have changed: " + listOf(parts) + ".";
}

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
// What an update says: the motion, how far it is from what was asked for, and why.
#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/instants.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session/session_words.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

std::string behind(const std::string& sentence) { return sentence.empty() ? "" : ". " + sentence; }

}  // namespace

BodyState editing_detail::stateAtMoment(const Motion& motion, const std::string& body, const When& at,
                                        const std::string& where) {
  const auto find = [&](const std::string& name) {
    return findAt(where, [&] { return bodyIndex(*motion.scene, name); });
  };
  const int index = find(body);
  if (at.span) throw InputError(where, "found a span of time, expected a time, an impact or rest");
  const std::string within = " within " + number(motion.end) + " s" + behind(earlyEnd(motion));
  if (at.rest) {
    checkWhen(at, where);
    const auto instant = findRest(motion, index);
    if (!instant) throw InputError(where, "found '" + body + "' at rest, expected a body that comes to rest" + within);
    return stateAt(motion, index, *instant);
  }
  if (at.impact == 0 && at.with.empty()) {
    if (!(at.time >= 0 && at.time <= motion.end))
      throw InputError(where, "found " + number(at.time) + " s, expected a time in the motion, 0 to " +
                                  number(motion.end) + " s" + behind(earlyEnd(motion)));
    return motion.stateAt(index, at.time);
  }
  if (at.impact < 1) throw InputError(where, "found impact " + std::to_string(at.impact) + ", expected 1 or more");
  const auto event = motion.findImpact(index, at.impact, at.with.empty() ? -1 : find(at.with));
  if (!event)
    throw InputError(where, "found impact " + std::to_string(at.impact) +
                                (at.with.empty() ? "" : " with '" + at.with + "'") + " of '" + body +
                                "', expected one that comes" + within);
  return motion.stateBefore(*event, index);
}

std::shared_ptr<const Motion> EditSession::State::simulated(const std::shared_ptr<const Scene>& scene,
                                                            double duration) const {
  auto motion = std::make_shared<Motion>(simulate(*scene, contacts, duration));
  motion->scene = scene;
  return motion;
}

std::shared_ptr<const Motion> EditSession::State::motionOf(const SessionSolver& solver) const {
  const EditPointPtr point = solver.point();
  if (point->motion.duration == now.duration) return {point, &point->motion};
  return simulated(point->motion.scene, now.duration);
}

namespace {

struct Errors {
  double si = 0, scaled = 0;
  void add(double residual, double scaled_residual) {
    // written so that NaN stays
    if (!(std::abs(residual) <= si)) si = std::abs(residual);
    if (!(std::abs(scaled_residual) <= scaled)) scaled = std::abs(scaled_residual);
  }
};

void putNails(const Errors& nails, double tolerance, SessionUpdate& update) {
  update.nail_error = nails.si;
  update.scaled_nail_error = nails.scaled;
  update.reached = update.reached && nails.scaled <= tolerance;
}

}  // namespace

void EditSession::State::measureNails(SessionUpdate& update) const {
  Errors held;
  for (const SessionNail& nail : now.nails) {
    const NailState state = stateOf(nail, *update.motion);
    if (state.on && state.available && !state.soft) held.add(state.error, state.scaled_error);
  }
  putNails(held, options.tolerance, update);
}

void EditSession::State::measureGoal(const SessionSolver& solver, SessionUpdate& update) const {
  const EditProblem& problem = solver.problem();
  const RowValues rows = problem.constraints.evaluate(*update.motion, problem.timesOf(solver.point()->changes));
  Errors of_nails, of_goal;
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const bool is_goal = problem.constraints.rows()[static_cast<std::size_t>(i)].constraint == solver.goal();
    (is_goal ? of_goal : of_nails).add(rows.residuals[i], rows.scaled[i]);
  }
  update.scaled_distance = of_goal.scaled;
  update.reached = of_goal.scaled <= options.tolerance;
  putNails(of_nails, options.tolerance, update);
}

void EditSession::State::measureDrag(SessionUpdate& update) const {
  const SessionGesture& record = drag->record;
  const BodyState state = stateAtMoment(*update.motion, record.body, record.at, "dragTo");
  update.distance = awayFrom(*drag, placeConstrained(*update.motion, record, "dragTo")).norm();
  if (drag->orientation) update.turn = logSO3(state.orientation * drag->orientation->normalized().conjugate()).norm();
}

void EditSession::State::compareImpacts(const SessionSolver& solver, const Motion& before,
                                        SessionUpdate& update) const {
  const EditProblem& problem = solver.problem();
  const auto count = [&](const Motion& motion, const EditPoint& point) {
    return problem.constraints.extentIn(motion, problem.timesOf(point.changes)).events;
  };
  update.sequence_changes = sequenceChanges(before, count(before, *solver.start()), *update.motion,
                                            count(*update.motion, *solver.point()));
  update.sequence_changed = !update.sequence_changes.empty();
}

void EditSession::State::putEnd(const Budget& budget, SessionUpdate& update) const {
  update.cut_by_clock = budget.halt() == Halt::out_of_time;
  update.stopped = budget.halt() == Halt::cancelled;
}

void EditSession::State::describe(SessionSolver& solver, const Motion& before, const std::string& left_out,
                                  SessionUpdate& update) const {
  using Kind = SessionObstacle::Kind;
  std::vector<std::string> sentences;
  if (!update.reached) {
    if (update.scaled_nail_error > options.tolerance)
      sentences.push_back("The nails are missed by up to " + brief(update.nail_error) + ".");
    if (solver.goal() >= 0) {
      const std::string name =
          wordsOf(solver.problem().constraints.constraints()[static_cast<std::size_t>(solver.goal())]);
      if (drag && update.distance > 0)
        sentences.push_back(name + " stays " + brief(update.distance) + " m from its target.");
      else if (drag && update.turn > 0)
        sentences.push_back(name + " stays " + brief(update.turn) + " rad from its target orientation.");
      if (!drag && update.scaled_distance > options.tolerance)
        sentences.push_back("The nail of " + name + " is not met.");
    }
    // what is in the way comes first: that it was ended early is a reason only where nothing is
    update.obstacle = solver.obstacle();
    const bool nothing_else = update.obstacle.kind == Kind::work;
    if (nothing_else && update.cut_by_clock) {
      update.obstacle.kind = Kind::clock;
      update.obstacle.sentence = replays ? "It was ended there in the recording."
                                         : "The time limit of one update was reached first.";
    } else if (nothing_else && update.stopped) {
      update.obstacle.sentence = "It was stopped first.";
    }
    sentences.push_back(update.obstacle.sentence);
  }
  compareImpacts(solver, before, update);
  sentences.push_back(otherImpacts(update.sequence_changes, before, *update.motion));
  sentences.push_back(left_out);
  sentences.push_back(earlyEnd(*update.motion));
  for (const std::string& note : solver.problem().controls.notes()) sentences.push_back(note);
  for (const std::string& sentence : sentences)
    if (!sentence.empty()) update.message += (update.message.empty() ? "" : " ") + sentence;
}

void EditSession::State::takeOver(const SessionSolver& solver, const SessionUpdate& update) {
  if (solver.atStart()) return;
  now.scene = update.motion->scene;
  if (options.measure_from == MeasureFrom::start)
    now.changes = solver.point()->changes.head(solver.problem().controls.size());
}

}  // namespace carom

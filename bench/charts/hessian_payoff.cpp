// SPDX-License-Identifier: MIT
// What exact second derivatives cost and what they spare: the same edits as nonlinear programs, from the start, solved
// by Ipopt with exact second derivatives, with a secant update and with its own limited memory.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/charts/chart.h"
#include "bench/charts/chart_scenes.h"
#include "bench/edits/dice.h"
#include "bench/edits/tasks.h"
#include "editing/problem/hessian.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/solve/edit_program.hpp"
#include "editing/solve/ipopt_solver.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
using namespace editing_detail;

namespace {

constexpr int kIterations = 100;

struct Way {
  const char* name;
  SecondDerivatives source;
};
constexpr Way kWays[] = {{"exact", SecondDerivatives::exact},
                         {"secant", SecondDerivatives::secant},
                         {"limited memory", SecondDerivatives::limited_memory}};

// The program of an edit without the rule that gives up: every way has the same number of iterations.
class Patient final : public NonlinearProgram {
 public:
  explicit Patient(EditProgram& program) : program_(program) {}
  int variables() const override { return program_.variables(); }
  int constraints() const override { return program_.constraints(); }
  Bounds bounds() const override { return program_.bounds(); }
  Eigen::VectorXd start() const override { return program_.start(); }
  bool objective(const Eigen::VectorXd& x, double& f) override { return program_.objective(x, f); }
  bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) override { return program_.gradient(x, df_dx); }
  bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) override {
    return program_.constraintValues(x, g);
  }
  bool jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) override { return program_.jacobian(x, dg_dx); }
  bool hasHessian() const override { return program_.hasHessian(); }
  bool hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
               Eigen::MatrixXd& h) override {
    return program_.hessian(x, factor, multipliers, h);
  }

 private:
  EditProgram& program_;
};

struct Problem {
  std::string group, name;
  Scene scene;
  double duration;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
};

// Balls that bounce on a floor side by side; at the end each shall be where another throw brings it.
Problem throws(int balls, double far) {
  Problem p{far > 1 ? "far throws" : "throws", std::to_string(balls) + " balls", emptyScene(0.8, 0.2), 1.6, {}, {}};
  bench::Dice dice(7, static_cast<std::uint64_t>(balls), 0);
  p.scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0)};
  Scene hidden = p.scene;
  for (int i = 0; i < balls; ++i) {
    Body ball = movingBody("ball " + std::to_string(i), Sphere{0.05}, {0, 2.0 * i, dice.in(0.8, 1.2)},
                           {dice.in(1, 2), 0, dice.in(-1, 1)});
    ball.angular_velocity = 10 * dice.inCube(1);
    p.scene.bodies.push_back(ball);
    ball.velocity += 0.4 * far * dice.inCube(1), ball.position += 0.05 * far * dice.inCube(1);
    ball.angular_velocity += 5 * dice.inCube(1);
    hidden.bodies.push_back(ball);
    p.controls.insert(p.controls.end(), {velocity(ball.name), position(ball.name)});
  }
  OdeContacts contacts(hidden);
  const Motion motion = simulate(hidden, contacts, p.duration);
  for (int i = 0; i < balls; ++i) {
    const Vec3 place = motion.stateAt(i + 1, p.duration).position;
    Constraint c{.body = p.scene.bodies[static_cast<std::size_t>(i + 1)].name, .at = When(p.duration), .targets = {}};
    c.targets.push_back({.quantity = "position", .value = {place.x(), any, place.z()}});
    p.constraints.push_back(c);
  }
  return p;
}

Problem fromTask(int index) {
  const bench::Task task = bench::makeTask(1, index);
  return {"edits", std::to_string(index), task.start, task.duration, task.controls, task.constraints};
}

struct Outcome {
  bool met = false;
  int iterations = 0;
  double seconds = 0, objective = 0;
};

class Trial {
 public:
  explicit Trial(const Problem& problem)
      : contacts_(problem.scene),
        problem_(problem.scene, contacts_, problem.duration, problem.controls, problem.constraints) {}

  const EditProblem& problem() const { return problem_; }

  // Along the impact sequence of the start, as the edits' first stage goes.
  Outcome solve(SecondDerivatives source) const {
    Outcome outcome;
    outcome.seconds = bestSeconds(
        [&] {
          EditOptions options;
          options.second_derivatives = source;
          EditEvaluator evaluator(problem_, options);
          const EditPointPtr start = evaluator.evaluateStart();
          EditEvaluator smooth = evaluator.branch({{}, start}, true);
          EditProgram program(smooth, start->changes, problem_.constraints.equations(), nullptr);
          Patient patient(program);
          SolverOptions solver;
          solver.max_iterations = kIterations;
          const SolverResult result = solveWithIpopt(patient, solver);
          outcome.met = result.status == SolverStatus::converged || result.status == SolverStatus::acceptable;
          outcome.iterations = result.iterations;
          outcome.objective = result.objective;
        },
        0.05, 5);
    return outcome;
  }

  // Seconds of a simulation, a Jacobian and a Hessian of all rows at the start.
  std::vector<double> pieces() const {
    EditOptions options;
    EditEvaluator evaluator(problem_, options);
    const EditPointPtr start = evaluator.evaluateStart();
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(problem_.constraints.size());
    return {
        bestSeconds([&] { (void)simulateAt(problem_, start->values, problem_.horizon); }, 0.05),
        bestSeconds([&] { (void)jacobianByAdjoint(problem_, start->values, start->motion, start->rows); }, 0.05),
        bestSeconds([&] { (void)rowsHessian(problem_, start->changes, start->motion, start->rows, weights); }, 0.05)};
  }

 private:
  OdeContacts contacts_;
  EditProblem problem_;
};

bool hasRanges(const Problem& problem) {
  const auto limits = [](const Target& t) { return !t.min.empty() || !t.max.empty(); };
  for (const Constraint& c : problem.constraints)
    if (std::any_of(c.targets.begin(), c.targets.end(), limits)) return true;
  return false;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("edits: tasks of bench/edits, those that stay in their impact sequence; throws: balls that bounce, two");
  csv.note(
      "numbers of each held, six vary. From the start, without the projection that the edits make first, along the");
  csv.note(
      "impact sequence of the start, 100 iterations at most; met: Ipopt converged; objective: half the square of the");
  csv.note("change. pieces: seconds of one simulation; of the Jacobian; of the exact Hessian (iterations are none)");
  csv.columns({"group", "problem", "controls", "rows", "method", "met", "iterations", "seconds", "objective"});
  std::vector<Problem> problems;
  for (const int balls : {1, 2, 4, 8, 16, 33}) problems.push_back(throws(balls, 1));
  for (const int balls : {1, 2, 4, 8, 16}) problems.push_back(throws(balls, 3));
  constexpr int kTasks = 36;
  Progress progress(11 + kTasks * 2 / 3);
  for (int i = 0; i < kTasks; ++i)
    if (!bench::wantedOf(i).other_sequence) problems.push_back(fromTask(i));
  for (const Problem& p : problems) {
    progress.next(p.group + " " + p.name);
    if (hasRanges(p)) continue;
    const Trial trial(p);
    const int controls = trial.problem().controls.size(), rows = trial.problem().constraints.size();
    const std::vector<double> pieces = trial.pieces();
    const char* const names[] = {"simulation", "jacobian", "hessian"};
    for (std::size_t i = 0; i < pieces.size(); ++i)
      csv.row({p.group, p.name, controls, rows, names[i], 1, NAN, pieces[i], NAN});
    for (const Way& way : kWays) {
      const Outcome o = trial.solve(way.source);
      csv.row({p.group, p.name, controls, rows, way.name, o.met ? 1 : 0, o.iterations, o.seconds, o.objective});
    }
  }
}

}  // namespace carom::charts

// SPDX-License-Identifier: MIT
// A solver of your own: an edit as a nonlinear program, its values and exact derivatives, and Newton's method on its
// optimality conditions, whose answer is that of Edit::solve. Then a function of the motion is checked before it is used.
#include <cmath>
#include <cstdio>

#include <Eigen/LU>

#include "editing/check_motion_function.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene court() {
  Scene scene;
  scene.materials = {{.name = "court", .elasticity = 0.7, .friction = 0.4}};
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};
  return scene;
}

// Half the square of the speed of the ball at 0.5 s; its derivative with respect to the velocity is the velocity.
MotionFunction heat(double factor) {
  MotionFunction f{"heat", {}, 1, When(0.5), ""};
  f.read = [factor](const Motion& motion) {
    const Vec3 v = motion.stateAt("ball", 0.5).velocity;
    RowReading reading;
    reading.value = 0.5 * v.squaredNorm();
    StateSeed& seed = reading.seeds.emplace_back();
    seed.body = 1, seed.at = Instant::at(0.5), seed.velocity = factor * v;
    return reading;
  };
  return f;
}

}  // namespace

int main() {
  const Scene scene = court();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball"), elasticity("court").within(0.5, 0.9));
  edit.nail("ball", nthImpact(2)).position({4.2, 0.5, any});

  const NlpEvaluator program = edit.evaluator();
  for (const NlpVariable& variable : program.variables())
    std::printf("%-24s from %4.2f, scale %.3f\n", variable.name.c_str(), variable.start, variable.scale);
  for (const NlpRow& row : program.rows()) std::printf("%s = %g\n", row.name.c_str(), row.lower);

  // L = f + m . (g - target); Newton's method on dL = 0, g = target, within the impact sequence of the start.
  const Eigen::Index n = program.start().size(), rows = static_cast<Eigen::Index>(program.rows().size());
  Eigen::VectorXd x = program.start(), m = Eigen::VectorXd::Zero(rows);
  for (int k = 0; k < 12; ++k) {
    const NlpPoint point = program.at(x);
    if (!point.available() || !point.hasHessian()) return 1;
    const NlpGradient f = point.gradient();
    const NlpJacobian g = point.jacobian();
    Eigen::VectorXd miss = point.values();
    for (Eigen::Index i = 0; i < rows; ++i) miss[i] -= program.rows()[static_cast<std::size_t>(i)].lower;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + rows, n + rows);
    K.topLeftCorner(n, n) = point.hessian(1, m);
    K.topRightCorner(n, rows) = g.entries.transpose();
    K.bottomLeftCorner(rows, n) = g.entries;
    Eigen::VectorXd rest(n + rows);
    rest << f.entries + g.entries.transpose() * m, miss;
    const Eigen::VectorXd step = K.fullPivLu().solve(-rest);
    x += step.head(n), m += step.tail(rows);
  }
  const NlpPoint answer = program.at(x);
  const EditResult result = edit.solve({.sequence = SequencePolicy::stay});
  double apart = 0;
  for (std::size_t i = 0; i < result.changed.size(); ++i)
    apart = std::max(apart, std::abs(result.changed[i].after - x[static_cast<Eigen::Index>(i)]));
  std::printf("objective %.6f, that of solve() %.6f, values agree: %s\n", answer.objective(), result.objective,
              apart < 1e-6 ? "yes" : "no");
  std::printf("along the step of a throw: curvature %s\n",
              answer.hessianTimes(1, m, Eigen::VectorXd::Unit(n, 0)).isApprox(answer.hessian(1, m).col(0), 1e-9)
                  ? "as in the matrix"
                  : "another one");

  for (const double factor : {1.0, 0.5}) {
    const MotionFunctionCheck check = checkMotionFunction(scene, contacts, 2, heat(factor), {velocity("ball")});
    std::printf("%s, %d derivatives compared\n", check.passed ? "passed" : "not passed", check.compared);
    for (const std::string& finding : check.findings) std::printf("  %s\n", finding.c_str());
  }
}

// SPDX-License-Identifier: MIT
#include "editing/check_motion_function.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/messages.hpp"
#include "editing/edit.h"

namespace carom {
using namespace editing_detail;

namespace {

/// Of derivatives, relative to their size; differences have to be known ten times better.
constexpr double kAgreement = 1e-6, kKnown = 0.1 * kAgreement;
/// Smaller derivatives are compared on the scale of the largest one: they may be rounding alone.
constexpr double kSmallBeside = 1e-3;
/// If all derivatives are smaller than this, in natural scales, they are compared with 0 on this scale.
constexpr double kLeastSize = 1e-6;
/// Of the value, between the whole motion and the one up to `until`.
constexpr double kSameValue = 1e-9;
/// Steps tried, in natural scales, each with its half and its quarter.
constexpr double kFirstSteps[] = {1e-2, 1e-3, 1e-4};

/// Central differences of everything that a point gives: the value, then the gradient if second derivatives are checked.
struct Differences {
  Eigen::VectorXd estimate, uncertainty;
};

/// (f(h) - f(-h)) / 2h has an error in even powers of h: extrapolated from h, h/2 and h/4.
Differences extrapolated(const Eigen::VectorXd (&d)[3], double rounding) {
  const Eigen::VectorXd by_two = (4 * d[2] - d[1]) / 3;
  const Eigen::VectorXd by_three = (64 * d[2] - 20 * d[1] + d[0]) / 45;
  return {by_three, ((by_three - by_two).array().abs() + rounding).matrix()};
}

class FunctionChecker {
 public:
  FunctionChecker(const NlpEvaluator& program, NlpPoint start, bool says_second, std::stop_token stop)
      : program_(program),
        stop_(std::move(stop)),
        start_(std::move(start)),
        signature_(start_.signature()),
        says_second_(says_second),
        second_(start_.hasHessian()) {
    for (const NlpVariable& variable : program.variables()) {
      scale_.conservativeResize(scale_.size() + 1);
      scale_.tail(1)[0] = variable.scale;
    }
  }

  MotionFunctionCheck run() {
    const NlpGradient gradient = start_.gradient();
    if (!gradient.reliability.reliable)
      say("Its derivative is unreliable in this motion: " + gradient.reliability.message + ".");
    const Eigen::VectorXd g = gradient.entries.cwiseProduct(scale_);
    Eigen::MatrixXd H;
    if (second_) {
      H = scale_.asDiagonal() * start_.hessian(1, Eigen::VectorXd(0)) * scale_.asDiagonal();
    } else if (says_second_) {
      say("Its second derivatives could not be compared: the motion has none.");
    }
    for (Eigen::Index j = 0; j < g.size() && !stop_.stop_requested(); ++j) checkVariable(j, g, H);
    if (stop_.stop_requested()) check_.findings = {"The check was stopped."};
    check_.passed = check_.findings.empty();
    return check_;
  }

 private:
  void say(std::string sentence) { check_.findings.push_back(std::move(sentence)); }

  void checkVariable(Eigen::Index j, const Eigen::VectorXd& g, const Eigen::MatrixXd& H) {
    const std::string by = "with respect to " + program_.variables()[static_cast<std::size_t>(j)].name;
    const std::optional<Differences> found = differences(j);
    if (!found) {
      check_.not_compared += 1 + static_cast<int>(H.rows());
      return say("Its derivative " + by + " could not be compared: the impact sequence changes within " +
                 brief(kFirstSteps[2]) + " of the natural scale, or the motion lacks what it reads.");
    }
    const auto size = [](double value, double largest) {
      return std::max({std::abs(value), kSmallBeside * largest, kLeastSize});
    };
    compare("Its derivative " + by, g[j], found->estimate[0], found->uncertainty[0],
            size(g[j], g.cwiseAbs().maxCoeff()), check_.gradient_error);
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      compare("Its second derivative " + by + " and " + program_.variables()[static_cast<std::size_t>(i)].name, H(i, j),
              found->estimate[1 + i], found->uncertainty[1 + i], size(H(i, j), H.cwiseAbs().maxCoeff()),
              check_.hessian_error);
  }

  void compare(const std::string& what, double exact, double estimate, double uncertainty, double size, double& worst) {
    size = std::max(size, kSmallBeside * std::abs(estimate));
    if (!(uncertainty <= kKnown * size)) {
      ++check_.not_compared;
      return say(what + " could not be compared: differences are known to " + brief(uncertainty / size) +
                 " of its size only.");
    }
    ++check_.compared;
    const double error = std::abs(exact - estimate) / size;
    if (!(error <= worst)) worst = error;
    if (!(error <= kAgreement))
      say(what + " is " + brief(exact) + ", by differences " + briefBeside(estimate, exact) +
          " (of natural scales).");
  }

  /// Of the steps that stay within the impact sequence those that are known best, each entry by itself.
  std::optional<Differences> differences(Eigen::Index j) const {
    std::optional<Differences> best;
    for (const double first : kFirstSteps) {
      const std::optional<Differences> found = differencesAt(j, first);
      if (!found) continue;
      if (!best) best = found;
      for (Eigen::Index k = 0; k < found->estimate.size(); ++k) {
        if (!(found->uncertainty[k] < best->uncertainty[k])) continue;
        best->estimate[k] = found->estimate[k], best->uncertainty[k] = found->uncertainty[k];
      }
    }
    return best;
  }

  std::optional<Differences> differencesAt(Eigen::Index j, double first) const {
    Eigen::VectorXd d[3];
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const double step = first / (1 << k);
      const std::optional<Eigen::VectorXd> above = readingAt(j, step), below = readingAt(j, -step);
      if (!above || !below) return std::nullopt;
      d[k] = (*above - *below) / (2 * step);
      largest = std::max(largest, above->cwiseAbs().maxCoeff());
    }
    return extrapolated(d, 4 * std::numeric_limits<double>::epsilon() * largest / first);
  }

  std::optional<Eigen::VectorXd> readingAt(Eigen::Index j, double step) const {
    Eigen::VectorXd x = start_.x();
    x[j] += step * scale_[j];
    const NlpPoint point = program_.at(x, stop_);
    if (!point.available() || point.signature() != signature_ || (second_ && !point.hasHessian())) return std::nullopt;
    Eigen::VectorXd reading = Eigen::VectorXd::Constant(1, point.objective());
    if (!second_) return reading;
    reading.conservativeResize(1 + x.size());
    reading.tail(x.size()) = point.gradient().entries.cwiseProduct(scale_);
    return reading;
  }

  const NlpEvaluator& program_;
  std::stop_token stop_;
  NlpPoint start_;
  std::string signature_;
  bool says_second_, second_;
  Eigen::VectorXd scale_;
  MotionFunctionCheck check_;
};

/// What may be said of the function without any derivative.
std::vector<std::string> valueFindings(const MotionFunction& function, const Motion& known, const Motion& whole) {
  std::vector<std::string> findings;
  const double value = function.read(known).value, again = function.read(known).value, late = function.read(whole).value;
  if (value != again)
    findings.push_back("It gave " + brief(value) + " and then " + briefBeside(again, value) + " for one and the same motion.");
  if (!(std::abs(late - value) <= kSameValue * std::max(function.scale, std::abs(value))))
    findings.push_back("It reads the motion after `until`: it is " + brief(value) + " of a motion that ends there, " +
                       briefBeside(late, value) + " of the whole one.");
  return findings;
}

}  // namespace

MotionFunctionCheck checkMotionFunction(const Scene& scene, ContactSource& contacts, double duration,
                                        const MotionFunction& function, const std::vector<Control>& controls,
                                        std::stop_token stop) {
  Edit edit(scene, contacts, duration, controls, {});
  edit.minimise(function);
  const NlpEvaluator program = edit.evaluator();
  NlpPoint start = program.at(program.start(), stop);
  MotionFunctionCheck check;
  if (!start.available()) {
    check.findings.push_back(sentence(start.message()));
    return check;
  }
  const RowReading reading = function.read(start.motion());
  SimulateOptions options;
  options.stop = stop;
  const Motion whole = simulate(program.sceneAt(start.x()), contacts, duration, options);
  if (whole.status != MotionStatus::stopped) check.findings = valueFindings(function, start.motion(), whole);
  try {
    MotionFunctionCheck of_derivatives =
        FunctionChecker(program, std::move(start), reading.second_order, std::move(stop)).run();
    check.findings.insert(check.findings.end(), of_derivatives.findings.begin(), of_derivatives.findings.end());
    of_derivatives.findings = std::move(check.findings);
    check = std::move(of_derivatives);
  } catch (const NotComputable& why) {
    check.findings.push_back("Its derivatives could not be compared: " + std::string(why.what()) + ".");
  }
  check.passed = check.findings.empty();
  return check;
}

}  // namespace carom

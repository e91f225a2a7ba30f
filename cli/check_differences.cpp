// SPDX-License-Identifier: MIT
#include "cli/check_differences.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "cli/check_excuses.h"
#include "cli/rounded_scene.h"
#include "editing/problem/rows/refined_times.hpp"

namespace carom::cli {

using namespace formats_detail;
using namespace adjoint_detail;
using namespace editing_detail;

namespace {

constexpr double kSteps[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};  // of the natural scales
/// Scenes beside the one that is checked, whose numbers differ by a few roundings: what an entry changes by in them is
/// rounding, of terms that cancel in it or that a motion amplifies.
constexpr int kRoundedScenes = 12;
constexpr double kMostRoundings = 20;  // of the largest such change
/// Columns smaller than this, of the largest one, are compared on its scale: they may be nothing but rounding.
constexpr double kSmallColumn = 1e-3;
/// Entries below this on their natural scales are 0, or below kDifferencesTolerance where differences alone see them.
constexpr double kNothing = 1e-12;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The impacts, and changes of what lasts, up to the last one that can matter to the rows.
std::vector<std::string> sequenceOf(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& times) {
  return motion.describeEvents(problem.constraints.extentIn(motion, times).events);
}
std::string signatureOf(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& times) {
  return motion.signature(problem.constraints.extentIn(motion, times).events);
}

/// The rows of one scene near the one that is checked, those of free times at the same times.
struct Sample {
  bool possible = false;
  std::string why;
  std::string signature;
  Eigen::VectorXd rows;
  std::vector<std::string> sequence;
};

Sample sampleAt(const EditProblem& problem, const Eigen::VectorXd& values, const Eigen::VectorXd& times) {
  Sample sample;
  try {
    const Motion motion = simulateAt(problem, values, problem.horizon);
    const RowValues rows = problem.constraints.evaluate(motion, times);
    sample.sequence = sequenceOf(problem, motion, times);
    sample.signature = signatureOf(problem, motion, times);
    sample.rows = rows.values;
    sample.possible = true;
    if (!rows.available) sample.why = rows.message;
  } catch (const InputError& error) {
    sample.why = error.what();
  }
  return sample;
}

/// f'(x) from samples at x + offset h: sum_k weight[k] f(x + offset[k] h) / h. Second order all.
struct Scheme {
  const char* name;
  double offset[3], weight[3];
};
constexpr Scheme kCentral{"central", {-1, 1, 0}, {-0.5, 0.5, 0}};
constexpr Scheme kForward{"forward", {0, 1, 2}, {-1.5, 2, -0.5}};
constexpr Scheme kBackward{"backward", {0, -1, -2}, {1.5, -2, 0.5}};

class Checker {
 public:
  Checker(const EditProblem& problem, const Eigen::VectorXd& values, const CheckedPasses& passes)
      : problem_(problem), passes_(passes), values_(values) {
    const Motion motion = simulateAt(problem, values, problem.horizon);
    times_ = refinedTimes(problem.constraints, motion);
    const RowValues rows = problem.constraints.evaluate(motion, times_);
    signature_ = signatureOf(problem, motion, times_);
    check_.sequence = sequenceOf(problem, motion, times_);
    check_.by_adjoint = passes.by_adjoint(problem, values, motion, rows);
    check_.by_tangent = passes.by_tangent(problem, values, motion, rows);
    excused_ = Eigen::MatrixXd::Zero(check_.by_adjoint.rows(), check_.by_adjoint.cols());
    check_.by_differences = Eigen::MatrixXd::Constant(check_.by_adjoint.rows(), check_.by_adjoint.cols(), kNone);
    check_.steps.assign(std::begin(kSteps), std::end(kSteps));
    findScales();
    findRounding(rows.values);
  }

  DerivativeCheck run(const std::function<void(const std::string&)>& progress) {
    const Eigen::Index n = values_.size();
    check_.columns.resize(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
      progress("column " + std::to_string(j + 1) + " of " + std::to_string(n));
      for (const double step : kSteps) check_.columns[static_cast<std::size_t>(j)].push_back(difference(j, step));
      extrapolate(j);
      takeBestStep(j);
    }
    compareTangent();
    conclude();
    return check_;
  }

 private:
  void findScales() {
    control_scale_.resize(values_.size());
    row_scale_.resize(problem_.constraints.size());
    for (int j = 0; j < problem_.controls.size(); ++j) {
      const Variable& v = problem_.controls.variables()[static_cast<std::size_t>(j)];
      const double weight = problem_.controls.controls()[static_cast<std::size_t>(v.control)].control.weight;
      control_scale_[j] = v.scale * weight * (v.logarithmic ? values_[j] : 1);
    }
    for (int i = 0; i < problem_.constraints.size(); ++i)
      row_scale_[i] = problem_.constraints.rows()[static_cast<std::size_t>(i)].scale;
    const Eigen::MatrixXd dimensionless =
        row_scale_.cwiseInverse().asDiagonal() * check_.by_adjoint * control_scale_.asDiagonal();
    column_scale_ = dimensionless.cwiseAbs().colwise().maxCoeff().transpose();
    const double largest = column_scale_.maxCoeff();
    column_scale_ = column_scale_.cwiseMax(largest > 0 ? kSmallColumn * largest : 1.0);
  }

  /// How far rows and derivatives are rounding: what they change by in scenes that differ by little else.
  void findRounding(const Eigen::VectorXd& rows) {
    rounding_ = Eigen::MatrixXd::Zero(check_.by_adjoint.rows(), check_.by_adjoint.cols());
    row_rounding_ = std::numeric_limits<double>::epsilon() * row_scale_.cwiseMax(rows.cwiseAbs());
    const Scene scene = problem_.controls.sceneAt(values_);
    SimulateOptions options;
    options.asked = problem_.asked;
    for (unsigned draw = 1; draw <= kRoundedScenes; ++draw) {
      try {
        const Motion motion = simulate(rounded(scene, draw), *problem_.contacts, problem_.horizon, options);
        const RowValues beside = problem_.constraints.evaluate(motion, times_);
        if (!beside.available || signatureOf(problem_, motion, times_) != signature_) continue;
        row_rounding_ = row_rounding_.cwiseMax((beside.values - rows).cwiseAbs());
        for (const auto& [found, here] :
             {std::pair(passes_.by_adjoint(problem_, values_, motion, beside), check_.by_adjoint),
              std::pair(passes_.by_tangent(problem_, values_, motion, beside), check_.by_tangent)})
          rounding_ = rounding_.cwiseMax((found - here).cwiseAbs());
      } catch (const InputError&) {  // a scene at the border of what is possible
      }
    }
    row_rounding_ *= kMostRoundings;
    rounding_ *= kMostRoundings;
  }

  /// Of one entry, relative to the scale of its column. NaN stays NaN.
  double disagreement(Eigen::Index i, Eigen::Index j, double a, double b) const {
    return std::abs(a - b) * control_scale_[j] / row_scale_[i] / column_scale_[j];
  }

  /// What the entries of a column may differ by: all of them by `tolerance` of its scale, or each by its own rounding.
  struct Allowed {
    double tolerance;
    Eigen::VectorXd rounding;
  };
  bool isRounding(const Allowed& allowed, Eigen::Index i, double difference, double disagreement) const {
    return disagreement > allowed.tolerance && difference <= allowed.rounding[i];
  }

  /// Row with the largest disagreement of a column, without those above the tolerance that are rounding; a NaN is larger
  /// than all.
  DerivativeCheck::Entry worst(const Eigen::VectorXd& column, Eigen::Index j, const Allowed* allowed = nullptr) const {
    DerivativeCheck::Entry entry{0, static_cast<int>(j), -1};
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      const double by_adjoint = check_.by_adjoint(i, j), d = disagreement(i, j, column[i], by_adjoint);
      if (allowed && isRounding(*allowed, i, std::abs(column[i] - by_adjoint), d)) {
        ++entry.rounding;
        continue;
      }
      if (!(d <= entry.disagreement)) entry.row = static_cast<int>(i), entry.disagreement = d;
      if (std::isnan(d)) break;
    }
    entry.disagreement = std::isnan(entry.disagreement) ? entry.disagreement : std::max(entry.disagreement, 0.0);
    return entry;
  }
  /// Remembers which entries of a column were excused.
  void excuse(const Eigen::VectorXd& column, Eigen::Index j, const Allowed& allowed) {
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      const double by_adjoint = check_.by_adjoint(i, j), d = disagreement(i, j, column[i], by_adjoint);
      if (isRounding(allowed, i, std::abs(column[i] - by_adjoint), d)) excused_(i, j) = std::max(excused_(i, j), d);
    }
  }
  DerivativeCheck::Entry worstDifference(const DifferenceColumn& column, Eigen::Index j) const {
    const Allowed allowed{kDifferencesTolerance, column.rounding};
    return worst(column.values, j, &allowed);
  }

  DifferenceColumn difference(Eigen::Index j, double step) const {
    const double h = step * control_scale_[j];
    const auto shifted = [&](double offset) {
      Eigen::VectorXd values = values_;
      values[j] += offset * h;
      return sampleAt(problem_, values, times_);
    };
    const Sample below = shifted(-1), above = shifted(1);
    DifferenceColumn column;
    column.below = below.sequence, column.above = above.sequence;
    const Scheme& scheme = !below.possible ? kForward : !above.possible ? kBackward : kCentral;
    column.scheme = scheme.name;
    column.values = Eigen::VectorXd::Zero(row_scale_.size());
    for (int k = 0; k < 3; ++k) {
      if (scheme.weight[k] == 0) continue;
      const Sample sample = scheme.offset[k] == -1 ? below : scheme.offset[k] == 1 ? above : shifted(scheme.offset[k]);
      column.why = whyNot(sample);
      if (!column.why.empty()) return column;
      column.values += scheme.weight[k] / h * sample.rows;
    }
    column.compared = true;
    // the weights of every scheme are 4 at the most, of which half cancel
    column.rounding = rounding_.col(j) + 2 / h * row_rounding_;
    column.disagreement = worstDifference(column, j).disagreement;
    return column;
  }

  std::string whyNot(const Sample& sample) const {
    if (!sample.possible) return "the scene is invalid there: " + sample.why;
    if (sample.signature != signature_) return "the impact sequence is another one";
    return sample.why;
  }

  /// All schemes are of second order: two steps together cancel their first error, which is what remains where motions are
  /// so sensitive that only small steps keep their sequence.
  void extrapolate(Eigen::Index j) {
    auto& steps = check_.columns[static_cast<std::size_t>(j)];
    for (std::size_t s = steps.size() - 1; s > 0; --s) {
      DifferenceColumn &fine = steps[s], &coarse = steps[s - 1];
      if (!fine.compared || !coarse.compared || fine.scheme != coarse.scheme) continue;
      const double ratio2 = std::pow(kSteps[s - 1] / kSteps[s], 2);
      const Eigen::VectorXd both = (ratio2 * fine.values - coarse.values) / (ratio2 - 1);
      if (!(worst(both, j).disagreement < worst(fine.values, j).disagreement)) continue;
      fine.values = both;
      fine.scheme += ", extrapolated";
      fine.disagreement = worstDifference(fine, j).disagreement;
    }
  }

  /// The best step is the one with the least disagreement, rounding or not: at small steps much would pass for rounding.
  void takeBestStep(Eigen::Index j) {
    const auto& steps = check_.columns[static_cast<std::size_t>(j)];
    int best = -1;
    double least = kNone;
    for (int s = 0; s < static_cast<int>(steps.size()); ++s) {
      const DifferenceColumn& step = steps[static_cast<std::size_t>(s)];
      if (!step.compared) continue;
      const double whole = worst(step.values, j).disagreement;
      if (std::isnan(least) || whole < least) best = s, least = whole;
    }
    check_.best_step.push_back(best);
    if (best < 0) return;
    check_.by_differences.col(j) = steps[static_cast<std::size_t>(best)].values;
    const DifferenceColumn& column = steps[static_cast<std::size_t>(best)];
    excuse(column.values, j, {kDifferencesTolerance, column.rounding});
    take(worstDifference(column, j), check_.differences);
  }

  /// The worst entry of all columns, and how many of them are rounding.
  static void take(DerivativeCheck::Entry entry, DerivativeCheck::Entry& worst) {
    entry.rounding += worst.rounding;
    const bool worse = worst.row < 0 || !(entry.disagreement <= worst.disagreement);
    if (worse) worst = entry;
    worst.rounding = entry.rounding;
  }

  void compareTangent() {
    for (Eigen::Index j = 0; j < values_.size(); ++j) {
      const Allowed allowed{kTangentTolerance, rounding_.col(j)};
      excuse(check_.by_tangent.col(j), j, allowed);
      take(worst(check_.by_tangent.col(j), j, &allowed), check_.adjoint_tangent);
    }
  }

  /// Entries that are not 0.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> counting() const {
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> counts(excused_.rows(), excused_.cols());
    for (Eigen::Index j = 0; j < counts.cols(); ++j)
      for (Eigen::Index i = 0; i < counts.rows(); ++i) {
        const double unit = row_scale_[i] / control_scale_[j];
        const auto is = [&](const Eigen::MatrixXd& by, double least) { return std::abs(by(i, j)) > least * unit; };
        counts(i, j) = is(check_.by_adjoint, kNothing) || is(check_.by_tangent, kNothing) ||
                       is(check_.by_differences, kDifferencesTolerance);
      }
    return counts;
  }

  std::vector<bool> compared() const {
    std::vector<bool> columns;
    for (const int best : check_.best_step) columns.push_back(best >= 0);
    return columns;
  }

  void conclude() {
    std::ostringstream text;
    text.precision(3);
    for (const int best : check_.best_step) check_.not_compared += best < 0;
    if (!(check_.adjoint_tangent.disagreement <= kTangentTolerance)) {
      text << "Failed: adjoint and tangent disagree by " << check_.adjoint_tangent.disagreement << ", more than "
           << kTangentTolerance << ".";
    } else if (check_.differences.row >= 0 && !(check_.differences.disagreement <= kDifferencesTolerance)) {
      text << "Failed: differences disagree by " << check_.differences.disagreement << " at the best step, more than "
           << kDifferencesTolerance << ".";
    } else if (const std::string left_out = tooManyExcused(counting(), excused_); !left_out.empty()) {
      text << "Not compared: " << left_out;
    } else if (check_.not_compared > 0 && check_.differences.row < 0) {
      text << "Not compared: in every column every step leads to another impact sequence, or to an invalid scene.";
    } else if (const std::string uncompared = tooManyNotCompared(counting(), compared()); !uncompared.empty()) {
      text << "Not compared: " << uncompared;
    } else {
      check_.passed = true;
      text << "Passed: adjoint and tangent agree to " << check_.adjoint_tangent.disagreement;
      if (check_.differences.row >= 0) text << ", differences to " << check_.differences.disagreement;
      text << ".";
      if (const int rounding = check_.adjoint_tangent.rounding + check_.differences.rounding)
        text << " Entries that differ by more, by rounding of cancelling terms: " << rounding << ".";
      if (check_.not_compared > 0)
        text << " " << check_.not_compared << " of " << check_.best_step.size()
             << " columns were not compared with differences, because every step leads to another impact sequence.";
    }
    check_.message = text.str();
  }

  const EditProblem& problem_;
  const CheckedPasses& passes_;
  Eigen::VectorXd values_, times_, control_scale_, row_scale_, column_scale_, row_rounding_;
  Eigen::MatrixXd rounding_;
  Eigen::MatrixXd excused_;  // what entries that were excused differ by, as a share of their column's scale
  std::string signature_;
  DerivativeCheck check_;
};

}  // namespace

DerivativeCheck checkDerivatives(const EditProblem& problem, const Eigen::VectorXd& values,
                                 const std::function<void(const std::string&)>& progress, const CheckedPasses& passes) {
  return Checker(problem, values, passes).run(progress);
}

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#include "editing/shooting/shooting_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "editing/hessian.h"
#include "editing/search/parallel.h"

namespace carom {
namespace {

constexpr std::size_t kRecentShots = 3;

bool holdsTime(const ConstraintSet& constraints, const Row& row) {
  return row.target >= 0 && row.name == "time" &&
         constraints.constraints()[static_cast<std::size_t>(row.constraint)].at.impact > 0;
}

int findRow(const Segment& segment, SegmentRow::Role role) {
  for (std::size_t i = 0; i < segment.rows.size(); ++i)
    if (segment.rows[i].role == role) return static_cast<int>(i);
  return -1;
}

/// Visits the entries of d(row)/d(x) that come from a row of a segment: unknown of the segment, term of its map.
template <class Visit>
void visitTerms(const Segment& segment, Visit visit) {
  for (std::size_t j = 0; j < segment.unknowns.size(); ++j)
    for (const Affine::Term& term : segment.unknowns[j].terms) visit(static_cast<Eigen::Index>(j), term);
}

/// Visits the entries of the lower triangle of d2/dx2 that come from d2/d(z_i z_j), and how often they count.
template <class Visit>
void visitPairs(const Segment& segment, Visit visit) {
  const auto pair = [&](Eigen::Index i, Eigen::Index j, const Affine::Term& a, const Affine::Term& b, double times) {
    visit(i, j, std::max(a.variable, b.variable), std::min(a.variable, b.variable), times * a.factor * b.factor);
  };
  for (std::size_t i = 0; i < segment.unknowns.size(); ++i) {
    const std::vector<Affine::Term>& of_i = segment.unknowns[i].terms;
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < i; ++j)
      for (const Affine::Term& a : of_i)
        for (const Affine::Term& b : segment.unknowns[j].terms)
          pair(row, static_cast<Eigen::Index>(j), a, b, a.variable == b.variable ? 2 : 1);
    for (std::size_t a = 0; a < of_i.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        pair(row, row, of_i[a], of_i[b], a != b && of_i[a].variable == of_i[b].variable ? 2 : 1);
  }
}

}  // namespace

ShootingProgram::ShootingProgram(EditSearch& search, const EditPoint& from, const Segments& segments,
                                 const std::vector<int>& rows)
    : search_(search), segments_(segments), start_(Eigen::VectorXd::Zero(segments.variables.size)) {
  start_.head(search.problem().unknowns()) = from.changes;
  const ConstraintSet& held = search.problem().constraints;
  for (std::size_t s = 0; s < segments.segments.size(); ++s) {
    const std::vector<SegmentRow>& of = segments.segments[s].rows;
    for (std::size_t r = 0; r < of.size(); ++r) {
      if (of[r].role != SegmentRow::Role::held) continue;
      const bool chosen = held.rows()[static_cast<std::size_t>(of[r].index)].isRange() ||
                          std::find(rows.begin(), rows.end(), of[r].index) != rows.end();
      if (chosen) addHeldRow(static_cast<int>(s), static_cast<int>(r), of[r].index);
    }
  }
  for (std::size_t k = 0; k + 1 < segments.segments.size(); ++k) addNodeRows(k);
}

void ShootingProgram::addHeldRow(int segment, int row, int held) {
  const ConstraintSet& constraints = search_.problem().constraints;
  const Row& r = constraints.rows()[static_cast<std::size_t>(held)];
  const double anchor = std::isfinite(r.lower) ? r.lower : r.upper;
  ProgramRow out{{{segment, row, 1 / r.scale}}, {-anchor / r.scale, {}}, 0, 0};
  // Times of the segment count from its start.
  if (holdsTime(constraints, r))
    out.linear += 1 / r.scale * segments_.segments[static_cast<std::size_t>(segment)].start;
  if (r.isRange()) out.lower = (r.lower - anchor) / r.scale, out.upper = (r.upper - anchor) / r.scale;
  rows_.push_back(std::move(out));
}

void ShootingProgram::addNodeRows(std::size_t node) {
  const Segment &before = segments_.segments[node], &after = segments_.segments[node + 1];
  const int first = segments_.variables.node_state[node];
  for (std::size_t r = 0; r < before.rows.size(); ++r) {
    if (before.rows[r].role != SegmentRow::Role::end_state) continue;
    // Which control of the next segment starts with this number.
    const int variable = before.rows[r].index;
    for (std::size_t j = 0; j < after.unknowns.size(); ++j) {
      const std::vector<Affine::Term>& terms = after.unknowns[j].terms;
      if (terms.size() != 1 || terms[0].variable != variable || variable < first) continue;
      const Variable& v = after.problem.controls.variables()[j];
      rows_.push_back({{{static_cast<int>(node), static_cast<int>(r), 1 / v.scale}},
                       Affine{-v.start / v.scale, {{variable, -1}}},
                       0,
                       0});
    }
  }
  if (segments_.variables.node_time[node] < 0) return;
  const int last_row = findRow(before, SegmentRow::Role::last_impact),
            first_row = findRow(after, SegmentRow::Role::first_impact);
  const double half = 0.5 / segments_.node_time_scale[node];  // nodes are cut in the middle
  rows_.push_back({{{static_cast<int>(node), last_row, -half}, {static_cast<int>(node) + 1, first_row, -half}},
                   half * (after.start - before.start),
                   0,
                   0});
}

NonlinearProgram::Bounds ShootingProgram::bounds() const {
  const Eigen::Index edit = segments_.variables.edit, rows = static_cast<Eigen::Index>(rows_.size());
  Bounds bounds{Eigen::VectorXd::Constant(variables(), -kInfinity), Eigen::VectorXd::Constant(variables(), kInfinity),
                Eigen::VectorXd::Constant(constraints(), kValidityMargin),
                Eigen::VectorXd::Constant(constraints(), kInfinity)};
  bounds.x_lower.head(edit) = search_.lower(), bounds.x_upper.head(edit) = search_.upper();
  for (Eigen::Index i = 0; i < rows; ++i) {
    bounds.g_lower[i] = rows_[static_cast<std::size_t>(i)].lower;
    bounds.g_upper[i] = rows_[static_cast<std::size_t>(i)].upper;
  }
  return bounds;
}

ShootingProgram::Point* ShootingProgram::at(const Eigen::VectorXd& x) {
  for (Point& point : recent_)
    if (point.x == x) return &point;
  Point point{x, std::vector<SegmentPointPtr>(segments_.segments.size()), false};
  inParallel(search_.options().threads, point.segments.size(),
             [&](std::size_t s) { point.segments[s] = segments_.segments[s].evaluate(x); });
  if (std::any_of(point.segments.begin(), point.segments.end(), [](const SegmentPointPtr& p) { return !p; }))
    return nullptr;
  if (recent_.size() == kRecentShots) recent_.erase(recent_.begin());
  recent_.push_back(std::move(point));
  return &recent_.back();
}

void ShootingProgram::differentiate(Point& point) {
  if (std::exchange(point.differentiated, true)) return;
  inParallel(search_.options().threads, point.segments.size(),
             [&](std::size_t s) { segments_.segments[s].differentiate(*point.segments[s]); });
}

Eigen::VectorXd ShootingProgram::controlValues(const Eigen::VectorXd& x) const {
  return search_.problem().valuesOf(x.head(segments_.variables.edit));
}

bool ShootingProgram::objective(const Eigen::VectorXd& x, double& f) {
  f = search_.problem().objective(x.head(segments_.variables.edit));
  return true;
}

bool ShootingProgram::gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) {
  const Eigen::Index controls = search_.problem().controls.size();
  df_dx = Eigen::VectorXd::Zero(x.size());
  df_dx.head(controls) = x.head(controls);
  return true;
}

bool ShootingProgram::constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
  const Point* point = at(x);
  if (!point) return false;
  g.resize(constraints());
  Eigen::Index i = 0;
  for (const ProgramRow& row : rows_) {
    g[i] = row.linear.at(x);
    for (const SegmentTerm& term : row.terms)
      g[i] += term.factor * point->segments[static_cast<std::size_t>(term.segment)]->rows.values[term.row];
    ++i;
  }
  const EditProblem& problem = search_.problem();
  g.tail(problem.validity.size()) = problem.validity.evaluate(problem.controls, controlValues(x));
  return true;
}

std::vector<NonlinearProgram::Place> ShootingProgram::jacobianPlaces() const {
  std::vector<Place> places;
  int i = 0;
  for (const ProgramRow& row : rows_) {
    for (const SegmentTerm& term : row.terms)
      visitTerms(segments_.segments[static_cast<std::size_t>(term.segment)], [&](Eigen::Index, const Affine::Term& t) {
        places.push_back({i, t.variable});
      });
    for (const Affine::Term& t : row.linear.terms) places.push_back({i, t.variable});
    ++i;
  }
  for (int h = 0; h < search_.problem().validity.size(); ++h, ++i)
    for (int j = 0; j < search_.problem().controls.size(); ++j) places.push_back({i, j});
  return places;
}

bool ShootingProgram::jacobianEntries(const Eigen::VectorXd& x, Eigen::VectorXd& entries) {
  Point* point = at(x);
  if (!point) return false;
  differentiate(*point);
  std::vector<double> values;
  for (const ProgramRow& row : rows_) {
    for (const SegmentTerm& term : row.terms) {
      const Eigen::MatrixXd& J = *point->segments[static_cast<std::size_t>(term.segment)]->jacobian;
      visitTerms(
          segments_.segments[static_cast<std::size_t>(term.segment)],
          [&](Eigen::Index j, const Affine::Term& t) { values.push_back(term.factor * J(term.row, j) * t.factor); });
    }
    for (const Affine::Term& t : row.linear.terms) values.push_back(t.factor);
  }
  const EditProblem& problem = search_.problem();
  const Eigen::Index n = problem.controls.size();
  const Eigen::VectorXd rates = problem.rates(x.head(segments_.variables.edit)).head(n);
  const Eigen::MatrixXd H = problem.validity.jacobian(problem.controls, controlValues(x)) * rates.asDiagonal();
  for (Eigen::Index h = 0; h < H.rows(); ++h) values.insert(values.end(), H.row(h).begin(), H.row(h).end());
  entries = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return true;
}

std::vector<NonlinearProgram::Place> ShootingProgram::hessianPlaces() const {
  std::vector<Place> places;
  // Validity couples controls; without it they have their cost alone.
  const bool coupled = search_.problem().validity.size() > 0;
  for (int i = 0; i < search_.problem().controls.size(); ++i)
    for (int j = coupled ? 0 : i; j <= i; ++j) places.push_back({i, j});
  for (const Segment& segment : segments_.segments)
    visitPairs(segment, [&](Eigen::Index, Eigen::Index, int row, int column, double) {
      places.push_back({row, column});
    });
  return places;
}

bool ShootingProgram::hessianEntries(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                                     Eigen::VectorXd& entries) {
  Point* point = at(x);
  if (!point) return false;
  std::vector<Eigen::VectorXd> weights;
  for (const Segment& segment : segments_.segments)
    weights.push_back(Eigen::VectorXd::Zero(segment.problem.constraints.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const SegmentTerm& term : rows_[i].terms)
      weights[static_cast<std::size_t>(term.segment)][term.row] +=
          multipliers[static_cast<Eigen::Index>(i)] * term.factor;
  std::vector<Eigen::MatrixXd> blocks(segments_.segments.size());
  inParallel(search_.options().threads, blocks.size(),
             [&](std::size_t s) { blocks[s] = segments_.segments[s].hessian(*point->segments[s], weights[s]); });
  const EditProblem& problem = search_.problem();
  const Eigen::Index validity = problem.validity.size(), controls = problem.controls.size();
  Eigen::MatrixXd of_edit = factor * Eigen::MatrixXd::Identity(problem.unknowns(), problem.unknowns());
  if (validity > 0) of_edit += validityHessian(problem, x.head(problem.unknowns()), multipliers.tail(validity));
  std::vector<double> values;
  for (Eigen::Index i = 0; i < controls; ++i)
    for (Eigen::Index j = validity > 0 ? 0 : i; j <= i; ++j) values.push_back(of_edit(i, j));
  for (std::size_t s = 0; s < blocks.size(); ++s)
    visitPairs(segments_.segments[s], [&](Eigen::Index i, Eigen::Index j, int, int, double count) {
      values.push_back(count * blocks[s](i, j));
    });
  entries = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return true;
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "tests/reference/constrained_series.h"

#include <algorithm>
#include <cmath>

namespace carom::reference {

Real ConstrainedSeries::convolved(const Curve& a, const Curve& b, std::size_t j, std::size_t from) {
  Real sum = 0, scratch;
  for (std::size_t i = from; i <= j; ++i)
    for (int c = 0; c < 3; ++c) addProduct(sum, scratch, a[i][c], b[j - i][c]);
  return sum;
}

RVec ConstrainedSeries::crossed(const Curve& a, const Curve& b, std::size_t j) {
  RVec plus, minus;
  Real scratch;
  for (std::size_t i = 0; i <= j; ++i)
    for (int c = 0; c < 3; ++c) {
      addProduct(plus[c], scratch, a[i][(c + 1) % 3], b[j - i][(c + 2) % 3]);
      addProduct(minus[c], scratch, a[i][(c + 2) % 3], b[j - i][(c + 1) % 3]);
    }
  return plus - minus;
}

RVec ConstrainedSeries::sum(const Curve& c, const Real& t) {
  RVec value = c.back();
  for (std::size_t j = c.size() - 1; j-- > 0;) value = t * value + c[j];
  return value;
}

ConstrainedSeries::ConstrainedSeries(const ConstrainedBody& body, std::vector<ConstrainedCorner> corners, const ConstrainedState& at, int order,
                       const Real& tolerance)
    : body_(body), corners_(std::move(corners)), order_(static_cast<std::size_t>(order)), tolerance_(tolerance) {
  for (int c = 0; c < 3; ++c) inverse_[c] = 1 / body.inertia[c];
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (!corners_[k].sticks) unknowns_.push_back({k, -1});
    for (int c = 0; c < 3 && corners_[k].sticks; ++c) unknowns_.push_back({k, c});
  }
  start(at);
  expand();
  first_ = false;
}

void ConstrainedSeries::start(const ConstrainedState& s) {
  const std::size_t n = corners_.size(), m = unknowns_.size(), size = order_ + 1;
  for (Curve* c : {&x_, &v_, &w_, &row_[0], &row_[1], &row_[2]}) c->assign(size, RVec());
  for (Curve* c : {&Iw_, &gravity_, &gyro_, &force_, &moment_}) c->assign(order_, RVec());
  for (auto* curves : {&normal_, &free_, &d_, &push_, &f_}) curves->assign(n, Curve(order_));
  u_.assign(n, Curve(size));
  length_.assign(n, Line(order_));
  round_.resize(n);
  moved_.assign(m, std::vector<Curve>(n, Curve(order_)));
  B_.assign(m, std::vector<Line>(m, Line(order_)));
  for (auto* lines : {&right_, &y_, &lambda_}) lines->assign(m, Line(order_));
  x_[0] = s.x, v_[0] = transposeTimes(s.R, s.v), w_[0] = transposeTimes(s.R, s.spin);
  for (int a = 0; a < 3; ++a) row_[static_cast<std::size_t>(a)][0] = transposeTimes(s.R, axisVector(a));
}

void ConstrainedSeries::expand() {
  std::vector<std::size_t> starting;
  for (std::size_t k = 0; k < corners_.size(); ++k)
    if (begins(k)) starting.push_back(k);
  for (std::size_t j = 0; j < order_; ++j) {
    place(j);
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if (rubs(k) && !begins(k)) direct(j, k);
    if (starting.empty()) {
      push(j), go(j);
    } else {
      beginSlips(j, starting);
    }
    for (std::size_t k = 0; k < corners_.size(); ++k) u_[k][j + 1] = v_[j + 1] + cross(w_[j + 1], corners_[k].at);
  }
  findLongest();
}

// What does not need the forces.
void ConstrainedSeries::place(std::size_t j) {
  const auto turned = [&](const RVec& a) {
    return a[0] * row_[0][j] + a[1] * row_[1][j] + a[2] * row_[2][j];
  };
  gravity_[j] = turned(body_.gravity);
  Iw_[j] = times(body_.inertia, w_[j]);
  gyro_[j] = -times(inverse_, crossed(w_, Iw_, j));
  const Real square = convolved(w_, w_, j);
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const RVec& c = corners_[k].at;
    normal_[k][j] = turned(corners_[k].normal);
    RVec lean;
    Real scratch;
    for (std::size_t i = 0; i <= j; ++i) {
      const Real along = dot(w_[j - i], c);
      for (int a = 0; a < 3; ++a) addProduct(lean[a], scratch, w_[i][a], along);
    }
    free_[k][j] = gravity_[j] + cross(gyro_[j], c) + lean - square * c;
    if (j == 0) u_[k][0] = begins(k) || corners_[k].sticks ? RVec() : v_[0] + cross(w_[0], c);
  }
}

// d = u/|u| from |u|^2 = u.u and |u| d = u.
void ConstrainedSeries::direct(std::size_t j, std::size_t k) {
  const Curve& u = u_[k];
  Line& length = length_[k];
  Real square = convolved(u, u, j);
  if (j == 0) {
    length[0] = sqrt(square);
  } else {
    for (std::size_t i = 1; i < j; ++i) square -= length[i] * length[j - i];
    length[j] = square / (2 * length[0]);
  }
  RVec rest = u[j];
  for (std::size_t i = 1; i <= j; ++i) rest = rest - length[i] * d_[k][j - i];
  d_[k][j] = (1 / length[0]) * rest;
}

// Where one other corner sticks: a slip that begins goes round that one, whatever pushes it.
std::optional<std::size_t> ConstrainedSeries::pivot() const {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (!corners_[k].sticks) continue;
    if (found) return std::nullopt;
    found = k;
  }
  return found;
}

void ConstrainedSeries::directAround(std::size_t j, std::size_t k, std::size_t pivot) {
  const RVec arm = unit(corners_[k].at - corners_[pivot].at);
  if (j == 0) {
    RVec slip;
    for (int a = 0; a < 3; ++a) slip = slip + corners_[k].slip[a] * row_[static_cast<std::size_t>(a)][0];
    round_[k] = dot(slip, cross(normal_[k][0], arm)) > 0 ? 1 : -1;
  }
  d_[k][j] = Real(round_[k]) * cross(normal_[k][j], arm);
}

// |d| = 1 and n.d = 0, turned about the normal by `turn`.
void ConstrainedSeries::directFromRest(std::size_t j, std::size_t k, const Real& turn) {
  Curve& d = d_[k];
  const Curve& n = normal_[k];
  if (j == 0) {
    const RVec side = cross(n[0], d[0]);
    d[0] = unit(d[0] + turn * side);
    return;
  }
  d[j] = RVec();
  const Real along = convolved(d, d, j) / 2, up = convolved(n, d, j);
  d[j] = -along * d[0] - up * n[0] + turn * cross(n[0], d[0]);
}

// Of order j + 1 in (n x d).u, which is 0.
Real ConstrainedSeries::across(std::size_t j, std::size_t k) const {
  Real sum = 0;
  for (std::size_t i = 0; i <= j; ++i) sum += dot(crossed(normal_[k], d_[k], i), u_[k][j + 1 - i]);
  return sum;
}

// The residual answers to a turn of order j by what that does to the direction, and to u, which is less by j + 1.
void ConstrainedSeries::beginSlips(std::size_t j, const std::vector<std::size_t>& which) {
  if (const auto about = pivot()) {
    for (std::size_t k : which) directAround(j, k, *about);
    return push(j), go(j);
  }
  if (j == 0) return findFirstDirections(which);
  const std::size_t m = which.size();
  const auto residual = [&](std::size_t turned) {
    for (std::size_t i = 0; i < m; ++i) directFromRest(j, which[i], i == turned ? 1 : 0);
    push(j), go(j);
    std::vector<Real> r;
    for (std::size_t k : which) u_[k][j + 1] = v_[j + 1] + cross(w_[j + 1], corners_[k].at), r.push_back(across(j, k));
    return r;
  };
  const std::vector<Real> none = residual(m);
  const auto own = [&](std::size_t i) { return -dot(d_[which[i]][0], u_[which[i]][1]); };
  if (j == 1) {
    answer_.assign(m, std::vector<Real>(m));
    for (std::size_t c = 0; c < m; ++c) {
      const std::vector<Real> with = residual(c);
      for (std::size_t i = 0; i < m; ++i) answer_[i][c] = 2 * (with[i] - none[i] - (i == c ? own(i) : Real(0)));
    }
  }
  RealRows A = answer_;
  for (std::size_t i = 0; i < m; ++i) {
    for (Real& entry : A[i]) entry /= static_cast<int>(j) + 1;
    A[i][i] += own(i);
  }
  if (independentRows(A, Real("1e-12")).size() < m) throw SlipsTogether();
  const RealRows inverse = inverseOf(A);
  for (std::size_t i = 0; i < m; ++i) {
    Real turn = 0;
    for (std::size_t c = 0; c < m; ++c) turn -= inverse[i][c] * none[c];
    directFromRest(j, which[i], turn);
  }
  push(j), go(j);
}

// By Newton's method with differences; friction that has just come to its limit pulls straight against the slip.
void ConstrainedSeries::findFirstDirections(const std::vector<std::size_t>& which) {
  const std::size_t m = which.size();
  for (std::size_t k : which) {
    RVec d;
    for (int a = 0; a < 3; ++a) d = d + corners_[k].slip[a] * row_[static_cast<std::size_t>(a)][0];
    d_[k][0] = unit(d - dot(d, normal_[k][0]) * normal_[k][0]);
  }
  const auto residual = [&] {
    push(0), go(0);
    std::vector<Real> r;
    for (std::size_t k : which) u_[k][1] = v_[1] + cross(w_[1], corners_[k].at), r.push_back(across(0, k));
    return r;
  };
  if (isAtLimit(which)) return void(residual());
  const Real h("1e-25");
  for (int round = 0; round < 12; ++round) {
    const std::vector<Real> now = residual();
    RealRows A(m, std::vector<Real>(m));
    for (std::size_t c = 0; c < m; ++c) {
      const RVec d = d_[which[c]][0];
      directFromRest(0, which[c], h);
      const std::vector<Real> with = residual();
      d_[which[c]][0] = d;
      for (std::size_t i = 0; i < m; ++i) A[i][c] = (with[i] - now[i]) / h;
    }
    const RealRows inverse = inverseOf(A);
    for (std::size_t i = 0; i < m; ++i) {
      Real turn = 0;
      for (std::size_t c = 0; c < m; ++c) turn -= inverse[i][c] * now[c];
      directFromRest(0, which[i], turn);
    }
  }
  residual();
}

// Whether the forces that hold the corners still are those of friction at its limit; then they give the directions.
bool ConstrainedSeries::isAtLimit(const std::vector<std::size_t>& which) {
  std::vector<ConstrainedCorner> stuck = corners_;
  for (std::size_t k : which) stuck[k].sticks = true, stuck[k].begins = false;
  ConstrainedState s{x_[0], RMat::identity(), v_[0], w_[0]};  // in the axes of the body
  ConstrainedBody body = body_;
  body.gravity = gravity_[0];
  for (std::size_t k = 0; k < stuck.size(); ++k) stuck[k].normal = normal_[k][0];
  const ConstrainedSeries held(body, stuck, s, 1, tolerance_);
  std::vector<RVec> directions;
  for (std::size_t k : which) {
    const RVec f = held.f_[k][0];
    const Real pressing = dot(f, normal_[k][0]);
    const RVec side = f - pressing * normal_[k][0];
    if (abs(norm(side) - corners_[k].friction * pressing) > Real("1e-9") * abs(pressing)) return false;
    directions.push_back((-1 / norm(side)) * side);
  }
  for (std::size_t i = 0; i < which.size(); ++i) d_[which[i]][0] = directions[i];
  return true;
}

RVec ConstrainedSeries::answer(std::size_t at, std::size_t by, const RVec& force) const {
  return (1 / body_.mass) * force + cross(times(inverse_, cross(corners_[by].at, force)), corners_[at].at);
}

// The forces of order j: (11.21), and of least norm where they are redundant.
void ConstrainedSeries::push(std::size_t j) {
  for (std::size_t k = 0; k < corners_.size(); ++k)
    push_[k][j] = rubs(k) ? normal_[k][j] - corners_[k].friction * d_[k][j] : normal_[k][j];
  fillMatrix(j);
  if (j == 0) {
    RealRows B;
    for (const auto& row : B_) {
      B.emplace_back();
      for (const Line& entry : row) B.back().push_back(entry[0]);
    }
    solver_ = ConstrainedSolve(B);
  }
  solve(j);
  force_[j] = moment_[j] = RVec();
  for (std::size_t k = 0; k < corners_.size(); ++k) f_[k][j] = RVec();
  for (std::size_t a = 0; a < unknowns_.size(); ++a) {
    const auto [k, axis] = unknowns_[a];
    if (axis >= 0) f_[k][j][axis] = y_[a][j];
    for (std::size_t i = 0; i <= j && axis < 0; ++i) f_[k][j] = f_[k][j] + y_[a][i] * push_[k][j - i];
  }
  for (std::size_t k = 0; k < corners_.size(); ++k)
    force_[j] = force_[j] + f_[k][j], moment_[j] = moment_[j] + cross(corners_[k].at, f_[k][j]);
}

void ConstrainedSeries::fillMatrix(std::size_t j) {
  const std::size_t m = unknowns_.size();
  for (std::size_t b = 0; b < m; ++b) {
    const auto [l, axis] = unknowns_[b];
    const RVec column = axis < 0 ? push_[l][j] : j == 0 ? axisVector(axis) : RVec();
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if (axis < 0 || j == 0) moved_[b][k][j] = answer(k, l, column);
  }
  for (std::size_t a = 0; a < m; ++a) {
    const auto [k, axis] = unknowns_[a];
    right_[a][j] = axis < 0 ? convolved(normal_[k], free_[k], j) : free_[k][j][axis];
    for (std::size_t b = 0; b < m; ++b) {
      const Curve& by = moved_[b][k];
      if (axis >= 0) {
        B_[a][b][j] = by[j][axis];
      } else {
        B_[a][b][j] = unknowns_[b].axis < 0 ? convolved(normal_[k], by, j) : dot(normal_[k][j], by[0]);
      }
    }
  }
}

void ConstrainedSeries::solve(std::size_t j) {
  const std::size_t m = unknowns_.size(), r = solver_.rows.size();
  std::vector<Real> b(r), known(m);
  Real scratch;
  if (!solver_.isSquare)
    for (std::size_t i = 0; i < r; ++i)
      for (std::size_t c = 0; c < m; ++c)
        for (std::size_t o = 1; o <= j; ++o) addProduct(known[c], scratch, B_[solver_.rows[i]][c][o], lambda_[i][j - o]);
  for (std::size_t i = 0; i < r; ++i) {
    const std::size_t row = solver_.rows[i];
    Real sum = right_[row][j];
    for (std::size_t c = 0; c < m; ++c) {
      for (std::size_t o = 1; o <= j; ++o) addProduct(sum, scratch, B_[row][c][o], y_[c][j - o]);
      sum += B_[row][c][0] * known[c];
    }
    b[i] = -sum;
  }
  const std::vector<Real> x = solver_.times(b);
  for (std::size_t c = 0; c < m; ++c) {
    y_[c][j] = solver_.isSquare ? x[c] : known[c];
    for (std::size_t i = 0; i < r && !solver_.isSquare; ++i) y_[c][j] += B_[solver_.rows[i]][c][0] * x[i];
  }
  for (std::size_t i = 0; i < r; ++i) lambda_[i][j] = x[i];
}

// The state of order j + 1.
void ConstrainedSeries::go(std::size_t j) {
  const Real over = Real(1) / (static_cast<int>(j) + 1);
  v_[j + 1] = over * (gravity_[j] + (1 / body_.mass) * force_[j] - crossed(w_, v_, j));
  w_[j + 1] = over * (gyro_[j] + times(inverse_, moment_[j]));
  for (std::size_t a = 0; a < 3; ++a) {
    row_[a][j + 1] = over * crossed(row_[a], w_, j);
    x_[j + 1][static_cast<int>(a)] = over * convolved(row_[a], v_, j);
  }
}

void ConstrainedSeries::findLongest() {
  Real arm = 0;
  for (const ConstrainedCorner& c : corners_) arm = std::max<Real>(arm, norm(c.at));
  const Real spin = norm(w_[0]) + sqrt(norm(body_.gravity) / arm), speed = norm(v_[0]) + arm * spin;
  double least = static_cast<double>(Real(1 / spin));
  for (std::size_t j : {order_ - 1, order_}) {
    const Real share = std::max<Real>({norm(v_[j]) / speed, norm(w_[j]) / spin, norm(row_[0][j]), norm(row_[1][j]), norm(row_[2][j])});
    if (share == 0) continue;
    least = std::min(least, std::exp(static_cast<double>(log(Real(tolerance_ / share))) / static_cast<double>(j)));
  }
  longest_ = 0.9 * least;
}

ConstrainedState ConstrainedSeries::at(const Real& t) const {
  ConstrainedState s;
  RMat transposed;
  for (std::size_t a = 0; a < 3; ++a) transposed.column[a] = sum(row_[a], t);
  s.R = transpose(transposed);
  s.x = sum(x_, t), s.v = s.R * sum(v_, t), s.spin = s.R * sum(w_, t);
  return s;
}

namespace {

using Row = std::array<RVec, 2>;  // by position and turn, or by the velocities

// -M^-1 C^T (C M^-1 C^T)^+ r with independent rows: a move.
Row undoing(const ConstrainedBody& body, const RMat& R, const std::vector<Row>& C, const std::vector<Real>& r) {
  RealRows rows, K;
  std::vector<Row> moved;
  for (const Row& c : C) {
    rows.emplace_back();
    for (const RVec& part : c) rows.back().insert(rows.back().end(), part.at.begin(), part.at.end());
    RVec inverse;
    for (int i = 0; i < 3; ++i) inverse[i] = 1 / body.inertia[i];
    moved.push_back({(1 / body.mass) * c[0], R * times(inverse, transposeTimes(R, c[1]))});
  }
  const std::vector<std::size_t> chosen = independentRows(rows);
  for (std::size_t i : chosen) {
    K.emplace_back();
    for (std::size_t j : chosen) K.back().push_back(dot(C[i][0], moved[j][0]) + dot(C[i][1], moved[j][1]));
  }
  const RealRows inverse = inverseOf(K);
  Row change;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t j = 0; j < chosen.size(); ++j)
      for (std::size_t part = 0; part < 2; ++part)
        change[part] = change[part] - (inverse[i][j] * r[chosen[j]]) * moved[chosen[i]][part];
  return change;
}

}  // namespace

ConstrainedState withoutGaps(const ConstrainedBody& body, const std::vector<ConstrainedCorner>& corners, ConstrainedState s) {
  const RVec L = s.R * times(body.inertia, transposeTimes(s.R, s.spin));  // stays
  for (int round = 0; round < 8; ++round) {
    std::vector<Row> C;
    std::vector<Real> r;
    for (const ConstrainedCorner& c : corners) {
      const RVec arm = s.R * c.at;
      C.push_back({c.normal, cross(arm, c.normal)});
      r.push_back(dot(c.normal, s.x + arm) - c.offset);
    }
    const Row move = undoing(body, s.R, C, r);
    s.x = s.x + move[0];
    s.R = rotationBy(move[1]) * s.R;
  }
  const RVec own = transposeTimes(s.R, L);
  for (int i = 0; i < 3; ++i) s.spin[i] = own[i] / body.inertia[i];
  s.spin = s.R * s.spin;
  return s;
}

ConstrainedState projected(const ConstrainedBody& body, const std::vector<ConstrainedCorner>& corners, ConstrainedState state) {
  ConstrainedState s = withoutGaps(body, corners, std::move(state));
  std::vector<Row> C;
  std::vector<Real> r;
  for (const ConstrainedCorner& c : corners) {
    const RVec arm = s.R * c.at, u = s.v + cross(s.spin, arm);
    const bool stands = c.sticks || c.begins;
    for (int i = 0; i < (stands ? 3 : 1); ++i) {
      const RVec along = stands ? axisVector(i) : c.normal;
      C.push_back({along, cross(arm, along)});
      r.push_back(dot(along, u));
    }
  }
  const Row change = undoing(body, s.R, C, r);
  s.v = s.v + change[0], s.spin = s.spin + change[1];
  return s;
}

}  // namespace carom::reference

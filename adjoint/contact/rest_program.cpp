// SPDX-License-Identifier: MIT
#include "adjoint/contact/rest_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/contact/interior_point.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/numeric/symmetric_eigen.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Motions that contacts oppose by less than this share of the others are not opposed, as a square.
constexpr double kOpposed = 1e-13;
// Forces that leave less than this share of the loads hold them, if they are within the cones but for such a share.
constexpr double kBalanced = 1e-13;
// What is left in rounding of forces and moments that cancel, as a share of them.
constexpr double kCancels = 1e-13;
// The interior point goes on until there is room, until there can be none by so many times what it lacks, or until rooms below
// this get no better.
constexpr double kRestKnown = 1e-8, kLacks = 100, kStillFar = 1e-6;
constexpr int kRestSteps = 80, kRestNoBetter = 6;
constexpr double kSameMotion = 1e-9;

double roomOf(const RestProgram::Contact& c, const Vec3& f) {
  const double pressure = c.normal.dot(f);
  if (!(c.friction > 0)) return pressure / c.unit;  // it is along the normal
  return (pressure - (f - pressure * c.normal).norm() / c.friction) / c.unit;
}

// Velocities of the contact by those of one of its bodies.
Eigen::Matrix<double, 3, 6> rowsOf(const RestProgram::Contact& c, bool of_a) {
  const double sign = of_a ? 1 : -1;
  Eigen::Matrix<double, 3, 6> rows;
  rows << sign * Mat3::Identity(), -sign * skew(of_a ? c.arm_a : c.arm_b);
  return rows;
}

// The rows of what friction can push along: the normal alone where there is none.
struct Rows {
  Eigen::MatrixXd H;         // of all contacts
  std::vector<Index> first;  // row of each
  std::vector<Mat3> axes;    // its rows: n and two directions across it
};

Rows rowsOf(const RestProgram& program) {
  Rows rows;
  Index size = 0;
  for (const RestProgram::Contact& c : program.contacts) {
    rows.first.push_back(size);
    size += c.friction > 0 ? 3 : 1;
    Mat3 axes;
    const Vec3 across = c.normal.unitOrthogonal();
    axes << c.normal.transpose(), across.transpose(), c.normal.cross(across).transpose();
    rows.axes.push_back(axes);
  }
  rows.H = Eigen::MatrixXd::Zero(size, 6 * static_cast<Index>(program.mass.size()));
  for (std::size_t k = 0; k < program.contacts.size(); ++k) {
    const RestProgram::Contact& c = program.contacts[k];
    const Index count = c.friction > 0 ? 3 : 1;
    for (const bool of_a : {true, false})
      if (const int body = of_a ? c.a : c.b; body >= 0)
        rows.H.block(rows.first[k], 6 * body, count, 6) = rows.axes[k].topRows(count) * rowsOf(c, of_a);
  }
  return rows;
}

class RestSolver {
 public:
  explicit RestSolver(const RestProgram& program)
      : program_(program), rows_(rowsOf(program)) {
    const SymmetricEigen<double> eigen(rows_.H.transpose() * rows_.H);
    const double most = eigen.values.size() > 0 ? eigen.values[eigen.values.size() - 1] : 0;
    Index free = 0;  // motions that no contact opposes
    while (free < eigen.values.size() && !(eigen.values[free] > kOpposed * most)) ++free;
    opposed_ = eigen.vectors.rightCols(eigen.vectors.cols() - free);
    squares_ = eigen.values.tail(opposed_.cols());
  }

  RestForces solve() const {
    RestForces none;
    none.room = -std::numeric_limits<double>::infinity();
    none.force.assign(program_.contacts.size(), Vec3::Zero());
    none.unbalanced = unbalancedBy(none.force);
    const RestForces least = balanced(Eigen::VectorXd::Zero(rows_.H.rows()));
    if (!(least.unbalanced <= kBalanced * none.unbalanced)) return least;  // along motions that no contact opposes
    return least.room >= -kBalanced ? least : mostRoom();
  }

 private:
  // Forces next to these that undo the loads.
  RestForces balanced(Eigen::VectorXd f) const {
    for (int round = 0; round < 2; ++round) {  // again for what rounding of the squares leaves
      const Eigen::VectorXd left = program_.load + rows_.H.transpose() * f;
      f -= rows_.H * (opposed_ * (opposed_.transpose() * left).cwiseQuotient(squares_));
    }
    RestForces out;
    out.room = 1;
    for (std::size_t k = 0; k < program_.contacts.size(); ++k) {
      const RestProgram::Contact& c = program_.contacts[k];
      const Index count = c.friction > 0 ? 3 : 1;
      out.force.push_back(rows_.axes[k].topRows(count).transpose() * f.segment(rows_.first[k], count));
      out.room = std::min(out.room, roomOf(c, out.force.back()));
    }
    out.unbalanced = unbalancedBy(out.force);
    return out;
  }

  RestForces mostRoom() const {
    const Eigen::MatrixXd& V = opposed_;
    const auto n = static_cast<Index>(program_.contacts.size());
    const Index size = rows_.H.rows() + 1;
    Eigen::MatrixXd D(size, V.cols());
    Eigen::VectorXd a = Eigen::VectorXd::Zero(size), pushes = Eigen::VectorXd::Zero(rows_.H.cols());
    std::vector<int> cones;
    D.topRows(size - 1) = rows_.H * V;
    // forces in units of the loads: velocities that weigh them go with them
    double unit = 0;
    for (const RestProgram::Contact& c : program_.contacts) unit = std::max(unit, c.unit);
    for (Index k = 0; k < n; ++k) {
      const RestProgram::Contact& c = program_.contacts[static_cast<std::size_t>(k)];
      const Index row = rows_.first[static_cast<std::size_t>(k)];
      pushes += c.unit / unit * rows_.H.row(row).transpose();
      if (c.friction > 0) D.middleRows(row + 1, 2) *= c.friction;  // n.u >= mu |u_t|
      cones.push_back(c.friction > 0 ? 3 : 1);
    }
    D.row(size - 1) = -(V.transpose() * pushes).transpose();
    a[size - 1] = 1;
    cones.push_back(1);
    const Eigen::VectorXd b = -(V.transpose() * (program_.load / unit + pushes));
    InteriorPoint point(D, a, b, cones);
    RestForces best;
    best.room = -std::numeric_limits<double>::infinity();
    for (int i = 0, since = 0; i < kRestSteps && since < kRestNoBetter; ++i) {
      point.step();
      if (!std::isfinite(point.gap()) || !point.unknowns().allFinite()) break;
      const double room = 1 - point.duals()[size - 1];
      Eigen::VectorXd f = unit * point.duals().head(size - 1);
      for (std::size_t k = 0; k < program_.contacts.size(); ++k) {
        if (program_.contacts[k].friction > 0) f.segment<2>(rows_.first[k] + 1) *= program_.contacts[k].friction;
        f[rows_.first[k]] += room * program_.contacts[k].unit;
      }
      RestForces now = balanced(std::move(f));
      const bool far = point.unbalanced() > kStillFar;  // what there is room for shows near the solution alone
      since = far || now.room > best.room ? 0 : since + 1;
      if (now.room > best.room) best = std::move(now);
      if (best.room >= 0) break;
      // no forces have more room than these by what the point still lacks
      const double lacks = point.gap() * static_cast<double>(cones.size()) + point.unbalanced();
      if (best.room < -kLacks * lacks && best.room < -kRestKnown) break;
    }
    return best;
  }

  double unbalancedBy(const std::vector<Vec3>& force) const {
    Eigen::VectorXd left = program_.load, size = program_.load.cwiseAbs();
    for (std::size_t k = 0; k < force.size(); ++k) {
      const RestProgram::Contact& c = program_.contacts[k];
      const auto add = [&](int body, double sign, const Vec3& arm) {
        if (body < 0) return;
        const Vec3 moment = arm.cross(force[k]);
        left.segment<3>(6 * body) += sign * force[k];
        left.segment<3>(6 * body + 3) += sign * moment;
        size.segment<3>(6 * body) += force[k].cwiseAbs();
        size.segment<3>(6 * body + 3) += moment.cwiseAbs();
      };
      add(c.a, 1, c.arm_a), add(c.b, -1, c.arm_b);
    }
    double most = 0;
    for (std::size_t i = 0; i < program_.mass.size(); ++i)
      most = std::max(most, (left.segment<6>(6 * static_cast<Index>(i)).cwiseAbs().maxCoeff() -
                             kCancels * size.segment<6>(6 * static_cast<Index>(i)).maxCoeff()) /
                                program_.mass[i]);
    return most;
  }

  const RestProgram& program_;
  Rows rows_;
  Eigen::MatrixXd opposed_;  // motions that contacts oppose, orthonormal
  Eigen::VectorXd squares_;  // of the velocities of contacts in these
};

}  // namespace

RestForces restForces(const RestProgram& program) { return RestSolver(program).solve(); }

bool opposesEveryMotion(const RestProgram& program, const std::vector<Vec3>& force, double least) {
  RestProgram loaded = program;
  loaded.contacts.clear();
  for (std::size_t k = 0; k < force.size(); ++k)
    if (force[k].norm() > least) loaded.contacts.push_back(program.contacts[k]);
  const Eigen::MatrixXd H = rowsOf(loaded).H;
  return H.rows() > 0 && FullLu(H, kSameMotion).rank() == H.cols();
}

}  // namespace carom::adjoint_detail

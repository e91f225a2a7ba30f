// SPDX-License-Identifier: MIT
#include "editing/solve/nonlinear_program.h"

namespace carom {

// The dense and the sparse form, each by the other: a program overrides one of them.

bool NonlinearProgram::jacobian(const Eigen::VectorXd& x, Eigen::MatrixXd& dg_dx) {
  Eigen::VectorXd entries;
  if (!jacobianEntries(x, entries)) return false;
  dg_dx = Eigen::MatrixXd::Zero(constraints(), variables());
  Eigen::Index k = 0;
  for (const Place& place : jacobianPlaces()) dg_dx(place.row, place.column) += entries[k++];
  return true;
}

bool NonlinearProgram::hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                               Eigen::MatrixXd& h) {
  if (!hasHessian()) return false;
  Eigen::VectorXd entries;
  if (!hessianEntries(x, factor, multipliers, entries)) return false;
  h = Eigen::MatrixXd::Zero(variables(), variables());
  Eigen::Index k = 0;
  for (const Place& place : hessianPlaces()) h(place.row, place.column) += entries[k++];
  h.triangularView<Eigen::StrictlyUpper>() = h.transpose();
  return true;
}

std::vector<NonlinearProgram::Place> NonlinearProgram::jacobianPlaces() const {
  std::vector<Place> places;
  for (int i = 0; i < constraints(); ++i)
    for (int j = 0; j < variables(); ++j) places.push_back({i, j});
  return places;
}

bool NonlinearProgram::jacobianEntries(const Eigen::VectorXd& x, Eigen::VectorXd& entries) {
  Eigen::MatrixXd dg_dx;
  if (!jacobian(x, dg_dx)) return false;
  entries = dg_dx.reshaped<Eigen::RowMajor>();
  return true;
}

std::vector<NonlinearProgram::Place> NonlinearProgram::hessianPlaces() const {
  std::vector<Place> places;
  for (int i = 0; i < variables(); ++i)
    for (int j = 0; j <= i; ++j) places.push_back({i, j});
  return places;
}

bool NonlinearProgram::hessianEntries(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                                      Eigen::VectorXd& entries) {
  Eigen::MatrixXd h;
  if (!hessian(x, factor, multipliers, h)) return false;
  entries.resize(h.rows() * (h.rows() + 1) / 2);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < h.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) entries[k++] = h(i, j);
  return true;
}

}  // namespace carom

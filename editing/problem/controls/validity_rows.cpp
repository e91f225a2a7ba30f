// SPDX-License-Identifier: MIT
#include "editing/problem/controls/validity_rows.hpp"

#include "editing/problem/controls/control_families.hpp"

namespace carom::editing_detail {

ValidityRows::ValidityRows(const ControlSet& controls) {
  const Eigen::VectorXd start = controls.startValues();
  for (std::size_t c = 0; c < controls.controls().size(); ++c) {
    const BoundControl& bound = controls.controls()[c];
    const int control = static_cast<int>(c);
    // of several controls of one owner's moments the first brings the rows
    if (bound.kind->keeps_triangle && controls.ownerOf(control).first_control == control) {
      const double sum = controls.slots(control, start).sum();
      for (int i = 0; i < 3; ++i) rows_.push_back({control, i, sum});
    }
    if (bound.cone > 0) rows_.push_back({control, -1, bound.cone * bound.cone});
  }
}

std::string ValidityRows::describe(const ControlSet& controls, int index) const {
  const Row& row = rows_[static_cast<std::size_t>(index)];
  const Control& control = controls.controls()[static_cast<std::size_t>(row.control)].control;
  if (row.moment < 0) return "cone of " + editing_detail::describe(control);
  return "triangle inequality of " + editing_detail::describe(control, std::string(1, "xyz"[row.moment]));
}

double ValidityRows::value(const Row& row, const Eigen::VectorXd& slots) {
  if (row.moment < 0) return 1 - slots.squaredNorm() / row.scale;
  return (slots.sum() - 2 * slots[row.moment]) / row.scale;
}

Eigen::VectorXd ValidityRows::gradient(const Row& row, const Eigen::VectorXd& slots) {
  if (row.moment < 0) return -2 / row.scale * slots;
  return (Vec3::Ones() - 2 * Vec3::Unit(row.moment)) / row.scale;
}

Eigen::VectorXd ValidityRows::evaluate(const ControlSet& controls, const Eigen::VectorXd& values) const {
  Eigen::VectorXd h(size());
  for (int i = 0; i < size(); ++i) h[i] = value(rows_[i], controls.slots(rows_[i].control, values));
  return h;
}

Eigen::MatrixXd ValidityRows::jacobian(const ControlSet& controls, const Eigen::VectorXd& values) const {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(), controls.size());
  for (int i = 0; i < size(); ++i) {
    const Eigen::VectorXd dh = gradient(rows_[i], controls.slots(rows_[i].control, values));
    for (const int j : controls.ownerOf(rows_[i].control).variables) J(i, j) = dh[controls.variables()[j].slot];
  }
  return J;
}

// Rows of moments are linear; a cone has -2/cone^2 for each of its tilt's two numbers.
Eigen::MatrixXd ValidityRows::hessian(const ControlSet& controls, const Eigen::VectorXd& weights) const {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(controls.size(), controls.size());
  for (int i = 0; i < size(); ++i) {
    if (rows_[i].moment >= 0) continue;
    for (const int j : controls.ownerOf(rows_[i].control).variables) H(j, j) -= 2 * weights[i] / rows_[i].scale;
  }
  return H;
}

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

/// Numbers that depend on the variables of a program in the simplest way. Internal to editing/.
namespace carom {

/// constant + sum of factor * x[variable].
struct Affine {
  struct Term {
    int variable = 0;
    double factor = 0;
  };
  double constant = 0;
  std::vector<Term> terms;

  static Affine variable(int index, double factor = 1) { return {0, {{index, factor}}}; }
  bool isConstant() const { return terms.empty(); }
  double at(const Eigen::VectorXd& x) const {
    double value = constant;
    for (const Term& term : terms) value += term.factor * x[term.variable];
    return value;
  }
  Affine& operator+=(const Affine& other) {
    constant += other.constant;
    terms.insert(terms.end(), other.terms.begin(), other.terms.end());
    return *this;
  }
  Affine& operator*=(double factor) {
    constant *= factor;
    for (Term& term : terms) term.factor *= factor;
    return *this;
  }
  friend Affine operator*(double factor, Affine a) { return a *= factor; }
  friend Affine operator+(Affine a, const Affine& b) { return a += b; }
  friend Affine operator-(Affine a, const Affine& b) { return a += -1.0 * b; }
};

}  // namespace carom

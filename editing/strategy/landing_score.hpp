// SPDX-License-Identifier: MIT
#pragma once

/// Whether it is worth going from a point onto the constraints. Internal to editing/.
namespace carom::editing_detail {

/// What is known of a point before any step is made: how far it is from the constraints, and, where the rows are linear, how
/// long the step onto them and how large the smallest change is, both as shares of the change that is to be beaten.
struct Prospect {
  double violation, step, change;
};

/// The smaller, the likelier that a landing from there brings a smaller change: one of a hundred does at 1, one of a thousand
/// at 4. (v s)^(1/4) e^max(0, c - 1) (1 + tries), with v, s >= 1e-3, fitted to what 140,000 landings brought
/// (docs/decisions.md, 146). `tries`: landings from the same impact sequence so far.
double landingScore(const Prospect& prospect, int tries);

}  // namespace carom::editing_detail

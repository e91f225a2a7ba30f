// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/control.h"

namespace carom {

/// Diagnosis of an edit that does not meet its constraints. Evaluated at the nearest point found, to first order in
/// the controls, within their bounds and within kLargestStep natural scales of that point; remedies marked as solving
/// the edit were tried.
struct WhyNot {
  /// An irreducible infeasible subset of the linearised rows: removing any one of them makes the rest feasible. A single
  /// row is met by no change of the controls, to first order; another impact sequence may meet it.
  struct Conflict {
    std::vector<int> rows;           ///< indices into EditResult::residuals
    std::vector<std::string> names;  ///< "position.x of 'hat' at 1.4 s"
  };
  /// An active bound.
  struct AtBound {
    int control = -1;    ///< index of the Control
    std::string name;    ///< "velocity.x of 'hat'"
    std::string component;  ///< "x"
    double bound = 0;    ///< SI
    bool upper = false;  ///< the upper bound
    double removes = 0;  ///< share of the error removed without this bound, to first order; in [0, 1]
    double change = 0;   ///< how far the parameter then exceeds the bound, SI
  };
  /// Parameters that are not controls and would help.
  struct Help {
    Control control;             ///< with the components that do not vary yet
    std::string name;            ///< "gravity", "velocity of 'hat'"
    double removes = 0;          ///< share of the error removed if they vary too, to first order; in [0, 1]
    double change = 0;           ///< length of their change, in natural scales
    bool restores_rank = false;  ///< the dependent rows become independent
    bool tried = false;          ///< the edit was solved again with them
    bool solves = false;         ///< and all constraints were met
  };
  /// A nail that no motion can meet: the body would be inside a fixed one.
  struct Inside {
    int constraint = -1;  ///< index of the Constraint
    std::string name;   ///< "'hat' at 1.4 s"
    std::string solid;  ///< name of the fixed body
  };

  std::vector<Conflict> conflicts;  ///< irreducible infeasible subsets
  std::vector<AtBound> at_bounds;  ///< most effective first
  std::vector<Help> would_help;    ///< most effective first
  std::vector<Inside> inside;      ///< nails within fixed bodies
  std::vector<std::string> sentences;  ///< all of it as text; empty if not requested or nothing was found

  int rows = 0;           ///< number of rows
  int rank = 0;           ///< of their derivatives with respect to the controls
  int extended_rank = 0;  ///< of those with respect to all parameters that could vary
};

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/control.h"

namespace carom {

/// Why an edit does not meet its constraints. Read at the nearest point that was found, to first order in the controls,
/// within their bounds and within kLargestStep natural scales of that point; what is said to solve the edit was tried.
struct WhyNot {
  /// Constrained numbers that cannot be met together while all but any one of them can: leaving out one is enough. One
  /// alone is out of reach of everything that varies.
  struct Conflict {
    std::vector<int> rows;           ///< indices into EditResult::residuals
    std::vector<std::string> names;  ///< "position.x of 'hat' at 1.4 s"
  };
  /// A number that ended at one of its bounds.
  struct AtBound {
    int control = -1;    ///< index of the Control
    std::string name;    ///< "velocity.x of 'hat'"
    double bound = 0;    ///< SI
    bool upper = false;  ///< the upper one of the two
    double removes = 0;  ///< share of the error that goes without this bound, to first order; in [0, 1]
    double change = 0;   ///< how far the number then goes beyond the bound, SI
  };
  /// Numbers that do not vary and would help.
  struct Help {
    Control control;             ///< with the components that do not vary yet
    std::string name;            ///< "gravity", "velocity of 'hat'"
    double removes = 0;          ///< share of the error that goes when they vary too, to first order; in [0, 1]
    double change = 0;           ///< length of their change, in natural scales
    bool restores_rank = false;  ///< the rows that stand against each other become independent
    bool tried = false;          ///< the edit was solved anew with them
    bool solves = false;         ///< and met all constraints
  };
  /// A nail that no motion reaches: the body would be inside another that stays where it is.
  struct Inside {
    int constraint = -1;  ///< index of the Constraint
    std::string name;   ///< "'hat' at 1.4 s"
    std::string solid;  ///< name of the body it would be in
  };

  std::vector<Conflict> conflicts;  ///< one set of numbers each
  std::vector<AtBound> at_bounds;  ///< those that help most first
  std::vector<Help> would_help;    ///< the best first
  std::vector<Inside> inside;      ///< nails within fixed bodies
  std::vector<std::string> sentences;  ///< all of it for people; empty when nothing was asked or found

  int rows = 0;           ///< constrained numbers
  int rank = 0;           ///< of their derivatives by what varies
  int extended_rank = 0;  ///< by everything that could vary
};

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/shooting/cut.h"
#include "editing/shooting/segment.h"
#include "editing/solve/edit_search.h"

/// A motion cut into segments. Internal to editing/.
namespace carom {

/// The variables of multiple shooting, all dimensionless: the unknowns of the edit, then for every node its time and
/// the states of its bodies, as changes from those of the motion that was cut.
struct ShootingVariables {
  int edit = 0;                 ///< unknowns of the edit
  std::vector<int> node_time;   ///< of each node; -1: its time is fixed
  std::vector<int> node_state;  ///< of each node, the first
  int size = 0;
};

struct Segments {
  std::vector<Segment> segments;
  ShootingVariables variables;
  std::vector<double> node_time_scale;  ///< s
  std::string why_not;                  ///< a sentence where the motion cannot be cut; then there are no segments
};

/// Cuts the motion of a point of a search. The times of nodes are variables, unless the edit has regions: a span of
/// time in which a body keeps to a region ends at a fixed time, and so do its pieces.
Segments makeSegments(const EditProblem& problem, const EditPoint& point, const Cut& cut);

}  // namespace carom

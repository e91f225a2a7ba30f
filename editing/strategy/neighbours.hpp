// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/solve/edit_search.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Unknowns a little beyond the borders of the impact sequence of a differentiated point, where the rows, as they are
/// linear around it, are met and the change is the smallest: with z the smallest change that meets the rows and N an
/// orthonormal basis of the directions that change none, it is z + s N N^T g, g the gradient of the border. Left out
/// are borders that no such direction crosses, and changes longer than `below`: to first order that sequence has no
/// smaller one. The smallest change first.
std::vector<Eigen::VectorXd> beyondBorders(const EditSearch& search, const EditPoint& point, double below);

}  // namespace carom::editing_detail

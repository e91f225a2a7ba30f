// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <Eigen/Core>

namespace carom::cli {

/// Why a check that excused entries, as rounding, has judged nothing, as a sentence; empty where the others speak for the
/// whole. `counts`: entries that are not 0; `excused`: of those that were excused what they differ by, as a share of their
/// column's scale, 0 of all others.
std::string tooManyExcused(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts,
                           const Eigen::MatrixXd& excused);

}  // namespace carom::cli

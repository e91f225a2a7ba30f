// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace carom::cli {

/// Why a check that excused entries, as rounding, has judged nothing, as a sentence; empty where the others speak for the
/// whole. `counts`: entries that are not 0; `excused`: of those that were excused what they differ by, as a share of their
/// column's scale, 0 of all others.
std::string tooManyExcused(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts,
                           const Eigen::MatrixXd& excused);
/// The same of columns that were not compared with differences.
std::string tooManyNotCompared(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts, const std::vector<bool>& compared);

}  // namespace carom::cli

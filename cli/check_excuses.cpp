// SPDX-License-Identifier: MIT
#include "cli/check_excuses.h"

#include <sstream>

namespace carom::cli {
namespace {

constexpr double kMostExcused = 0.05;  // of the entries that are not 0
// What differs by more of its column's scale is not known to a digit or two: rounding or a fault, nobody can tell.
constexpr double kMostRounding = 1e-2;

}  // namespace

std::string tooManyExcused(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts,
                           const Eigen::MatrixXd& excused) {
  int entries = 0, left_out = 0, wide = 0, empty_rows = 0;
  for (Eigen::Index i = 0; i < counts.rows(); ++i) {
    int in_row = 0, of_these = 0;
    for (Eigen::Index j = 0; j < counts.cols(); ++j) {
      if (!counts(i, j)) continue;
      ++in_row;
      of_these += excused(i, j) > 0;
      wide += excused(i, j) > kMostRounding;
    }
    entries += in_row, left_out += of_these;
    empty_rows += in_row > 0 && of_these == in_row;
  }
  std::ostringstream text;
  if (left_out > kMostExcused * entries || empty_rows > 0) {
    text << left_out << " of the " << entries << " entries that are not 0";
    if (empty_rows > 0) text << ", all of " << empty_rows << (empty_rows == 1 ? " row," : " rows,");
    text << " may be rounding of terms that cancel in them.";
  } else if (wide > 0) {
    text << "what may be rounding of terms that cancel is more than " << kMostRounding << " of its column in " << wide
         << (wide == 1 ? " entry." : " entries.");
  }
  return text.str();
}

}  // namespace carom::cli

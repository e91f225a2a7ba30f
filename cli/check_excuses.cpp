// SPDX-License-Identifier: MIT
#include "cli/check_excuses.h"

#include <sstream>

namespace carom::cli {
namespace {

constexpr double kMostExcused = 0.05;  // of the entries that are not 0
// What differs by more of its column's scale is not known to a digit or two: rounding or a fault, nobody can tell.
constexpr double kMostRounding = 1e-2;

// Entries that are not 0, and how many of them are left out.
struct Tally {
  int entries = 0, left_out = 0, empty_rows = 0;

  Tally(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts, const Eigen::MatrixXd& left) {
    for (Eigen::Index i = 0; i < counts.rows(); ++i) {
      int in_row = 0, of_these = 0;
      for (Eigen::Index j = 0; j < counts.cols(); ++j) {
        if (!counts(i, j)) continue;
        ++in_row;
        of_these += left(i, j) > 0;
      }
      entries += in_row, left_out += of_these;
      empty_rows += in_row > 0 && of_these == in_row;
    }
  }
  bool isTooMuch() const { return left_out > kMostExcused * entries || empty_rows > 0; }
  std::string text() const {
    std::ostringstream text;
    text << left_out << " of the " << entries << " nonzero entries";
    if (empty_rows > 0) text << ", all of " << empty_rows << (empty_rows == 1 ? " row," : " rows,");
    return text.str();
  }
};

}  // namespace

std::string tooManyExcused(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts,
                           const Eigen::MatrixXd& excused) {
  const Tally tally(counts, excused);
  if (tally.isTooMuch()) return tally.text() + " may be rounding of cancelling terms.";
  const auto wide = (counts.array() && excused.array() > kMostRounding).count();
  if (wide == 0) return {};
  std::ostringstream text;
  text << "possible rounding of cancelling terms exceeds " << kMostRounding << " of its column in " << wide
       << (wide == 1 ? " entry." : " entries.");
  return text.str();
}

std::string tooManyNotCompared(const Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>& counts, const std::vector<bool>& compared) {
  Eigen::MatrixXd left_out = Eigen::MatrixXd::Zero(counts.rows(), counts.cols());
  for (Eigen::Index j = 0; j < counts.cols(); ++j)
    if (!compared[static_cast<std::size_t>(j)]) left_out.col(j).setOnes();
  const Tally tally(counts, left_out);
  if (!tally.isTooMuch()) return {};
  return tally.text() + " were not compared with differences, because every step leads to another impact sequence, or to an invalid scene.";
}

}  // namespace carom::cli

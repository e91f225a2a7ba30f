// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace carom::test {

/// CAROM_TOLERANCE_SCALE in the environment multiplies every tolerance, so that the real residuals can be seen.
inline double toleranceScale() {
  const char* text = std::getenv("CAROM_TOLERANCE_SCALE");
  return text ? std::atof(text) : 1.0;
}

/// Keeps the largest error/tolerance of the running test in its XML report.
inline void recordShare(double share) {
  static std::string running;
  static double worst = 0;
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = std::string(info->test_suite_name()) + "." + info->name();
  if (name != running) running = name, worst = 0;
  if (share <= worst) return;
  worst = share;
  ::testing::Test::RecordProperty("worst_error_over_tolerance", std::to_string(worst));
}

/// Fails, naming every entry, unless |found - expected| <= tolerance * max(scale, |expected|) for each; NaN fails.
template <class Found, class Expected>
void expectEntries(const Eigen::DenseBase<Found>& found_in, const Eigen::DenseBase<Expected>& expected_in,
                   double tolerance, const std::string& what, double scale = 1) {
  const auto found = found_in.eval();
  const auto expected = expected_in.eval();
  ASSERT_EQ(found.rows(), expected.rows()) << what;
  ASSERT_EQ(found.cols(), expected.cols()) << what;
  const double allowed = tolerance * toleranceScale();
  for (Eigen::Index j = 0; j < found.cols(); ++j)
    for (Eigen::Index i = 0; i < found.rows(); ++i) {
      const double f = found(i, j), x = expected(i, j);
      const double error = std::abs(f - x) / std::max(scale, std::abs(x));
      recordShare(error / tolerance);
      if (!(error <= allowed))
        ADD_FAILURE() << what << ", entry (" << i << ", " << j << "): found " << ::testing::PrintToString(f)
                      << ", expected " << ::testing::PrintToString(x) << ", error " << error << " > " << allowed;
    }
}

inline void expectEntries(double found, double expected, double tolerance, const std::string& what, double scale = 1) {
  expectEntries(Eigen::Matrix<double, 1, 1>(found), Eigen::Matrix<double, 1, 1>(expected), tolerance, what, scale);
}

}  // namespace carom::test

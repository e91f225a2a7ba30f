// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

namespace carom {

/// Independent normal numbers; or, with a factor F, x = mean + F z of independent standard normal z: covariance F F^T.
struct NormalDistribution {
  std::vector<double> mean;       ///< SI; empty: as the scene has them; one for all components; or one each
  std::vector<double> deviation;  ///< standard deviation, > 0; one for all components, or one each; empty with a factor
  std::vector<std::vector<double>> factor = {};  ///< a row for each component, all equally long
};

/// The logarithm is normal: x = median exp(deviation z).
struct LogNormalDistribution {
  std::vector<double> median;  ///< SI, > 0; empty: as the scene has it; one for all components; or one each
  std::vector<double>
      deviation;  ///< standard deviation of the logarithm, > 0; one for all, or one each; empty with a factor
  std::vector<std::vector<double>> factor = {};  ///< of the logarithms, as of NormalDistribution
};

/// Every number between two others is equally likely.
struct UniformDistribution {
  std::vector<double> from;  ///< SI; one for all components, or one each
  std::vector<double> to;    ///< likewise, not below `from`
};

/// Every orientation is equally likely: the invariant (Haar) measure of SO(3). Of an orientation alone.
struct UniformOrientation {};

/// How likely values of a control are, for `explore`. What lies outside of its bounds is cut off.
using Distribution = std::variant<NormalDistribution, LogNormalDistribution, UniformDistribution, UniformOrientation>;

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::threads {

inline constexpr std::size_t kThreads = 4;
inline constexpr int kRounds = 2;

struct Case {
  std::string name;
  Scene scene;
  double duration;      // s
  std::size_t impacts;  // at the most
};

/// A few bodies of every kind, and so many that neighbours are listed in windows.
const std::vector<Case>& allCases();

/// Numbers as their bits.
struct Bits {
  std::vector<std::uint64_t> values;
  void add(double x) { values.push_back(std::bit_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& v) {
    for (int i = 0; i < v.size(); ++i) add(v[i]);
  }
};

}  // namespace carom::threads

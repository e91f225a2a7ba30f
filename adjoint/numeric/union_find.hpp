// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace carom::adjoint_detail {

/// Disjoint sets of 0, ..., n - 1, each with one member that stands for it.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }

  std::size_t find(std::size_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  /// The set of a becomes part of that of b, whose member stands for both.
  void join(std::size_t a, std::size_t b) { up_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> up_;
};

}  // namespace carom::adjoint_detail

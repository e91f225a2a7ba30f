// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace carom::bench {

/// What is measured: the time of `run` over that of `unit`, `parts` of it (impacts, updates) counting as one.
struct Ratio {
  std::string name;
  std::function<void()> run, unit;
  double parts = 1;
};
/// What is counted: work that is the same number on every machine.
struct Count {
  std::string name;
  double number = 0;
};

struct Workloads {
  std::vector<Ratio> ratios;
  std::vector<Count> counts;
};

/// One adjoint row for all numbers of a scene, and second derivatives along four directions, over the simulation; edits
/// and updates of a drag over the simulation of their scene; simulations over arithmetic that never changes.
Workloads workloads();

}  // namespace carom::bench

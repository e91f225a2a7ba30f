// SPDX-License-Identifier: MIT
#include "bench/edits/configurations.h"

namespace carom::bench {
namespace {

EditOptions staying() {
  EditOptions options;
  options.sequence = SequencePolicy::stay;
  return options;
}

EditOptions derivatives(SecondDerivatives source) {
  EditOptions options = staying();
  options.second_derivatives = source;
  return options;
}

EditOptions searchSecant() {
  EditOptions options;
  options.second_derivatives = SecondDerivatives::secant;
  return options;
}

EditOptions searching(Effort effort) {
  EditOptions options;
  options.effort = effort;
  return options;
}

}  // namespace

const std::vector<Configuration>& configurations() {
  static const std::vector<Configuration> rows = {
      {"search", "with search", EditOptions{}},
      {"fast", "with search (fast)", searching(Effort::fast)},
      {"thorough", "with search (thorough)", searching(Effort::thorough)},
      {"search_secant", "with search (secant update)", searchSecant()},
      {"no_search", "Ipopt alone", staying()},
      {"secant", "Ipopt alone (secant update)", derivatives(SecondDerivatives::secant)},
      {"limited_memory", "Ipopt alone (limited memory)", derivatives(SecondDerivatives::limited_memory)},
  };
  return rows;
}

}  // namespace carom::bench

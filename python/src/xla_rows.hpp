// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "editing/nlp_evaluator.h"
#include "python/src/bindings.hpp"

namespace carom::python {

/// While it lives, programs of XLA that are compiled find the evaluator by its number, and keep it from then on.
class OfferedEvaluator {
 public:
  explicit OfferedEvaluator(const NlpEvaluator& evaluator);
  ~OfferedEvaluator();
  OfferedEvaluator(const OfferedEvaluator&) = delete;
  OfferedEvaluator& operator=(const OfferedEvaluator&) = delete;

  std::int64_t number() const { return number_; }
  /// Thread-safe; null if there is none of this number.
  static std::shared_ptr<const NlpEvaluator> find(std::int64_t number);

 private:
  std::int64_t number_;
};

/// What jax.ffi registers, as capsules by their names: the stages of the handler, "type_id" and "type_info". Empty where
/// XLA's headers were not there when this was compiled.
nb::dict xlaHandler();

}  // namespace carom::python

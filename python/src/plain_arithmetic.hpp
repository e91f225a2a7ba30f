// SPDX-License-Identifier: MIT
#pragma once

#include <cfenv>

namespace carom::python {

/// While it lives, this thread computes as IEEE 754 says, whatever its caller has set: JAX calls back with denormal numbers
/// flushed to zero, and then a motion may have other bits.
class PlainArithmetic {
 public:
  PlainArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainArithmetic() { std::fesetenv(&before_); }
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace carom::python

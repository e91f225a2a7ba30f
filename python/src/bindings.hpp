// SPDX-License-Identifier: MIT
#pragma once

// All that converts between C++ and Python, for every file alike: where the conversion of a type is not included, the
// compiler is content, one of two definitions is linked, and calls fail with std::bad_cast.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <string>

#include "adjoint/base/times.h"

namespace nanobind::detail {

/// A number of seconds is one of Python's.
template <>
struct type_caster<carom::Seconds> {
  NB_TYPE_CASTER(carom::Seconds, const_name("float"))
  bool from_python(handle source, uint8_t flags, cleanup_list* cleanup) noexcept {
    make_caster<double> number;
    if (!number.from_python(source, flags, cleanup)) return false;
    value = number.value;
    return true;
  }
  static handle from_cpp(carom::Seconds t, rv_policy policy, cleanup_list* cleanup) noexcept {
    return make_caster<double>::from_cpp(static_cast<double>(t), policy, cleanup);
  }
};

}  // namespace nanobind::detail

namespace carom::python {

namespace nb = nanobind;

/// str() of an object, and of a number.
inline std::string pythonText(nb::handle object) { return nb::cast<std::string>(nb::str(object)); }
inline std::string numberText(double number) { return pythonText(nb::float_(number)); }

}  // namespace carom::python

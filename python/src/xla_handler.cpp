// SPDX-License-Identifier: MIT
// The rows of an edit as a function of XLA, which then calls them without Python. XLA's headers come with jaxlib, if that is
// there when this is compiled; XLA takes handlers that were compiled with headers of another version, or refuses them when
// they are registered (XLA_FFI_API_MAJOR and MINOR).
#include "python/src/xla_rows.hpp"

#if __has_include("xla/ffi/api/ffi.h")
#include <algorithm>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "python/src/computing.hpp"
#include "python/src/evaluator_batch.hpp"
#include "xla/ffi/api/ffi.h"

namespace carom::python {
namespace {

namespace ffi = xla::ffi;

/// What a compiled program keeps for one of its calls.
struct RowsInProgram {
  static ffi::TypeId id;
  std::shared_ptr<const NlpEvaluator> evaluator;
};
ffi::TypeId RowsInProgram::id = {};

ffi::ErrorOr<std::unique_ptr<RowsInProgram>> instantiate(std::int64_t number, std::int64_t /*jacobian*/, std::int64_t /*threads*/) {
  auto found = OfferedEvaluator::find(number);
  if (!found)
    return ffi::Unexpected(ffi::Error(ffi::ErrorCode::kNotFound,
                                      "the evaluator of carom.jax.rows is gone: keep it until the program is compiled"));
  return std::make_unique<RowsInProgram>(RowsInProgram{std::move(found)});
}

std::string messageOf(const nb::python_error& error) {
  const GilHeld held;
  return pythonText(error.type().attr("__name__")) + ": " + pythonText(error.value());
}

/// Ctrl-C is raised again as soon as XLA, which knows no exceptions of Python, has returned: an error of XLA's would be raised before it.
/// So it is given no error, and values that nobody gets to see.
bool isInterrupt(const nb::python_error& error) {
  const GilHeld held;
  if (!error.matches(PyExc_KeyboardInterrupt)) return false;
  PyErr_SetInterrupt();
  return true;
}

std::vector<double> doublesOf(const ffi::AnyBuffer& x) {
  std::vector<double> values(x.element_count());
  if (x.element_type() == ffi::F32)
    std::copy_n(static_cast<const float*>(x.untyped_data()), values.size(), values.begin());
  else
    std::copy_n(static_cast<const double*>(x.untyped_data()), values.size(), values.begin());
  return values;
}

/// The values, or the values as the first of 1 + n columns and the Jacobian as the others.
template <class Real>
void write(const RowsOfMany& rows, std::size_t n, bool jacobian, Real* to) {
  const double* entry = rows.entries.data();
  for (const double value : rows.values) {
    *to++ = static_cast<Real>(value);
    if (!jacobian) continue;
    for (std::size_t k = 0; k < n; ++k) *to++ = static_cast<Real>(*entry++);
  }
}

/// x (..., n) -> (..., m) or (..., m, 1 + n).
ffi::Error execute(RowsInProgram* program, ffi::AnyBuffer x, ffi::Result<ffi::AnyBuffer> result,
                   std::int64_t /*number*/, std::int64_t jacobian, std::int64_t threads) {
  const NlpEvaluator& evaluator = *program->evaluator;
  const std::size_t n = evaluator.variables().size(), m = evaluator.rows().size();
  const auto sizes = x.dimensions();
  std::size_t count = 1;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) count *= static_cast<std::size_t>(sizes[k]);
  const bool real = x.element_type() == ffi::F64 || x.element_type() == ffi::F32;
  if (!real || result->element_type() != x.element_type() || sizes.size() == 0 || static_cast<std::size_t>(sizes.back()) != n ||
      result->element_count() != count * m * (jacobian != 0 ? 1 + n : 1))
    return ffi::Error::InvalidArgument("shapes or types are not those of carom.jax.rows");
  try {
    const PlainArithmetic plain;  // before other threads begin, which take over how it computes
    const std::vector<double> points = doublesOf(x);
    Watch watch{nb::object()};
    const RowsOfMany rows = rowsOfMany(evaluator, points.data(), count, jacobian != 0, static_cast<int>(threads), watch);
    if (x.element_type() == ffi::F32)
      write(rows, n, jacobian != 0, static_cast<float*>(result->untyped_data()));
    else
      write(rows, n, jacobian != 0, static_cast<double*>(result->untyped_data()));
  } catch (const nb::python_error& error) {
    if (!isInterrupt(error)) return ffi::Error::Internal(messageOf(error));
    std::memset(result->untyped_data(), 0xff, result->size_bytes());  // not numbers
  } catch (const std::exception& error) {
    return ffi::Error::InvalidArgument(error.what());
  }
  return ffi::Error::Success();
}

template <class Stage>
auto withAttributes(Stage stage) {
  return std::move(stage)
      .template Attr<std::int64_t>("evaluator")
      .template Attr<std::int64_t>("jacobian")
      .template Attr<std::int64_t>("threads");
}

XLA_FFI_DEFINE_HANDLER(instantiateHandler, instantiate, withAttributes(ffi::Ffi::BindInstantiate()));
XLA_FFI_DEFINE_HANDLER(executeHandler, execute,
                       withAttributes(ffi::Ffi::Bind()
                                          .Ctx<ffi::State<RowsInProgram>>()
                                          .Arg<ffi::AnyBuffer>()
                                          .Ret<ffi::AnyBuffer>()));

}  // namespace

nb::dict xlaHandler() {
  static const XLA_FFI_TypeInfo type = ffi::MakeTypeInfo<RowsInProgram>();
  nb::dict parts;
  parts["instantiate"] = nb::capsule(reinterpret_cast<void*>(instantiateHandler));
  parts["execute"] = nb::capsule(reinterpret_cast<void*>(executeHandler));
  parts["type_id"] = nb::capsule(&RowsInProgram::id);
  parts["type_info"] = nb::capsule(&type);
  return parts;
}

}  // namespace carom::python

#else

namespace carom::python {

nb::dict xlaHandler() { return {}; }

}  // namespace carom::python

#endif

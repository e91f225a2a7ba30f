// SPDX-License-Identifier: MIT
#include "python/src/errors.hpp"

#include <exception>
#include <string>

#include "adjoint/base/errors.h"
#include "formats/base/format_error.h"
#include "python/src/bindings.hpp"

namespace carom::python {
namespace {

/// Text of a file may be anything; an error about it can always be raised.
nb::object readable(const std::string& text) {
  return nb::steal(PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

template <class... Texts>
void raiseAs(const char* name, const Texts&... texts) {
  const nb::object type = nb::module_::import_("carom.errors").attr(name);
  const nb::tuple arguments = nb::make_tuple(readable(texts)...);
  PyErr_SetObject(type.ptr(), arguments.ptr());
}

}  // namespace

void registerErrors() {
  nb::register_exception_translator([](const std::exception_ptr& raised, void*) {
    try {
      std::rethrow_exception(raised);
    } catch (const FormatError& error) {
      raiseAs("FormatError", error.file(), error.where(), error.message());
    } catch (const InputError& error) {
      raiseAs("InputError", error.where(), error.message());
    } catch (const NotComputable& error) {
      raiseAs("NotComputable", std::string(error.what()));
    }
  });
}

}  // namespace carom::python

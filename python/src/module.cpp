// SPDX-License-Identifier: MIT
// The module carom._carom. A file for each part of the API; python/carom/ has what is written in Python.

#include "carom/version.h"
#include "editing/solver_library.h"
#include "python/src/session.hpp"
#include "python/src/errors.hpp"
#include "python/src/motion.hpp"
#include "python/src/scene.hpp"

NB_MODULE(_carom, module) {
  using namespace carom::python;
  module.doc() = "Exact event-driven rigid bodies, with derivatives and edits.";
  module.attr("version") = carom::kVersion;
#ifdef NDEBUG
  nb::set_leak_warnings(false);  // of a program that ends within its threads, or keeps things in cycles, they say that carom is wrong
#endif
  registerErrors();
  bindScene(module);
  bindMotion(module);
  bindSimulate(module);
  bindDerivatives(module);
  bindEdits(module);
  bindSessions(module);
  module.def("set_solver_library", &carom::setSolverLibrary, nb::arg("path"),
             "Names what the first edit opens as Ipopt; the package does so by itself.");
}

// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/session.hpp"

namespace carom::python {
namespace {

using NailIds = std::optional<std::vector<std::optional<int>>>;

/// The nails of a content: the constraints of its document, with the ids of those that are there already.
std::vector<std::pair<NailId, Constraint>> nailsOf(const Document& document, const NailIds& ids) {
  const std::size_t count = document.constraints.size();
  if (ids && ids->size() != count)
    throw InputError("nail_ids", "found " + std::to_string(ids->size()) + " ids, expected " + std::to_string(count) +
                                     ", one for each constraint of the scene");
  std::vector<std::pair<NailId, Constraint>> nails;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<int> id = ids ? (*ids)[i] : std::nullopt;
    nails.emplace_back(id ? NailId{*id} : NailId(), document.constraints[i]);
  }
  return nails;
}

void setContent(const PySession& self, const PyScene& scene, const std::string& name, const NailIds& nail_ids) {
  const Document& document = scene.document();
  const SessionContent content{document.scene, document.duration, document.controls, nailsOf(document, nail_ids)};
  readFrom(self, [&](EditSession& of) { of.setContent(content, name); });
}

template <class Value>
ReadOnly<-1> grabbedPart(const PySession& self, Value (EditSession::*member)() const) {
  const Value value = readFrom(self, [&](EditSession& of) { return (of.*member)(); });
  if constexpr (std::is_same_v<Value, Quat>) return copied<ReadOnly<-1>>(Eigen::VectorXd(wxyz(value)));
  else return copied<ReadOnly<-1>>(Eigen::VectorXd(value));
}

}  // namespace

void bindSessionContent(nb::class_<PySession>& session) {
  session
      .def("set_content", &setContent, nb::arg("scene"), nb::arg("name"), nb::kw_only(), nb::arg("nail_ids") = nb::none(),
           "Replaces the whole content by a scene with its duration, controls and constraints, under a name for undo: typed "
           "numbers, added or removed bodies, another duration. Simulates it and solves nothing. nail_ids: for each "
           "constraint of the scene the id of the nail that it is, which stays on or off as it was, or None for a new one "
           "(default: all are new). Rejected as a whole if invalid (InputError). One undo step.")
      .def_prop_ro("grabbed_place", [](const PySession& self) { return grabbedPart(self, &EditSession::grabbedPlace); },
                   kOwnArray, "(3,), m, of the grabbed point. Raises InputError without a grab.")
      .def_prop_ro("grabbed_orientation",
                   [](const PySession& self) { return grabbedPart(self, &EditSession::grabbedOrientation); }, kOwnArray,
                   "(4,), w, x, y, z, of the grabbed body. Raises InputError without a grab.");
}

}  // namespace carom::python

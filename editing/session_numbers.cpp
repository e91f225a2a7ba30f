// SPDX-License-Identifier: MIT
#include "editing/session_numbers.h"

#include "editing/problem/controls/control_binding.hpp"

namespace carom {
using namespace editing_detail;

std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls) {
  std::vector<SessionNumber> numbers;
  Scene prepared = scene;
  for (const Control& control : controls) {
    const BoundControl bound = bindControl(prepared, control, "");
    const std::string name = describe(control);
    if (bound.kind->is_turn) {  // as a control it is a turn from where it was; here it is where it is
      const Quat& q = prepared.bodies[static_cast<std::size_t>(bound.owner.body)].orientation;
      const double parts[] = {q.w(), q.x(), q.y(), q.z()};
      for (int k = 0; k < 4; ++k) numbers.push_back({name + ", " + std::string(1, "wxyz"[k]), parts[k]});
      continue;
    }
    const std::vector<std::string> components = bound.kind->components(prepared, bound.owner);
    const Eigen::VectorXd values = bound.kind->get(prepared, bound.owner);
    for (std::size_t k = 0; k < components.size(); ++k)
      numbers.push_back(
          {components.size() > 1 ? name + ", " + components[k] : name, values[static_cast<Eigen::Index>(k)]});
  }
  return numbers;
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "editing/session_numbers.h"

#include <algorithm>
#include <cmath>

#include "editing/problem/controls/control_binding.hpp"

namespace carom {
using namespace editing_detail;

namespace {

/// As a control an orientation is a turn from where it was; here it is where it is.
void addTurn(const Scene& scene, const BoundControl& bound, int control, std::vector<SessionNumber>& numbers) {
  const Quat& q = scene.bodies[static_cast<std::size_t>(bound.owner.body)].orientation;
  const double parts[] = {q.w(), q.x(), q.y(), q.z()};
  for (int k = 0; k < 4; ++k) {
    SessionNumber number;
    number.component = std::string(1, "wxyz"[k]);
    number.name = describe(bound.control, number.component);
    number.value = parts[k];
    number.control = control;
    number.varies = true;
    numbers.push_back(std::move(number));
  }
}

void addNumbers(const Scene& scene, const BoundControl& bound, int control, const std::string& where,
                std::vector<SessionNumber>& numbers) {
  const std::vector<std::string> components = bound.kind->components(scene, bound.owner);
  const Eigen::VectorXd values = bound.kind->get(scene, bound.owner), scales = bound.kind->scale(scene, bound.owner);
  const std::vector<int> varying = varyingSlots(scene, bound, where);
  const int count = static_cast<int>(varying.size());
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Eigen::Index slot = static_cast<Eigen::Index>(k);
    SessionNumber number;
    number.component = components[k];
    number.name = describe(bound.control, number.component);
    number.value = values[slot];
    number.control = control;
    // of a number that is weighed by its logarithm, to first order
    number.scale = scales[slot] * (!bound.kind->logarithmic ? 1 : number.value != 0 ? std::abs(number.value) : 1);
    const auto place = std::find(varying.begin(), varying.end(), static_cast<int>(k));
    number.varies = place != varying.end();
    if (number.varies) {
      const Interval bounds = boundsOf(bound, static_cast<int>(place - varying.begin()), count, number.value, where);
      number.min = bounds.lower, number.max = bounds.upper;
    }
    numbers.push_back(std::move(number));
  }
}

}  // namespace

std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls) {
  std::vector<SessionNumber> numbers;
  Scene prepared = scene;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const std::string where = "/controls/" + std::to_string(i);
    const BoundControl bound = bindControl(prepared, controls[i], where);
    if (bound.kind->is_turn) {
      addTurn(prepared, bound, static_cast<int>(i), numbers);
    } else {
      addNumbers(prepared, bound, static_cast<int>(i), where, numbers);
    }
  }
  return numbers;
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/held/held_inputs.hpp"

namespace carom::adjoint_detail {

/// An instant of a path in numbers that carry the rates along some of its inputs.
struct HeldLanes {
  static constexpr int kColumns = 12;  ///< at a time
  using Number = Dual<kColumns>;
  V3<Number> x;
  M3<Number> R;  // shape axes to world
  BodyInstant<Number> body;
  std::vector<ContactInstant<Number>> contacts;
  std::vector<Number> gap;
};

/// Fills an instant of a path, and calls visit(lanes, first, count) for the columns first, first + 1, ... of HeldInputs
/// until all were there. `slip`: a direction for each contact that is kept as it is; a zero vector lets it follow the slip.
class HeldRates {
 public:
  HeldRates(const HeldScene& scene, const std::vector<HeldContact>& contacts, const HeldInputs& inputs,
            const State& state, std::vector<Vec3> slip);

  template <class Visit>
  void each(const Visit& visit) {
    for (int first = 0; first < inputs_.count; first += HeldLanes::kColumns) {
      const int count = std::min(HeldLanes::kColumns, inputs_.count - first);
      visit(lanes(first, count), first, count);
    }
  }
  const HeldInstant& now() const { return now_; }

 private:
  /// Whether a contact slides in the direction in which it goes.
  bool follows(std::size_t k) const { return contacts_[k].mode == HeldMode::slides && slip_[k].isZero(0); }
  HeldLanes lanes(int first, int count) const;
  void fillBody(HeldLanes& out, int first, int count) const;
  ContactInstant<HeldLanes::Number> contactLanes(const HeldLanes& of, std::size_t k, int first, int count,
                                                 HeldLanes::Number& gap) const;
  void addGeometry(ContactInstant<HeldLanes::Number>& c, V3<HeldLanes::Number>& point, HeldLanes::Number& gap, std::size_t k,
                   int first, int count) const;

  const HeldScene& scene_;
  const std::vector<HeldContact>& contacts_;
  const HeldInputs& inputs_;
  State state_;
  std::vector<Vec3> slip_;
  HeldInstant now_;
  Pose own_;
  std::vector<ContactJacobian> jacobians_;
  std::vector<ContactJacobian> jacobian_rates_;  // as the body goes its way
};

}  // namespace carom::adjoint_detail

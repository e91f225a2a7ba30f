// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/flat_rim.hpp"

namespace carom::adjoint_detail {

/// Fills an instant of a path, at time t, and calls visit(lanes, first, count) for the columns first, first + 1, ... of ConstrainedInputs
/// until all were there. `slip`: a direction for each contact that is kept as it is; a zero vector lets it follow the slip.
/// `may_be_flat`: rims that lie flat tilt from there, and their lanes have no rates of normals and places in time.
class ConstrainedRates {
 public:
  ConstrainedRates(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const ConstrainedInputs& inputs,
            const State& state, double t, std::vector<Vec3> slip, bool may_be_flat = false);

  template <class Visit>
  void each(const Visit& visit) {
    for (int first = 0; first < inputs_.count; first += ConstrainedLanes::kColumns) {
      const int count = std::min(ConstrainedLanes::kColumns, inputs_.count - first);
      visit(lanes(first, count), first, count);
    }
  }
  const ConstrainedInstant& now() const { return now_; }
  /// Of the support of contact k.
  const SupportFlow& flow(std::size_t k) const { return flows_[k]; }

 private:
  /// Whether a contact slides in the direction in which it goes.
  bool follows(std::size_t k) const { return contacts_[k].mode == ContactMode::slides && slip_[k].isZero(0); }
  ConstrainedLanes lanes(int first, int count) const;
  void fillBody(ConstrainedLanes& out, int first, int count) const;
  ContactInstant<ConstrainedLanes::Number> contactLanes(const ConstrainedLanes& of, std::size_t k, int first, int count,
                                                 ConstrainedLanes::Number& gap) const;
  void placeLanes(const ConstrainedLanes& of, std::size_t k, int first, int count, ContactInstant<ConstrainedLanes::Number>& c,
                  ConstrainedLanes::Number& gap) const;
  void addSupportRate(std::size_t k, int first, int count, int i, ConstrainedLanes::Number& normal, ConstrainedLanes::Number& place) const;
  Eigen::Matrix<double, 7, 1> bentBySupport(std::size_t k, int column) const;
  void addGeometry(ContactInstant<ConstrainedLanes::Number>& c, V3<ConstrainedLanes::Number>& point, ConstrainedLanes::Number& gap, std::size_t k,
                   int first, int count) const;

  const ConstrainedScene& scene_;
  const std::vector<PersistentContact>& contacts_;
  const ConstrainedInputs& inputs_;
  State state_;
  std::vector<Vec3> slip_;
  ConstrainedInstant now_;
  Pose own_;
  std::vector<SupportFlow> flows_;
  std::vector<ContactJacobian> jacobians_;
  std::vector<ContactJacobian> jacobian_rates_;  // as body and support go their ways
  std::vector<std::optional<FlatRim>> flat_;     // of contacts at rims that lie flat; empty where there are none
};

}  // namespace carom::adjoint_detail

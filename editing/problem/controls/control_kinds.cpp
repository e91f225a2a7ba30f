// SPDX-License-Identifier: MIT
#include "editing/problem/controls/control_kinds.hpp"

#include "editing/problem/controls/control_families.hpp"

namespace carom::editing_detail {

namespace {

const ControlKind* const kTable[] = {
    &kPositionControl,
    &kOrientationControl,
    &kVelocityControl,
    &kAngularVelocityControl,
    &kSurfaceVelocityControl,
    &kSurfaceAngularVelocityControl,
    &kElasticityControl,
    &kFrictionControl,
    &kTangentialElasticityControl,
    &kMassControl,
    &kInertiaControl,
    &kSizeControl,
    &kTiltControl,
    &kGravityControl,
};

}  // namespace

std::span<const ControlKind* const> controlKinds() { return kTable; }

const ControlKind* findControlKind(const std::string& word) {
  for (const ControlKind* kind : kTable) {
    if (word == kind->word) return kind;
  }
  return nullptr;
}

}  // namespace carom::editing_detail

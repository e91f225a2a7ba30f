// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "adjoint/motion/contact_source.h"

namespace carom {

/// Collision detection for all shapes. The Open Dynamics Engine's sweep-and-prune space proposes the pairs whose
/// swept boxes overlap; exact geometry in double precision decides when, where and with which features they touch.
/// One object serves one simulation at a time; different objects may be used in different threads. Functions throw
/// InputError for invalid bodies and for times that are not finite.
class OdeContacts final : public ContactSource {
 public:
  /// For simulations of this and similar scenes: pairs that overlap at the start of this one do not collide until
  /// they have separated; if others overlap, `begin` throws InputError. Throws InputError for an invalid scene (see
  /// validate), and for more than 100 000 overlapping pairs. The search for them is counted in `work`, if given, and
  /// propagates its WorkEnded.
  explicit OdeContacts(const Scene& scene, WorkCount* work = nullptr);
  ~OdeContacts() override;
  OdeContacts(const OdeContacts&) = delete;
  OdeContacts& operator=(const OdeContacts&) = delete;

  void begin(const Scene& scene) override;
  std::vector<StartOverlap> overlaps() const override;
  std::vector<PlacedContact> placed() const override;
  std::optional<double> parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override;
  void setPath(int body, const Arc& arc, double from, double until) override;
  double window(int body, double t) override;
  void neighbours(int body, std::vector<int>& out) override;
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override;
  std::optional<PredictedImpact> firstImpactBeside(int a, int b, std::span<const FeaturePair> held, Arc& arc_a,
                                                   Arc& arc_b, double from, double until) override;
  std::optional<PredictedImpact> firstImpactOnGround(int a, int b, std::span<const PersistentFeatures> held, Arc& arc_a,
                                                     Arc& arc_b, double from, double until) override;
  std::span<const int> groundBeside(int body) const override;
  std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t,
                                    double tolerance) override;
  std::shared_ptr<const ContactGeometry> geometry() const override;
  std::unique_ptr<ContactSource> another() const override;

 private:
  OdeContacts();
  void take(const Scene& scene);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carom

// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <stop_token>
#include <utility>

#include "adjoint/motion/contact_source.h"

namespace carom::testing_sessions {

/// What asks for a stop when so many motions have begun, in whatever thread: no clock is needed to stop in the middle.
struct StopAfter {
  std::atomic<int> begun = 0, limit = -1;  ///< -1: never
  std::stop_source source;

  /// From here on `motions` more, then a stop; the token of it.
  std::stop_token set(int motions) {
    source = std::stop_source();
    begun = 0, limit = motions;
    return source.get_token();
  }
};

/// Collision detection that counts motions.
class StoppingContacts : public ContactSource {
 public:
  StoppingContacts(ContactSource& inner, StopAfter& stop) : inner_(inner), stop_(stop) {}
  StoppingContacts(std::unique_ptr<ContactSource> own, StopAfter& stop)
      : own_(std::move(own)), inner_(*own_), stop_(stop) {}

  void begin(const Scene& scene) override {
    if (stop_.begun++ == stop_.limit) stop_.source.request_stop();
    inner_.countIn(work());
    inner_.begin(scene);
  }
  std::vector<StartOverlap> overlaps() const override { return inner_.overlaps(); }
  std::vector<PlacedContact> placed() const override { return inner_.placed(); }
  std::optional<double> parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override {
    return inner_.parting(a, b, arc_a, arc_b, from, until);
  }
  void setPath(int body, const Arc& arc, double from, double until) override { inner_.setPath(body, arc, from, until); }
  double window(int body, double t) override { return inner_.window(body, t); }
  void neighbours(int body, std::vector<int>& out) override { inner_.neighbours(body, out); }
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                             double until) override {
    return inner_.firstImpact(a, b, arc_a, arc_b, from, until);
  }
  std::optional<PredictedImpact> firstImpactBeside(int a, int b, std::span<const FeaturePair> held, Arc& arc_a,
                                                   Arc& arc_b, double from, double until) override {
    return inner_.firstImpactBeside(a, b, held, arc_a, arc_b, from, until);
  }
  std::optional<PredictedImpact> firstImpactOnGround(int a, int b, std::span<const PersistentFeatures> held, Arc& arc_a,
                                                     Arc& arc_b, double from, double until) override {
    return inner_.firstImpactOnGround(a, b, held, arc_a, arc_b, from, until);
  }
  std::span<const int> groundBeside(int body) const override { return inner_.groundBeside(body); }
  std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) override {
    return inner_.touching(a, b, arc_a, arc_b, t, reach);
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return inner_.geometry(); }
  std::unique_ptr<ContactSource> another() const override {
    return std::make_unique<StoppingContacts>(inner_.another(), stop_);
  }

 private:
  std::unique_ptr<ContactSource> own_;
  ContactSource& inner_;
  StopAfter& stop_;
};

}  // namespace carom::testing_sessions

// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/second_order/lanes.hpp"

namespace carom::detail {

using Num7 = Eigen::Matrix<Num, 7, 1>;

/// One event, linearised, in dual numbers: EventLinearization and ImpactAssembly with the rates of all that they hold.
/// The weights of the gaps of a joint event are held: they weigh gaps that are all 0 there.
class DualEvent {
 public:
  DualEvent(const Lanes& lanes, int event);

  /// As EventLinearization::pullback.
  std::vector<StateBar> pullback(const std::vector<StateBar>& after_bar, const std::vector<StateBar>& read_bar,
                                 const Num& time_bar, SceneBar& scene_bar, std::vector<ModelBar>& model_bar) const;
  const DualState& before(std::size_t participant) const { return bodies_[participant].before; }

 private:
  struct MovingBody {
    int body;
    DualState before;
    NMat A;  // world inverse inertia
    NVec omega;
    StateBar rate_before, rate_after;
  };
  struct Side {
    int body, participant;  // participant -1: a fixed body
  };
  struct ContactPart {
    Side a, b;
    double weight = 0;
    Eigen::Matrix<Num, 7, 12> pose;
    Eigen::Matrix<Num, 7, Eigen::Dynamic> size_a, size_b;
    NVec point, impulse_normal;
    bool tilted = false;
    Eigen::Matrix<Num, 3, 7> tilt;
    int material_a = -1, material_b = -1;
  };
  // One body at one contact.
  struct Arm {
    std::size_t contact, participant;
    double sign;
    NVec r;
  };
  // With the fields of ImpactProblem; as a Bar with those of ImpactProblemDerivative.
  struct Problem {
    Eigen::Matrix<Num, Eigen::Dynamic, Eigen::Dynamic> K;
    Eigen::Matrix<Num, Eigen::Dynamic, 1> u;
    std::vector<NVec> normal;
    std::vector<PairNums> pair;
    bool driven = false;
  };

  bool isKinematic(std::size_t participant) const;
  void addBody(const Participant& p);
  void addContact(const Contact& c, double weight);
  PairTangent pairTangent(const ContactPart& part, std::size_t lane) const;
  void tiltNormal(const Contact& c, const Num7& at, ContactPart& part) const;
  PairNums pairOf(const Contact& c, const ContactPart& part) const;
  void assemble();
  std::vector<StateBar> throughLaw(const std::vector<StateBar>& after_bar, std::vector<Num7>& contact_bar,
                                   std::vector<PairNums>& pair_bar, std::vector<ModelBar>& model_bar) const;
  std::vector<StateBar> throughWideLaw(const std::vector<StateBar>& after_bar, std::vector<Num7>& contact_bar,
                                       std::vector<PairNums>& pair_bar, std::vector<ModelBar>& model_bar) const;
  Problem lawPullback(const Eigen::Matrix<Num, Eigen::Dynamic, 1>& P_bar) const;
  void scatter(const ContactPart& part, const Num7& bar, std::vector<StateBar>& before_bar, SceneBar& scene_bar) const;
  void materialPullback(const Contact& c, const ContactPart& part, const PairNums& bar, SceneBar& scene_bar) const;

  const Lanes& lanes_;
  int index_;
  const Event& event_;
  std::vector<MovingBody> bodies_;
  std::vector<ContactPart> parts_;
  std::vector<Arm> arms_;
  Problem problem_;
  Eigen::Matrix<Num, Eigen::Dynamic, 1> P_;
  Num D_;
  bool wide_ = false;  // doubles are too short for its impact, see WideImpact
};

}  // namespace carom::detail

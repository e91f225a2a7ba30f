// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/arguments.hpp"
#include "ode_bridge/ball_impact.hpp"
#include "ode_bridge/ground.hpp"
#include "ode_bridge/neighbours.hpp"
#include "ode_bridge/ode_contacts.h"
#include "ode_bridge/pair_motion.hpp"

namespace carom {

namespace ode_bridge_detail {

// Impacts among balls that move and planes have a closed form.
enum class Quick : char { fixed, moving, ball, plane };
inline bool isQuick(Quick q) { return q == Quick::ball || q == Quick::plane; }

}  // namespace ode_bridge_detail

using namespace adjoint_detail;
using namespace ode_bridge_detail;

struct OdeContacts::State {
  Neighbours neighbours;
  NarrowPhase narrow_phase;
  std::shared_ptr<const FeatureGeometry> geometry;
  std::vector<SolidSource> sources;  // of its solids
  std::vector<Quick> quick;     // of each body
  std::map<int, Arc> varied;    // moving bodies whose acceleration varies
  Ground ground;
  std::vector<char> in_series;  // whether its arcs have to be extended; known here, arcs are far away in memory
  int opened = -1;              // body whose window was asked for last, when and up to where
  double opened_from = 0, opened_until = 0, end = 0;

  std::size_t checkedBody(const char* call, int body) const {
    return checkedIndex(call, "body", body, quick.size());
  }
  std::vector<StartOverlap> overlaps;
  std::vector<PlacedContact> placed;
  std::set<std::pair<std::string, std::string>> accepted;  // names of pairs that overlap in the scene it was made for

  void takeSolids(const Scene& scene);
  void lookAtStart(const std::vector<Arc>& arcs, WorkCount* work);
  bool isAccepted(const Scene& scene, const StartOverlap& overlap) const;
  BallImpact quickImpact(int a, int b, double from, double until) const;
  FeaturePair quickFeatures(int a, int b) const;
  void takeGround(const std::vector<Arc>& arcs, const std::vector<BodyExtent>& extents);
  bool mayBeBeyond(int body, const Vec3& n, const Vec3& p, double room) const;
  double quickGap(int a, int b, const Arc& arc_a, const Arc& arc_b, double t) const;
  void keepVaried(int body, const Arc& arc);
  void placeVaried(int body, double t);
  void keepThoseThatMayMeet(int body, std::vector<int>& others) const;
};

}  // namespace carom

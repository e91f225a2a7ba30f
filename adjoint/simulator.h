#pragma once

#include <queue>
#include <vector>

#include "adjoint/simulate.h"

namespace carom {

/// Contacts closer in time than this, in one contact graph, are one instant (docs/equations.md section 4).
inline constexpr double kInstant = 1e-10;  // s
/// A bounce lower than this, onto the same features, is the tail of a cascade: positions of ordinary size resolve 1e-16
/// m, so below it the height of a bounce has no digits left to speak of.
inline constexpr double kLowestBounce = 1e-12;  // m
/// Bounces that low on changing features (a rattling box) count as a cascade after so many in a row.
inline constexpr int kRattles = 8;
/// As many events as this within kStall seconds are a cascade, whichever bodies they belong to.
inline constexpr std::size_t kStallEvents = 64;
inline constexpr double kStall = 1e-9;  // s

/// The event loop behind `simulate`.
class Simulator {
 public:
  Simulator(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options);
  Motion run();

 private:
  // The first impact of a pair, or (b = -1) the time up to which the pairs of body a have been searched.
  struct Prediction {
    double time;
    int a, b;
    FeaturePair features;
    int version_a, version_b;  // of the arcs it was made for
    bool isHorizon() const { return b < 0; }
    bool operator>(const Prediction& o) const {
      if (time != o.time) return time > o.time;
      if (isHorizon() != o.isHorizon()) return isHorizon();  // an impact at its horizon comes first
      return a != o.a ? a > o.a : b > o.b;
    }
  };
  // An event that is worked out but not yet part of the motion.
  struct Draft {
    Event event;
    std::vector<Arc> arcs;                // of the participants, from the event on
    std::vector<Prediction> predictions;  // of the participants' pairs, on those arcs
  };
  struct LowBounces {
    int a, b, count;
  };

  void start();
  bool takeNext(Prediction& next);
  bool holds(const Prediction& p) const;  // the arcs it was made for are in force
  Draft resolve(const Prediction& first);
  Draft draft(double time, const std::vector<Contact>& contacts);
  void predict(Draft& draft);
  void predictBody(int body, double from);
  template <class ArcOf, class VersionOf>
  void searchBody(int body, double from, const ArcOf& arc_of, const VersionOf& version_of,
                  std::vector<Prediction>& found);
  std::vector<Contact> contactsOfInstant(const Prediction& first);
  void addTouching(double time, int a, int b, const FeaturePair& features, std::vector<Contact>& contacts);
  bool joinInstant(const Draft& draft, std::vector<Contact>& contacts);
  void commit(Draft&& draft);
  bool separates(const Draft& draft);
  bool accumulates(const Draft& draft);
  void finish(MotionStatus status, double end, std::string message);

  Arc& arcOf(int body) { return motion_.world_lines[static_cast<std::size_t>(body)].arcs.back(); }
  Contact makeContact(double time, int a, int b, const FeaturePair& features);
  int tiltOf(int body, int impact) const;

  const Scene& scene_;
  ContactSource& contacts_;
  std::size_t impact_limit_;
  Motion motion_;
  std::vector<int> version_, impacts_;  // a body each
  std::vector<const Material*> material_;
  std::vector<LowBounces> low_bounces_;
  std::vector<int> neighbours_;
  std::priority_queue<Prediction, std::vector<Prediction>, std::greater<>> queue_;
};

}  // namespace carom

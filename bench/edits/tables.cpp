// SPDX-License-Identifier: MIT
#include "bench/edits/tables.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {
namespace {

constexpr double kRadius = 0.0286, kMass = 0.17;          // m, kg: a pool ball
constexpr double kHalfLength = 1.27, kHalfWidth = 0.635;  // m, between the rails
constexpr double kLongestShot = 12;                       // s
constexpr double kLongestLeg = 1.5;                       // s, after its last rail
constexpr double kShortestLeg = 0.05;                     // s
constexpr double kSlowest = 0.15;                         // m/s, at the end of a leg
constexpr double kLargestCut = 0.9;                       // rad, between the velocity of a ball and the line of centres
constexpr double kRoom = 1.1;                             // between centres of balls, in diameters

Body ball(const std::string& name, const Vec3& place) {
  Body body;
  body.name = name;
  body.material = "resin";
  body.shape = Sphere{kRadius};
  body.mass = kMass;
  body.position = place;
  return body;
}

void addRails(Scene& scene, Dice& dice) {
  const bool boxes = dice.chance(0.3);
  const struct {
    const char* name;
    Vec3 inwards;
    double distance;
  } rails[] = {{"rail_east", -Vec3::UnitX(), kHalfLength},
               {"rail_west", Vec3::UnitX(), kHalfLength},
               {"rail_north", -Vec3::UnitY(), kHalfWidth},
               {"rail_south", Vec3::UnitY(), kHalfWidth}};
  constexpr double kThick = 0.1;
  for (const auto& rail : rails) {
    Body body;
    body.name = rail.name;
    body.fixed = true;
    body.material = "cushion";
    if (boxes) {
      const Vec3 along = Vec3::UnitZ().cross(rail.inwards).cwiseAbs();
      body.shape = Box{Vec3(kThick * rail.inwards.cwiseAbs() + 3 * along + 0.2 * Vec3::UnitZ())};
      body.position = -(rail.distance + kThick / 2) * rail.inwards;
    } else {
      body.shape = Plane{rail.inwards, -rail.distance};
    }
    scene.bodies.push_back(body);
  }
}

Scene drawTable(Dice& dice) {
  Scene scene;
  Material resin{.name = "resin", .elasticity = dice.in(0.85, 0.98), .friction = 0};
  Material cushion{.name = "cushion", .elasticity = dice.in(0.6, 0.9), .friction = 0};
  cushion.combine_elasticity = Combine::minimum;
  scene.gravity.setZero();
  if (dice.chance(0.35)) {
    scene.gravity = Vec3(0, 0, -9.81);
    Material cloth{.name = "cloth", .elasticity = 0.5, .friction = dice.chance(0.5) ? 0 : dice.in(0.01, 0.1)};
    cloth.combine_friction = Combine::maximum;
    Body floor;
    floor.name = "cloth";
    floor.fixed = true;
    floor.material = "cloth";
    floor.shape = Plane{Vec3::UnitZ(), -kRadius};
    scene.bodies.push_back(floor);
    scene.materials.push_back(cloth);
  } else if (dice.chance(0.3)) {
    resin.friction = dice.in(0.03, 0.1), cushion.friction = dice.in(0.1, 0.2);
  }
  scene.materials.push_back(resin);
  scene.materials.push_back(cushion);
  addRails(scene, dice);
  return scene;
}

Vec3 drawPlace(Dice& dice) {
  const double x = dice.in(-0.9, 0.9) * kHalfLength, y = dice.in(-0.85, 0.85) * kHalfWidth;
  return {x, y, 0};
}

bool isFree(const Scene& scene, const Vec3& place) {
  const bool inside =
      std::abs(place.x()) < kHalfLength - kRoom * kRadius && std::abs(place.y()) < kHalfWidth - kRoom * kRadius;
  return inside && std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) {
           return !b.fixed && (b.position - place).norm() < 2 * kRoom * kRadius;
         });
}

Motion play(const Scene& scene) {
  OdeContacts contacts(scene);
  return simulate(scene, contacts, kLongestShot, {.impact_limit = 60, .asked = {}});
}

bool isRail(const Scene& scene, int body) {
  return scene.bodies[static_cast<std::size_t>(body)].name.starts_with("rail");
}

int partnerIn(const Event& e, int body) {
  for (const Contact& c : e.contacts)
    if (c.counted && (c.a == body || c.b == body)) return c.a == body ? c.b : c.a;
  return -1;
}

// Lays out a shot, ball by ball, each where the one before it passes.
class Layout {
 public:
  explicit Layout(Dice& dice) : dice_(dice) {
    shot_.scene = drawTable(dice);
    Body cue = ball("cue", drawPlace(dice));
    const double angle = dice.in(-M_PI, M_PI), speed = dice.logIn(1, 5);
    cue.velocity = speed * Vec3(std::cos(angle), std::sin(angle), 0);
    shot_.scene.bodies.push_back(cue);
    shot_.mover = shot_.striker = shot_.struck = "cue";
  }

  bool add(const Leg& leg) {
    shot_.mover = leg.cue ? "cue" : shot_.struck;
    if (!follow(leg.rails)) return false;
    if (!leg.strikes) return true;
    constexpr const char* kNames[] = {"red", "yellow", "blue"};
    const std::string name = kNames[laid_.size()];
    const double t = shot_.from + dice_.in(0.3, 0.9) * (shot_.to - shot_.from);
    const BodyState s = motion_.stateAt(shot_.mover, t);
    if (!(s.velocity.head<2>().norm() >= kSlowest)) return false;
    const double cut = dice_.in(-kLargestCut, kLargestCut);
    const Vec3 towards = Eigen::AngleAxisd(cut, Vec3::UnitZ()) * Vec3(s.velocity.x(), s.velocity.y(), 0).normalized();
    const Vec3 place = s.position + 2 * kRadius * towards;
    if (!isFree(shot_.scene, place)) return false;
    shot_.scene.bodies.push_back(ball(name, place));
    laid_.push_back({name, shot_.mover, t});
    shot_.sequence.push_back(shot_.mover + " " + name);
    shot_.striker = shot_.mover, shot_.struck = name, shot_.struck_at = t;
    since_ = t;
    return true;
  }

  void addOthers() {
    for (int count = dice_.integer(0, 2), i = 0; i < count; ++i) {
      const Vec3 place = drawPlace(dice_);
      if (isFree(shot_.scene, place)) shot_.scene.bodies.push_back(ball("other_" + std::to_string(i + 1), place));
    }
  }

  /// Everything still happens as it was laid.
  bool holds(const Leg& last) {
    const auto before = shot_.sequence;
    if (last.strikes) {
      shot_.mover = shot_.struck;
      if (!follow(0)) return false;
    } else {
      since_ = laid_.empty() ? 0 : shot_.struck_at;
      shot_.sequence.resize(before.size() - static_cast<std::size_t>(last.rails));
      if (!follow(last.rails)) return false;
    }
    const Scene& scene = shot_.scene;
    return shot_.sequence == before && std::all_of(laid_.begin(), laid_.end(), [&](const Laid& l) {
             const int body = bodyIndex(scene, l.name);
             const auto e = motion_.findImpact(body, 1);
             if (!e) return false;
             const Event& event = motion_.events[static_cast<std::size_t>(*e)];
             return std::abs(event.time - l.time) < 1e-6 && event.meets(body, bodyIndex(scene, l.by));
           });
  }

  const Shot& shot() const { return shot_; }

 private:
  struct Laid {
    std::string name, by;
    double time;
  };

  // The mover, after so many rails and before anything else.
  bool follow(int rails) {
    motion_ = play(shot_.scene);
    const int body = bodyIndex(shot_.scene, shot_.mover);
    shot_.from = since_, shot_.to = motion_.end;
    for (const Event& e : motion_.events) {
      if (!e.find(body) || e.time <= since_ + 1e-6 || !e.counts()) continue;
      const int partner = partnerIn(e, body);
      shot_.to = e.time;
      if (rails == 0) break;
      if (partner < 0 || !isRail(shot_.scene, partner)) return false;
      shot_.sequence.push_back(shot_.mover + " rail*");
      shot_.from = e.time, shot_.to = motion_.end;
      --rails;
    }
    shot_.to = std::min(shot_.to, shot_.from + kLongestLeg);
    return rails == 0 && shot_.to - shot_.from >= kShortestLeg;
  }

  Dice& dice_;
  Shot shot_;
  Motion motion_;
  std::vector<Laid> laid_;
  double since_ = 0;
};

bool fits(const std::string& name, const std::string& pattern) {
  if (pattern.ends_with('*')) return name.starts_with(pattern.substr(0, pattern.size() - 1));
  return name == pattern;
}

}  // namespace

std::optional<Shot> drawShot(const std::vector<Leg>& legs, Dice& dice) {
  Layout layout(dice);
  for (const Leg& leg : legs)
    if (!layout.add(leg)) return std::nullopt;
  layout.addOthers();
  if (!layout.holds(legs.back())) return std::nullopt;
  return layout.shot();
}

Scene drawRack(int layers, Dice& dice) {
  Scene scene;
  scene.gravity.setZero();
  scene.materials = {Material{.name = "resin", .elasticity = dice.in(0.8, 0.98), .friction = 0}};
  Body cue = ball("cue", {dice.in(-0.6, -0.3), dice.in(-0.05, 0.05), 0});
  const double pitch = 2 * kRadius * dice.in(1.02, 1.3), angle = dice.in(-0.1, 0.1), speed = dice.logIn(0.5, 3);
  cue.velocity = speed * Vec3(std::cos(angle), std::sin(angle), 0);
  scene.bodies.push_back(cue);
  for (int i = 0, count = 0; i < layers; ++i) {
    for (int j = 0; j <= i; ++j) {
      const Vec3 place =
          pitch * Vec3(std::sqrt(0.75) * i, j - 0.5 * i, 0) + 0.01 * (pitch - 2 * kRadius) * dice.inCube(1);
      const bool last = i == layers - 1 && j == i;
      scene.bodies.push_back(ball(last ? "corner" : "ball_" + std::to_string(++count), {place.x(), place.y(), 0}));
    }
  }
  return scene;
}

bool beginsWith(const Motion& motion, const std::vector<std::string>& sequence) {
  if (sequence.empty()) return true;
  const auto words = [](const std::string& pair) {
    const std::size_t space = pair.find(' ');
    return std::pair(pair.substr(0, space), pair.substr(space + 1));
  };
  const int body = bodyIndex(*motion.scene, words(sequence[0]).first);
  const auto matters = [&](const Body& partner) {
    return !partner.fixed || std::any_of(sequence.begin(), sequence.end(), [&](const std::string& pair) {
      return fits(partner.name, words(pair).second);
    });
  };
  std::size_t next = 0;
  for (const Event& e : motion.events) {
    if (next == sequence.size()) break;
    if (!e.find(body) || !e.counts()) continue;
    const int partner = partnerIn(e, body);
    if (partner < 0 || !matters(motion.scene->bodies[static_cast<std::size_t>(partner)])) continue;
    if (!fits(motion.scene->bodies[static_cast<std::size_t>(partner)].name, words(sequence[next]).second)) return false;
    ++next;
  }
  return next == sequence.size();
}

}  // namespace carom::bench

// SPDX-License-Identifier: MIT
#include "studio/face_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/wanted.h"
#include "formats/drawing/display.h"
#include "studio/body_edits.h"

namespace carom::studio {
namespace {

/// Cosine of the angle to the vertical from which on a face is up: what rests on a face differs from it by rounding.
constexpr double kUp = 1 - 1e-9;
/// Of the body's width: a place is met. Nails are met within 1e-9 of their scale.
constexpr double kPlaceMet = 1e-10;
/// Shifts of the start until a place is met: each leaves what rounding makes of it on the way.
constexpr int kShifts = 6;
constexpr int kMostTries = 400;
/// Changes of the velocities, of their size: of the second try, their growth from try to try, and the largest.
constexpr double kFirstSpread = 0.01, kSpreadGrowth = 1.03, kLargestSpread = 0.5;
/// Of the body's width from face to face: half the range of heights in which the middle of the face is to be.
constexpr double kHeightRange = 0.02;
/// Iterations of an edit between two that are told.
constexpr int kToldEvery = 10;

/// In -1 to 1, the same on every machine (splitmix64).
class Draws {
 public:
  double next() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
  }
  Vec3 vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::uint64_t state_ = 1;
};

/// The rotations of a cube that map a shape and its mass onto themselves; the first one is none.
std::vector<Quat> symmetriesOf(const Body& body) {
  std::vector<Quat> all = {Quat::Identity()};
  const Box* box = std::get_if<Box>(&body.shape);
  const bool round = std::holds_alternative<Cylinder>(body.shape) || std::holds_alternative<Capsule>(body.shape);
  if ((!box && !round) || body.center_of_mass || body.inertia.source != Inertia::Source::derived) return all;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 turn = Mat3::Zero();
      for (int i = 0; i < 3; ++i) turn(axes[static_cast<std::size_t>(i)], i) = signs & (1 << i) ? -1 : 1;
      const bool same = box ? (turn.cwiseAbs() * box->size - box->size).norm() == 0 : std::abs(turn(2, 2)) == 1;
      if (turn.determinant() > 0 && same) all.push_back(Quat(turn));
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

/// How a body lies in the end.
struct Rest {
  Mat3 turn = Mat3::Identity();  // shape to world
  Vec3 center = Vec3::Zero();    // of mass, m
};

class FaceSearch {
 public:
  FaceSearch(const SessionSnapshot& snapshot, ContactSource& contacts, const FaceUp& wanted, const std::stop_token& stop)
      : snapshot_(snapshot), contacts_(contacts), wanted_(wanted), stop_(stop),
        body_(static_cast<std::size_t>(bodyIndex(snapshot.content.scene, wanted.body))), up_(wanted.up.normalized()),
        now_(motionOf(snapshot.content.scene)), center_((*now_.models)[body_].center) {
    if (bodyOf(snapshot.content.scene).immovable()) throw InputError("'" + wanted.body + "' does not move");
    if (!std::isfinite(up_.norm())) throw InputError("/up", "found no direction, expected one");
    const Vec3 gravity = snapshot.content.scene.gravity;
    if (!(gravity.z() < 0) || gravity.x() != 0 || gravity.y() != 0)
      throw InputError("gravity is not along -z: no face is up");
    const DisplayMesh mesh = displayMesh(snapshot.content.scene, static_cast<int>(body_), 1);
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3)
      corners_.push_back(Vec3(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]) - center_);
  }

  FaceUpFound byTurns(const std::function<void(int)>& tell) {
    FaceUpFound out;
    Draws draws;
    const Body& thrown = bodyOf(snapshot_.content.scene);
    double spread = 0;
    for (; out.tried < kMostTries && !stop_.stop_requested(); ++out.tried) {
      Scene scene = snapshot_.content.scene;
      Body& body = bodyOf(scene);
      const Vec3 a = draws.vector(), b = draws.vector();
      body.velocity += spread * thrown.velocity.norm() * a;
      body.angular_velocity += spread * thrown.angular_velocity.norm() * b;
      if (const std::optional<Rest> rest = broughtAbout(scene)) {
        out.content = contentWith(scene, faceAt(rest->center.z() + reach(up_)));
        return out;
      }
      spread = spread == 0 ? kFirstSpread : std::min(spread * kSpreadGrowth, kLargestSpread);
      tell(out.tried + 1);
    }
    if (!stop_.stop_requested())
      out.message = "No throw was found with which '" + wanted_.body + "' comes to rest with this face up" +
                    (wanted_.place ? " there." : ".");
    return out;
  }

  FaceUpFound byEdit(const std::function<void(int)>& tell) {
    FaceUpFound out;
    const SessionContent& now = snapshot_.content;
    std::vector<Constraint> constraints;
    for (const auto& [id, nail] : now.nails) constraints.push_back(nail);
    const std::optional<Rest> rest = restOf(now_);
    if (!rest) throw InputError("'" + wanted_.body + "' does not come to rest: throw it so that it does, or make the motion longer");
    const double ground = rest->center.z() - reach(-(rest->turn.transpose() * Vec3::UnitZ()));
    constraints.push_back(faceAt(ground + reach(up_) + reach(-up_)));
    EditOptions options;
    options.effort = Effort::fast;
    options.tolerance = snapshot_.tolerance;
    options.certify = options.explain = false;
    options.stop = stop_;
    options.progress = [&](const EditProgress&) {
      if (++out.tried % kToldEvery == 0) tell(out.tried);
      return true;
    };
    const Edit edit(now.scene, contacts_, now.duration, now.controls, constraints);
    const EditResult result = edit.solve(options);
    if (result.solved())
      out.content = contentWith(result.scene, constraints.back());
    else if (!stop_.stop_requested())
      out.message = result.message;
    return out;
  }

 private:
  Body& bodyOf(Scene& scene) const { return scene.bodies[body_]; }
  const Body& bodyOf(const Scene& scene) const { return scene.bodies[body_]; }

  Motion motionOf(const Scene& scene) const {
    SimulateOptions options;
    options.stop = stop_;
    return simulate(scene, contacts_, snapshot_.content.duration, options);
  }

  std::optional<Rest> restOf(const Motion& motion) const {
    const Arc& last = motion.world_lines[body_].arcs.back();
    if (motion.status != MotionStatus::complete || last.kind() != ArcKind::rest) return std::nullopt;
    const Kinematics at = last.kinematicsAt(motion.end);
    return Rest{at.R, at.x};
  }
  bool isUp(const Rest& rest) const { return (rest.turn * up_).z() >= kUp; }

  /// Turns and shifts the start until the face is up at the place; none: it is not with these velocities.
  std::optional<Rest> broughtAbout(Scene& scene) const {
    std::optional<Rest> rest = restOf(motionOf(scene));
    if (!rest) return std::nullopt;
    if (!isUp(*rest)) {
      const std::vector<Quat> all = symmetriesOf(bodyOf(scene));
      const auto turn = std::ranges::find_if(all, [&](const Quat& s) { return (rest->turn * (s * up_)).z() >= kUp; });
      if (turn == all.end()) return std::nullopt;
      bodyOf(scene).orientation = (bodyOf(scene).orientation * *turn).normalized();
      rest = restWithRoom(scene);
    }
    for (int k = 0; rest && isUp(*rest) && !stop_.stop_requested(); ++k) {
      Vec3 off = Vec3::Zero();
      if (wanted_.place) off.head<2>() = *wanted_.place - rest->center.head<2>();
      if (off.norm() <= kPlaceMet * (reach(up_) + reach(-up_))) return rest;
      if (k == kShifts) break;
      bodyOf(scene).position += off;
      rest = restWithRoom(scene);
    }
    return std::nullopt;
  }

  /// m, how far the body reaches from its centre of mass in a direction, of length 1, of its shape's axes.
  double reach(const Vec3& direction) const {
    double most = 0;
    for (const Vec3& corner : corners_) most = std::max(most, corner.dot(direction));
    return most;
  }

  /// The middle of the face at that height when it is at rest, and at the place.
  Constraint faceAt(double height) const {
    const double half = kHeightRange * (reach(up_) + reach(-up_));
    const auto along = [&](int i) { return wanted_.place ? Wanted((*wanted_.place)(i)) : Wanted(any); };
    Target target = targetOf("point", WantedVector{along(0), along(1), within(height - half, height + half)});
    target.body_point = center_ + reach(up_) * up_;
    return {wanted_.body, atRest(), {target}};
  }

  SessionContent contentWith(const Scene& scene, const Constraint& face) const {
    SessionContent content = snapshot_.content;
    content.scene = scene;
    if (wanted_.nail) content.nails.emplace_back(NailId(), face);
    return content;
  }

  /// None also where the start would overlap another body, of which no motion can be simulated.
  std::optional<Rest> restWithRoom(const Scene& scene) const {
    try {
      requireRoom(scene, snapshot_.content.scene);
    } catch (const Overlap&) {
      return std::nullopt;
    }
    return restOf(motionOf(scene));
  }

  const SessionSnapshot& snapshot_;
  ContactSource& contacts_;
  const FaceUp& wanted_;
  const std::stop_token stop_;
  const std::size_t body_;
  const Vec3 up_;
  const Motion now_;
  const Vec3 center_;
  std::vector<Vec3> corners_;  // from the centre of mass, in the axes of the shape
};

}  // namespace

FaceUpFound findFaceUp(const SessionSnapshot& snapshot, ContactSource& contacts, const FaceUp& wanted,
                       const std::function<void(int)>& tell, const std::stop_token& stop) {
  FaceSearch search(snapshot, contacts, wanted, stop);
  const bool varies = std::ranges::any_of(snapshot.content.controls, [&](const Control& c) { return c.body == wanted.body; });
  return varies ? search.byEdit(tell) : search.byTurns(tell);
}
}  // namespace carom::studio

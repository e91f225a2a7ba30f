// SPDX-License-Identifier: MIT
#include "adjoint/derivative/flat_landing.hpp"

#include <algorithm>

#include "adjoint/constrained/constrained_linearization.hpp"
#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/motion/rim_geometry.hpp"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"

namespace carom::adjoint_detail {
namespace {

// The place of a contact is that of the lowest point of its rim to this share of the radius.
constexpr double kSamePoint = 2e-5;
// A rim that tilts more slowly than this share of sqrt(g rho) lies as it lay, m/s.
constexpr double kTiltRate = 2e-9;

constexpr int kRows = 7;  // gap, normal, point

// (gap, normal, point) of the only contact, by all columns.
using Columns = Eigen::Matrix<double, kRows, Eigen::Dynamic>;

Columns columnsOf(ConstrainedRates& rates, int count, double of_pair) {
  Columns rows(kRows, count);
  rates.each([&](const ConstrainedLanes& lanes, int first, int here) {
    for (int lane = 0; lane < here; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      rows.col(first + lane) << lanes.gap[0].rate[i], of_pair * ratesOf(lanes.contacts[0].n, i),
          ratesOf(V3<ConstrainedLanes::Number>(lanes.x + lanes.contacts[0].r), i);
    }
  });
  return rows;
}

// Of the rim of a participant on a body that stands still.
struct RimOfBody {
  ConstrainedScene scene;
  std::vector<PersistentContact> contact;
  double radius;
  Vec3 normal;  // of the face, in the axes of its body
};
std::optional<RimOfBody> rimOfBody(const Motion& motion, const Event& event, const Contact& c) {
  const auto rim = rimOf(motion, c);
  if (!rim) return std::nullopt;
  RimOfBody out;
  PersistentContact held;
  held.is_first = rim->of_first, held.features = rim->features;
  out.scene.body = held.is_first ? c.a : c.b, held.with = held.is_first ? c.b : c.a;
  const BodyModel& model = (*motion.models)[static_cast<std::size_t>(out.scene.body)];
  if (!model.moving || model.kinematic || participantOf(event, out.scene.body) < 0 || participantOf(event, held.with) >= 0) return std::nullopt;
  out.scene.geometry = motion.geometry;
  out.scene.model = motion.modelOf(out.scene.body);
  out.scene.with = {{.pose = poseBefore(motion, event, held.with)}};
  out.contact = {held};
  out.scene.gravity = model.gravity_factor * motion.scene->gravity;
  out.radius = rim->radius, out.normal = rim->normal;
  return out;
}

// Whether marks of the same rim hold the body from the event on: it lies flat there, and any point of the rim stands for it as well.
bool staysFlat(const Motion& motion, const Event& event, const Contact& of, const FeaturePair& rim) {
  return std::ranges::any_of(event.contacts, [&](const Contact& c) {
    if (!c.lasts || c.a != of.a || c.b != of.b) return false;
    const auto same = rimOf(motion, c);
    return same && same->features == rim && !(c.features == rim);
  });
}

bool tilts(const RimOfBody& of, const State& before) {
  const Vec3 omega = of.scene.model->inverseInertiaWorld(before.q.toRotationMatrix()) * before.L, N = of.scene.with[0].pose.R * of.normal;
  return (omega - N.dot(omega) * N).norm() * of.radius > kTiltRate * std::sqrt(of.scene.gravity.norm() * of.radius);
}

// The state whose lowest point is where the contact is: the body as it was, or as if it turned the other way.
std::optional<State> turnsTo(const RimOfBody& of, const State& before, const Pose& own, const Vec3& point) {
  State turns = before;
  for (const double sign : {1.0, -1.0}) {
    turns.L = sign * before.L;
    const Vec3 omega = of.scene.model->inverseInertiaWorld(turns.q.toRotationMatrix()) * turns.L;
    const Vec3 lowest = of.scene.contact(of.contact[0], 0, own, {turns.v, omega}, 0).at.point;
    if ((point - lowest).norm() <= kSamePoint * of.radius) return turns;
  }
  return std::nullopt;
}

}  // namespace

// A mark that is where the rim comes down counts as that point: with another turn of the body about its axis it would not be there.
bool placeFlatRim(const Motion& motion, const Event& event, const Contact& c, ContactPart<double>& part) {
  const std::optional<RimOfBody> of = rimOfBody(motion, event, c);
  if (!of) return false;
  Contact rim_contact = c;
  rim_contact.features = of->contact[0].features;
  if (!rimLiesFlat(motion, rim_contact, poseBefore(motion, event, c.a), poseBefore(motion, event, c.b))) return false;
  if (staysFlat(motion, event, c, rim_contact.features)) return false;
  const int p = participantOf(event, of->scene.body);
  const State& before = event.participants[static_cast<std::size_t>(p)].before;
  if (!tilts(*of, before)) return false;
  const bool is_first = of->contact[0].is_first;
  const std::optional<State> turns = turnsTo(*of, before, shapePose(motion, of->scene.body, before), c.at.point);
  if (!turns) return false;
  const auto columns = std::make_shared<const ConstrainedColumns>(motion, of->scene, of->contact, before);
  ConstrainedRates rates(of->scene, of->contact, columns->inputs(), *turns, 0, {Vec3::Zero()}, true);
  auto rows = std::make_shared<Columns>(columnsOf(rates, columns->inputs().count, is_first ? 1 : -1));
  if (turns->L != before.L) rows->middleCols<3>(9) *= -1;
  auto rim = std::make_shared<RimPart>();
  rim->participant = static_cast<std::size_t>(p);
  rim->tangent = [columns, rows](const StateDerivative& d, const SceneTangent& dscene, const BodyModelDerivative& dmodel) {
    return Eigen::Matrix<double, kRows, 1>(*rows * columns->tangent(d, dscene, dmodel));
  };
  rim->pullback = [columns, rows](const Eigen::Matrix<double, kRows, 1>& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) {
    return columns->pullback(rows->transpose() * bar, scene_bar, model_bar);
  };
  part.rim = std::move(rim);
  part.pose.setZero();
  part.pose.middleCols<6>(is_first ? 0 : 6) = rows->leftCols<6>();
  part.pose.middleCols<6>(is_first ? 6 : 0) = rows->middleCols(columns->inputs().partners[0].pose, 6);
  return true;
}

void keepPlaceOnRim(const Motion& motion, const Event& event, const Contact& c, ContactPart<double>& part) {
  const auto rim = rimOf(motion, c);
  if (!rim || !(c.features == rim->features) || !staysFlat(motion, event, c, rim->features)) return;
  const int body = rim->of_first ? c.a : c.b, own = rim->of_first ? 0 : 6;
  part.pose.bottomRows<3>().setZero();
  part.pose.block<3, 3>(4, own).setIdentity();
  part.pose.block<3, 3>(4, own + 3) = -skew(Vec3(c.at.point - poseBefore(motion, event, body).x));
}

// Marks of the rim, and where it crosses edges: whatever it stands on flat, but for itself.
void closeMarks(const Motion& motion, const Event& event, std::vector<ContactPart<double>>& parts) {
  const auto* rims = dynamic_cast<const RimGeometry*>(motion.geometry.get());
  const auto isRim = [&](int a, int b, const FeaturePair& f) {
    const auto on_face = rims->rimOnFace(a, b, f);
    return on_face && on_face->features == f;
  };
  for (const Participant& p : event.participants) {
    const ConstrainedPath* path = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())].trajectory().constrained();
    if (!path || !path->beginsFlat()) continue;
    for (const PersistentContact& held : path->contacts()) {
      const int a = held.is_first ? p.body : held.with, b = held.is_first ? held.with : p.body;
      if (!isRim(a, b, held.features)) continue;
      const std::optional<int> rim = rims->rimOfBody(a, b, held.features, held.is_first);
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const Contact& c = event.contacts[k];
        if (c.a != p.body && c.b != p.body) continue;
        if (rims->rimOfBody(c.a, c.b, c.features, c.a == p.body) != rim) continue;
        parts[k].closes = !isRim(c.a, c.b, c.features);
      }
    }
  }
}

}  // namespace carom::adjoint_detail

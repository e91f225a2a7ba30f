// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps.hpp"

#include <algorithm>
#include <array>

#include "adjoint/base/arguments.hpp"
#include "ode_bridge/gaps/rows.hpp"

namespace carom::ode_bridge_detail {

using namespace adjoint_detail;

namespace {

using namespace gaps;

struct GapRow {
  Family a, b;
  bool swapped;  // the gap's first feature is body b's
  int branches;
  ContactPoint (*contact)(const WorldFeature&, const WorldFeature&, int sign);
  FeatureJacobian (*jacobian)(const WorldFeature&, const WorldFeature&, int sign);
  JacobianOf<Rate4> (*jacobian_rates)(const FeatureOf<Rate4>&, const FeatureOf<Rate4>&, int sign);
};

// In the order of GapKind.
constexpr std::array<GapRow, kGapKinds> kGaps{{
    {Family::vertex, Family::face, false, 1, pointPlane, pointPlaneJacobian<double>, pointPlaneJacobian<Rate4>},
    {Family::face, Family::vertex, true, 1, pointPlane, pointPlaneJacobian<double>, pointPlaneJacobian<Rate4>},
    {Family::vertex, Family::vertex, false, 1, pointPoint, pointPointJacobian<double>, pointPointJacobian<Rate4>},
    {Family::vertex, Family::edge, false, 1, pointEdge, pointEdgeJacobian<double>, pointEdgeJacobian<Rate4>},
    {Family::edge, Family::vertex, true, 1, pointEdge, pointEdgeJacobian<double>, pointEdgeJacobian<Rate4>},
    {Family::edge, Family::edge, false, 1, edgeEdge, edgeEdgeJacobian<double>, edgeEdgeJacobian<Rate4>},
    {Family::rim, Family::face, false, 1, rimPlane, rimPlaneJacobian<double>, rimPlaneJacobian<Rate4>},
    {Family::face, Family::rim, true, 1, rimPlane, rimPlaneJacobian<double>, rimPlaneJacobian<Rate4>},
    {Family::rim, Family::vertex, false, 1, rimPoint, rimPointJacobian<double>, rimPointJacobian<Rate4>},
    {Family::vertex, Family::rim, true, 1, rimPoint, rimPointJacobian<double>, rimPointJacobian<Rate4>},
    {Family::rim, Family::edge, false, 2, rimEdge, rimEdgeJacobian<double>, rimEdgeJacobian<Rate4>},
    {Family::edge, Family::rim, true, 2, rimEdge, rimEdgeJacobian<double>, rimEdgeJacobian<Rate4>},
    {Family::rim, Family::rim, false, 2, rimRim, rimRimJacobian<double>, rimRimJacobian<Rate4>},
}};

constexpr std::size_t at(Family f) { return static_cast<std::size_t>(f); }

// Row of kGaps by the two families, -1 for none.
constexpr std::array<std::array<std::int16_t, 4>, 4> kKinds = [] {
  std::array<std::array<std::int16_t, 4>, 4> kinds{};
  for (auto& of_a : kinds) of_a.fill(-1);
  for (std::size_t i = 0; i < kGaps.size(); ++i) kinds[at(kGaps[i].a)][at(kGaps[i].b)] = static_cast<std::int16_t>(i);
  return kinds;
}();

const GapRow& rowOf(std::int16_t kind) { return kGaps[static_cast<std::size_t>(kind)]; }

// What a frozen pair of features stands for, once it is known to stand for something.
struct FoundPair {
  const GapRow& row;
  const Solid &of_a, &of_b;
  const Feature &a, &b;
};

const Feature& featureOf(const Solid& solid, Family family, int index) {
  checkedIndex("a feature pair", "feature", index, solid.count(family));
  return solid.feature(family, index);
}

FoundPair found(const std::vector<Solid>& solids, int a, int b, const FeaturePair& f) {
  const GapRow& row = kGaps[checkedIndex("a feature pair", "kind", f.kind, kGaps.size())];
  const Solid& of_a = solids[checkedIndex("a feature pair", "body", a, solids.size())];
  const Solid& of_b = solids[checkedIndex("a feature pair", "body", b, solids.size())];
  return {row, of_a, of_b, featureOf(of_a, row.a, f.a), featureOf(of_b, row.b, f.b)};
}

// A feature about its body's centre in world axes, and how it changes with the dimensions.
template <class S>
struct Turned {
  V3<S> arm, direction;
  Eigen::Matrix<S, 3, Eigen::Dynamic> point_rates;
  Eigen::RowVectorXd radius_rates, rim_rates, apex_rates;  // the last one empty unless the feature is tapered
};

// d(feature in the world) by (x, theta) and by the dimensions, folded into the columns of one side.
template <class S>
void fold(const JacobianOf<S>& J, int column, const Turned<S>& f, Eigen::Ref<Eigen::Matrix<S, 7, 6>> by_pose,
          Eigen::Matrix<S, 7, Eigen::Dynamic>& by_size) {
  const auto JP = J.template middleCols<3>(column), JD = J.template middleCols<3>(column + 3);
  by_pose.template leftCols<3>() = JP;
  by_pose.template rightCols<3>() = -JP * skew(f.arm) - JD * skew(f.direction);
  by_size.resize(7, f.point_rates.cols());
  for (Eigen::Index c = 0; c < by_size.cols(); ++c) {  // most shapes have one dimension or three, a plane has none
    by_size.col(c) = JP * V3<S>(f.point_rates.col(c)) + J.col(column + 6) * S(f.radius_rates[c]) +
                     J.col(column + 7) * S(f.rim_rates[c]);
    if (f.apex_rates.size() > 0) by_size.col(c) += J.col(column + 8) * S(f.apex_rates[c]);
  }
}

Turned<double> turnedFeature(const Solid& solid, const Feature& f, const Pose& pose) {
  FeatureRates rates = ratesOf(solid, f);
  for (Eigen::Index c = 0; c < rates.point.cols(); ++c) rates.point.col(c) = pose.R * Vec3(rates.point.col(c));
  return {pose.R * f.point,        pose.R * f.direction, std::move(rates.point),
          std::move(rates.radius), std::move(rates.rim), std::move(rates.apex)};
}

// Up to four directions, of one of the two bodies.
struct SideRates {
  std::span<const PairTangent> directions;
  int first;  // of (x, theta) in PairTangent::pose
  Eigen::VectorXd PairTangent::*size;
};

struct PlacedRates {
  FeatureOf<Rate4> feature;
  Turned<Rate4> turned;
};

PlacedRates place(const Solid& solid, const Feature& f, const Pose& pose, const SideRates& side) {
  const WorldFeature at = placeFeature(f, pose);
  const Turned<double> turned = turnedFeature(solid, f, pose);
  PlacedRates out;
  out.feature = {at.point.cast<Rate4>(), at.direction.cast<Rate4>(), at.radius, at.rim, at.apex};
  out.turned = {turned.arm.cast<Rate4>(), turned.direction.cast<Rate4>(), turned.point_rates.cast<Rate4>(),
                turned.radius_rates, turned.rim_rates, turned.apex_rates};
  for (std::size_t i = 0; i < side.directions.size(); ++i) {
    const Vec3 dx = side.directions[i].pose.segment<3>(side.first);
    const Vec3 theta = side.directions[i].pose.segment<3>(side.first + 3);
    const Eigen::VectorXd& size = side.directions[i].*side.size;
    Vec3 darm = theta.cross(turned.arm);
    if (size.size() > 0) {
      darm += turned.point_rates * size;
      out.feature.radius.rate[i] = turned.radius_rates.dot(size);
      out.feature.rim.rate[i] = turned.rim_rates.dot(size);
      if (turned.apex_rates.size() > 0) out.feature.apex.rate[i] = turned.apex_rates.dot(size);
    }
    const Vec3 ddirection = theta.cross(turned.direction);
    setRates(out.feature.point, Vec3(dx + darm), i);
    setRates(out.feature.direction, ddirection, i);
    setRates(out.turned.arm, darm, i);
    setRates(out.turned.direction, ddirection, i);
    Eigen::Matrix3Xd rates = skew(theta) * turned.point_rates;
    const Eigen::Matrix3Xd uneven = pointRatesRate(solid, size);
    if (uneven.cols() > 0) rates += pose.R * uneven;
    setRates(out.turned.point_rates, rates, i);
  }
  return out;
}

}  // namespace

bool hasKind(Family a, Family b) { return kKinds[at(a)][at(b)] >= 0; }
GapKind gapKind(Family a, Family b) { return static_cast<GapKind>(kKinds[at(a)][at(b)]); }
Family familyOfFirst(GapKind kind) { return rowOf(kind).a; }
Family familyOfSecond(GapKind kind) { return rowOf(kind).b; }
int branches(GapKind kind) { return rowOf(kind).branches; }

ContactPoint contactOf(GapKind kind, const WorldFeature& of_a, const WorldFeature& of_b, int sign) {
  const GapRow& row = rowOf(kind);
  if (!row.swapped) return row.contact(of_a, of_b, sign);
  ContactPoint c = row.contact(of_b, of_a, sign);
  c.normal = -c.normal;
  return c;
}

ContactPoint FeatureGeometry::contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const {
  const FoundPair pair = found(solids_, a, b, f);
  return contactOf(static_cast<GapKind>(f.kind), placeFeature(pair.a, A), placeFeature(pair.b, B), f.sign);
}

std::optional<int> FeatureGeometry::rimOfBody(int a, int b, const FeaturePair& f, bool of_first) const {
  const FoundPair pair = found(solids_, a, b, f);
  const Feature& own = of_first ? pair.a : pair.b;
  if ((of_first ? pair.row.a : pair.row.b) == Family::rim) return of_first ? f.a : f.b;
  if (!own.mark) return std::nullopt;
  const std::vector<Feature>& rims = (of_first ? pair.of_a : pair.of_b).rims;
  const auto rim = std::ranges::find_if(rims, [&](const Feature& r) {
    return r.part == own.part && std::abs((own.point - r.point).norm() - r.rim) <= 1e-9 * r.rim;
  });
  if (rim == rims.end()) return std::nullopt;
  return static_cast<int>(rim - rims.begin());
}

std::optional<RimOnFace> FeatureGeometry::rimOnFace(int a, int b, const FeaturePair& f) const {
  const FoundPair pair = found(solids_, a, b, f);
  const bool of_first = pair.row.b == Family::face;
  if (!of_first && pair.row.a != Family::face) return std::nullopt;
  const std::optional<int> own = rimOfBody(a, b, f, of_first);
  if (!own) return std::nullopt;
  const Feature& rim = (of_first ? pair.of_a : pair.of_b).rims[static_cast<std::size_t>(*own)];
  const Feature& face = of_first ? pair.b : pair.a;
  const auto index = static_cast<std::int32_t>(*own);
  const Vec3 normal = f.sign < 0 ? Vec3(-face.direction) : face.direction;
  return RimOnFace{of_first, rim.point, rim.direction, rim.rim, normal,
                   {static_cast<std::int16_t>(of_first ? kRimPlane : kPlaneRim), of_first ? index : f.a, of_first ? f.b : index, f.sign}};
}

namespace {

// A tilt of this sine is rounding: axes are known to some 1e-16.
constexpr double kNoTilt = 1e-14;

// Of a rim and a face: with x = d x N, t = x/|x| and u = d x t the point is C + rho u, and t' = (x' - t t.x')/|x|. Where it
// lies flat and tilts about an axis that stays, t = x'/|x'| and t' = 0.
ContactMotion rimMotion(const WorldFeature& rim, const Vec3& N, const Vec3& on_face, const PoseRate& of_rim, const PoseRate& of_face,
                        const Vec3& rim_arm, const Vec3& face_arm) {
  const Vec3 N_rate = of_face.w.cross(N), d_rate = of_rim.w.cross(rim.direction);
  const Vec3 x = rim.direction.cross(N), x_rate = d_rate.cross(N) + rim.direction.cross(N_rate);
  const double sine = x.norm();
  const bool flat = sine <= kNoTilt;
  const Vec3 t = flat ? Vec3(x_rate / x_rate.norm()) : Vec3(x / sine);
  const Vec3 t_rate = flat ? Vec3(Vec3::Zero()) : Vec3((x_rate - t.dot(x_rate) * t) / sine);
  const Vec3 u = rim.direction.cross(t), u_rate = d_rate.cross(t) + rim.direction.cross(t_rate);
  const Vec3 moves = of_rim.v + of_rim.w.cross(rim_arm), apart = rim.point - on_face;
  return {{N.dot(apart) - rim.rim * sine, N, rim.point + rim.rim * u},
          N.dot(moves - of_face.v - of_face.w.cross(face_arm)) + N_rate.dot(apart) - rim.rim * t.dot(x_rate),
          N_rate,
          moves + rim.rim * u_rate};
}

}  // namespace

// Of a vertex or a rim and a face, which is most of what lasts, written out.
ContactMotion FeatureGeometry::motion(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                      const PoseRate& of_a, const PoseRate& of_b) const {
  const bool is_rim = f.kind == kRimPlane || f.kind == kPlaneRim;
  if (f.kind != kPointPlane && f.kind != kPlanePoint && !is_rim) return ContactGeometry::motion(a, b, f, A, B, of_a, of_b);
  const FoundPair pair = found(solids_, a, b, f);
  const bool swapped = f.kind == kPlanePoint || f.kind == kPlaneRim;
  const Feature &point = swapped ? pair.b : pair.a, &face = swapped ? pair.a : pair.b;
  const Pose &P = swapped ? B : A, &Q = swapped ? A : B;
  const PoseRate &of_point = swapped ? of_b : of_a, &of_face = swapped ? of_a : of_b;
  const Vec3 arm = P.R * point.point, arm_face = Q.R * face.point;
  const Vec3 N = (f.sign < 0 ? -1.0 : 1.0) * (Q.R * face.direction), N_rate = of_face.w.cross(N);
  if (is_rim) {
    ContactMotion m = rimMotion(placeFeature(point, P), N, Q.x + arm_face, of_point, of_face, arm, arm_face);
    if (swapped) m.at.normal = -m.at.normal, m.normal_rate = -m.normal_rate;
    return m;
  }
  const Vec3 apart = P.x + arm - Q.x - arm_face, moves = of_point.v + of_point.w.cross(arm);
  const double side = swapped ? -1 : 1;
  return {{N.dot(apart) - point.radius, side * N, P.x + arm - point.radius * N},
          N.dot(moves - of_face.v - of_face.w.cross(arm_face)) + N_rate.dot(apart),
          side * N_rate,
          moves - point.radius * N_rate};
}

ContactJacobian FeatureGeometry::jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const {
  const auto& [row, of_a, of_b, fa, fb] = found(solids_, a, b, f);
  const WorldFeature wa = placeFeature(fa, A), wb = placeFeature(fb, B);
  FeatureJacobian J = row.swapped ? row.jacobian(wb, wa, f.sign) : row.jacobian(wa, wb, f.sign);
  if (row.swapped) J.middleRows<3>(1) *= -1;
  ContactJacobian out;
  fold<double>(J, row.swapped ? kP2 : kP1, turnedFeature(of_a, fa, A), out.pose.leftCols<6>(), out.size_a);
  fold<double>(J, row.swapped ? kP1 : kP2, turnedFeature(of_b, fb, B), out.pose.rightCols<6>(), out.size_b);
  return out;
}

std::vector<ContactJacobian> FeatureGeometry::jacobianRates(int a, int b, const FeaturePair& f, const Pose& A,
                                                            const Pose& B,
                                                            std::span<const PairTangent> directions) const {
  const auto& [row, of_a, of_b, fa, fb] = found(solids_, a, b, f);
  for (const PairTangent& d : directions) {
    checkEntries("jacobianRates", "a rate of a pose of", d.pose);
    for (const auto& [size, solid] : {std::pair{&d.size_a, &of_a}, std::pair{&d.size_b, &of_b}})
      if (size->size() > 0)
        checkCount("jacobianRates", "rates of dimensions", static_cast<std::size_t>(size->size()),
                   static_cast<std::size_t>(solid->center_rates.cols()));
  }
  std::vector<ContactJacobian> out(directions.size());
  constexpr std::size_t kLanes = Rate4::kDirections;
  for (std::size_t first = 0; first < directions.size(); first += kLanes) {
    const auto lanes = directions.subspan(first, std::min(kLanes, directions.size() - first));
    const PlacedRates pa = place(of_a, fa, A, {lanes, 0, &PairTangent::size_a});
    const PlacedRates pb = place(of_b, fb, B, {lanes, 6, &PairTangent::size_b});
    JacobianOf<Rate4> J = row.swapped ? row.jacobian_rates(pb.feature, pa.feature, f.sign)
                                      : row.jacobian_rates(pa.feature, pb.feature, f.sign);
    if (row.swapped) J.middleRows<3>(1) *= Rate4(-1);
    Eigen::Matrix<Rate4, 7, 12> pose;
    Eigen::Matrix<Rate4, 7, Eigen::Dynamic> size_a, size_b;
    fold<Rate4>(J, row.swapped ? kP2 : kP1, pa.turned, pose.leftCols<6>(), size_a);
    fold<Rate4>(J, row.swapped ? kP1 : kP2, pb.turned, pose.rightCols<6>(), size_b);
    for (std::size_t i = 0; i < lanes.size(); ++i)
      out[first + i] = {ratesOf(pose, i), ratesOf(size_a, i), ratesOf(size_b, i)};
  }
  return out;
}

std::string FeatureGeometry::describe(int a, int b, const FeaturePair& f) const {
  const FoundPair pair = found(solids_, a, b, f);
  return nameOf(pair.of_a, pair.row.a, f.a) + " on " + nameOf(pair.of_b, pair.row.b, f.b);
}

void FeatureGeometry::checkFeatures(int a, int b, const FeaturePair& f) const { found(solids_, a, b, f); }

}  // namespace carom::ode_bridge_detail

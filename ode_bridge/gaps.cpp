#include "ode_bridge/gaps.h"

#include <array>

#include "ode_bridge/gaps/rows.h"

namespace carom {
namespace {

using namespace gaps;

struct GapRow {
  Family a, b;
  bool swapped;  // the gap's first feature is body b's
  int branches;
  ContactPoint (*contact)(const WorldFeature&, const WorldFeature&, int sign);
  FeatureJacobian (*jacobian)(const WorldFeature&, const WorldFeature&, int sign);
};

// In the order of GapKind.
constexpr std::array<GapRow, kGapKinds> kGaps{{
    {Family::vertex, Family::face, false, 1, pointPlane, pointPlaneJacobian},
    {Family::face, Family::vertex, true, 1, pointPlane, pointPlaneJacobian},
    {Family::vertex, Family::vertex, false, 1, pointPoint, pointPointJacobian},
    {Family::vertex, Family::edge, false, 1, pointEdge, pointEdgeJacobian},
    {Family::edge, Family::vertex, true, 1, pointEdge, pointEdgeJacobian},
    {Family::edge, Family::edge, false, 1, edgeEdge, edgeEdgeJacobian},
    {Family::rim, Family::face, false, 1, rimPlane, rimPlaneJacobian},
    {Family::face, Family::rim, true, 1, rimPlane, rimPlaneJacobian},
    {Family::rim, Family::vertex, false, 1, rimPoint, rimPointJacobian},
    {Family::vertex, Family::rim, true, 1, rimPoint, rimPointJacobian},
    {Family::rim, Family::edge, false, 2, rimEdge, rimEdgeJacobian},
    {Family::edge, Family::rim, true, 2, rimEdge, rimEdgeJacobian},
    {Family::rim, Family::rim, false, 2, rimRim, rimRimJacobian},
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

// d(feature in the world) by (x, theta) and by the dimensions, folded into the columns of one side.
void fold(const FeatureJacobian& J, int column, const Solid& solid, const Feature& f, const Pose& pose,
          Eigen::Ref<Eigen::Matrix<double, 7, 6>> by_pose, Eigen::Matrix<double, 7, Eigen::Dynamic>& by_size) {
  const auto JP = J.middleCols<3>(column), JD = J.middleCols<3>(column + 3);
  by_pose.leftCols<3>() = JP;
  by_pose.rightCols<3>() = -JP * skew(pose.R * f.point) - JD * skew(pose.R * f.direction);
  const FeatureRates rates = ratesOf(solid, f);
  by_size = JP * (pose.R * rates.point) + J.col(column + 6) * rates.radius + J.col(column + 7) * rates.rim;
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
  const GapRow& row = rowOf(f.kind);
  return contactOf(static_cast<GapKind>(f.kind), placeFeature(solid(a).feature(row.a, f.a), A),
                   placeFeature(solid(b).feature(row.b, f.b), B), f.sign);
}

ContactJacobian FeatureGeometry::jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const {
  const GapRow& row = rowOf(f.kind);
  const Feature &fa = solid(a).feature(row.a, f.a), &fb = solid(b).feature(row.b, f.b);
  const WorldFeature wa = placeFeature(fa, A), wb = placeFeature(fb, B);
  FeatureJacobian J = row.swapped ? row.jacobian(wb, wa, f.sign) : row.jacobian(wa, wb, f.sign);
  if (row.swapped) J.middleRows<3>(1) *= -1;
  ContactJacobian out;
  fold(J, row.swapped ? kP2 : kP1, solid(a), fa, A, out.pose.leftCols<6>(), out.size_a);
  fold(J, row.swapped ? kP1 : kP2, solid(b), fb, B, out.pose.rightCols<6>(), out.size_b);
  return out;
}

std::string FeatureGeometry::describe(int a, int b, const FeaturePair& f) const {
  const GapRow& row = rowOf(f.kind);
  return nameOf(solid(a), row.a, f.a) + " on " + nameOf(solid(b), row.b, f.b);
}

}  // namespace carom

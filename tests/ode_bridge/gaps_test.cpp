// SPDX-License-Identifier: MIT
// The smooth gaps between frozen features: Jacobians against central differences, and what every gap must keep.

#include <gtest/gtest.h>

#include <stdexcept>

#include "adjoint/numeric/so3.hpp"
#include "ode_bridge/gaps.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

using namespace test;

enum class Kind { ball, box, plane, capsule, cylinder, cone };

struct GapRow {
  const char* name;
  Kind a, b;
  GapKind kind;
  const char *of_a, *of_b;  ///< names of the features
  std::int16_t sign = 1;
  std::int16_t swapped_sign = 1;  ///< of the same gap with the bodies in the other order
  bool flat = false;              ///< a lies on b
};

const GapRow kRows[] = {
    {"ball on plane", Kind::ball, Kind::plane, kPointPlane, "ball", "plane"},
    {"vertex on plane", Kind::box, Kind::plane, kPointPlane, "vertex +x-y+z", "plane"},
    {"vertex on face", Kind::box, Kind::box, kPointPlane, "vertex +x+y-z", "face -z"},
    {"vertex on back of face", Kind::box, Kind::box, kPointPlane, "vertex +x+y-z", "face -z", -1, -1},
    {"ball on face", Kind::ball, Kind::box, kPointPlane, "ball", "face +y"},
    {"ball on cap", Kind::ball, Kind::cylinder, kPointPlane, "ball", "cap -z"},
    {"end on plane", Kind::capsule, Kind::plane, kPointPlane, "end -z", "plane"},
    {"ball on ball", Kind::ball, Kind::ball, kPointPoint, "ball", "ball"},
    {"ball on vertex", Kind::ball, Kind::box, kPointPoint, "ball", "vertex -x+y+z"},
    {"end on ball", Kind::capsule, Kind::ball, kPointPoint, "end +z", "ball"},
    {"ball on edge", Kind::ball, Kind::box, kPointEdge, "ball", "edge +y-z"},
    {"ball on another edge", Kind::ball, Kind::box, kPointEdge, "ball", "edge -z+x"},
    {"ball on side of capsule", Kind::ball, Kind::capsule, kPointEdge, "ball", "side"},
    {"end on side", Kind::capsule, Kind::cylinder, kPointEdge, "end +z", "side"},
    {"vertex on side", Kind::box, Kind::cylinder, kPointEdge, "vertex +x-y+z", "side"},
    {"edge on edge", Kind::box, Kind::box, kEdgeEdge, "edge -y-z", "edge +x+y"},
    {"edge on edge, other side", Kind::box, Kind::box, kEdgeEdge, "edge +z-x", "edge -y+z", -1, -1},
    {"side on edge", Kind::capsule, Kind::box, kEdgeEdge, "side", "edge +x+y"},
    {"side on side", Kind::cylinder, Kind::capsule, kEdgeEdge, "side", "side", -1, -1},
    {"rim on plane", Kind::cylinder, Kind::plane, kRimPlane, "rim -z", "plane"},
    {"rim on face", Kind::cylinder, Kind::box, kRimPlane, "rim +z", "face +x"},
    {"rim on back of cap", Kind::cylinder, Kind::cylinder, kRimPlane, "rim +z", "cap -z", -1, -1},
    {"rim on ball", Kind::cylinder, Kind::ball, kRimPoint, "rim -z", "ball"},
    {"rim on end", Kind::cylinder, Kind::capsule, kRimPoint, "rim +z", "end +z"},
    {"rim on edge", Kind::cylinder, Kind::box, kRimEdge, "rim +z", "edge +x+y", 1, 1},
    {"rim on edge, other side", Kind::cylinder, Kind::box, kRimEdge, "rim -z", "edge +y-z", -1, -1},
    {"rim on edge, second place", Kind::cylinder, Kind::box, kRimEdge, "rim -z", "edge +y-z", 2, 2},
    {"rim on edge, second place, other side", Kind::cylinder, Kind::box, kRimEdge, "rim +z", "edge -z+x", -2, -2},
    {"rim on side of capsule", Kind::cylinder, Kind::capsule, kRimEdge, "rim +z", "side", 1, 1},
    {"rim on side of cylinder", Kind::cylinder, Kind::cylinder, kRimEdge, "rim -z", "side", 2, 2},
    {"rim on rim", Kind::cylinder, Kind::cylinder, kRimRim, "rim +z", "rim +z", 1, 2},
    {"rim on rim, other side", Kind::cylinder, Kind::cylinder, kRimRim, "rim -z", "rim +z", -1, -2},
    {"rim on rim, second place", Kind::cylinder, Kind::cylinder, kRimRim, "rim +z", "rim -z", 2, 1},
    {"rim on rim that it lies on", Kind::cylinder, Kind::cylinder, kRimRim, "rim +z", "rim +z", 1, 1, true},
    {"rim on rim that it lies on, second place", Kind::cylinder, Kind::cylinder, kRimRim, "rim -z", "rim +z", 2, 2, true},
    {"rim on edge that it lies on", Kind::cylinder, Kind::box, kRimEdge, "rim -z", "edge +z+x", 1, 1, true},
    {"rim on edge that it lies on, second place", Kind::cylinder, Kind::box, kRimEdge, "rim +z", "edge +y+z", 2, 2, true},
    {"rim on rim, second place, other side", Kind::cylinder, Kind::cylinder, kRimRim, "rim -z", "rim -z", -2, -1},
    {"ball on side of cone", Kind::ball, Kind::cone, kPointEdge, "ball", "side"},
    {"vertex on side of cone", Kind::box, Kind::cone, kPointEdge, "vertex +x-y+z", "side"},
    {"apex on plane", Kind::cone, Kind::plane, kPointPlane, "apex", "plane"},
    {"apex on face", Kind::cone, Kind::box, kPointPlane, "apex", "face +y"},
    {"apex on ball", Kind::cone, Kind::ball, kPointPoint, "apex", "ball"},
    {"apex on side of cylinder", Kind::cone, Kind::cylinder, kPointEdge, "apex", "side"},
    {"apex on side of cone", Kind::cone, Kind::cone, kPointEdge, "apex", "side"},
    {"end on base", Kind::capsule, Kind::cone, kPointPlane, "end -z", "base"},
    {"side of cone on edge", Kind::cone, Kind::box, kEdgeEdge, "side", "edge +x+y"},
    {"side of cone on edge, other side", Kind::cone, Kind::box, kEdgeEdge, "side", "edge +y-z", -1, -1},
    {"side of cone on side of capsule", Kind::cone, Kind::capsule, kEdgeEdge, "side", "side"},
    {"side of cylinder on side of cone", Kind::cylinder, Kind::cone, kEdgeEdge, "side", "side", -1, -1},
    {"side of cone on side of cone", Kind::cone, Kind::cone, kEdgeEdge, "side", "side"},
    {"rim of cone on plane", Kind::cone, Kind::plane, kRimPlane, "rim", "plane"},
    {"rim of cone on ball", Kind::cone, Kind::ball, kRimPoint, "rim", "ball"},
    {"rim of cone on edge", Kind::cone, Kind::box, kRimEdge, "rim", "edge +x+y", 1, 1},
    {"rim of cone on rim of cylinder", Kind::cone, Kind::cylinder, kRimRim, "rim", "rim +z", 1, 2},
    {"rim on side of cone", Kind::cylinder, Kind::cone, kRimEdge, "rim +z", "side", 1, 1},
    {"rim on side of cone, second place", Kind::cylinder, Kind::cone, kRimEdge, "rim -z", "side", 2, 2},
    {"rim of cone on side of cone", Kind::cone, Kind::cone, kRimEdge, "rim", "side", 1, 1},
};

Body bodyOf(Kind kind, const Vec3& size) {
  switch (kind) {
    case Kind::ball:
      return makeBall("", size.x(), Vec3::Zero());
    case Kind::box:
      return makeBox("", size, Vec3::Zero());
    case Kind::plane:
      return makePlane("", Vec3(0.6, 0, 0.8), 0.3);
    case Kind::capsule:
    case Kind::cylinder:
    case Kind::cone:
      break;
  }
  Body body = makeBall("", 1, Vec3::Zero());
  if (kind == Kind::capsule) body.shape = Capsule{size.x(), size.y()};
  if (kind == Kind::cylinder) body.shape = Cylinder{size.x(), size.y()};
  if (kind == Kind::cone) body.shape = Cone{size.x(), size.y()};
  return body;
}

int indexOf(const Solid& solid, Family family, const std::string& name) {
  const std::size_t counts[] = {solid.vertices.size(), solid.edges.size(), solid.faces.size(), solid.rims.size()};
  for (int i = 0; i < static_cast<int>(counts[static_cast<std::size_t>(family)]); ++i)
    if (nameOf(solid, family, i) == name) return i;
  throw std::runtime_error("no feature is called " + name);
}

FeaturePair pairOf(const FeatureGeometry& g, GapKind kind, const char* of_a, const char* of_b, std::int16_t sign) {
  return {kind, indexOf(g.solid(0), familyOfFirst(kind), of_a), indexOf(g.solid(1), familyOfSecond(kind), of_b), sign};
}

/// One pair of bodies, with everything that its gap depends on.
struct Setting {
  const GapRow& row;
  Pose A, B;
  Vec3 size_a, size_b;

  /// A random one in which the features are in general position.
  Setting(const GapRow& r, std::uint64_t seed) : row(r) {
    Random random(seed);
    do {
      A = {random.vec(1), random.rotation().toRotationMatrix()};
      B = {random.vec(1), random.rotation().toRotationMatrix()};
      size_a = Vec3(0.5, 0.6, 0.7) + random.vec(0.2);
      size_b = Vec3(0.8, 0.7, 0.6) + random.vec(0.2);
    } while (!row.flat && !general());
    if (row.flat) lieFlat();
  }
  FeatureGeometry geometry() const {
    return FeatureGeometry({solidOf(bodyOf(row.a, size_a)), solidOf(bodyOf(row.b, size_b))});
  }
  FeaturePair features(const FeatureGeometry& g) const { return pairOf(g, row.kind, row.of_a, row.of_b, row.sign); }
  ContactPoint contact() const {
    const FeatureGeometry g = geometry();
    return g.contact(0, 1, features(g), A, B);
  }
  ContactJacobian jacobian() const {
    const FeatureGeometry g = geometry();
    return g.jacobian(0, 1, features(g), A, B);
  }

  /// Column c of a ContactJacobian (pose, sizes of a, sizes of b), by h.
  Setting moved(Eigen::Index c, double h) const {
    Setting s = *this;
    if (c >= 12) {
      const Eigen::Index of_a = jacobian().size_a.cols();
      (c - 12 < of_a ? s.size_a[c - 12] : s.size_b[c - 12 - of_a]) += h;
      return s;
    }
    Pose& pose = c < 6 ? s.A : s.B;
    if (c % 6 < 3)
      pose.x[c % 3] += h;
    else
      pose.R = expSO3(h * Vec3::Unit(c % 3)).toRotationMatrix() * pose.R;
    return s;
  }
  /// Body a moved along the normal so that the gap is 0.
  Setting touching() const {
    Setting s = *this;
    const ContactPoint c = contact();
    s.A.x -= c.gap * c.normal;
    return s;
  }
  /// The same gap with the bodies in the other order.
  FeatureGeometry swappedGeometry() const {
    return FeatureGeometry({solidOf(bodyOf(row.b, size_b)), solidOf(bodyOf(row.a, size_a))});
  }
  FeaturePair swappedFeatures(const FeatureGeometry& swapped) const {
    return pairOf(swapped, gapKind(familyOfSecond(row.kind), familyOfFirst(row.kind)), row.of_b, row.of_a,
                  row.swapped_sign);
  }

 private:
  /// The cap of a lies on what b's feature bounds, and their borders cross at right angles.
  void lieFlat() {
    const FeatureGeometry g = geometry();
    const FeaturePair pair = features(g);
    const Feature &f = g.solid(0).feature(Family::rim, pair.a), &h = g.solid(1).feature(familyOfSecond(row.kind), pair.b);
    const Vec3 out = h.rim > 0 ? h.direction : Vec3::UnitZ();  // of the face
    A.R = B.R * Quat::FromTwoVectors(f.direction, -out).toRotationMatrix();
    const Vec3 across = h.rim > 0 ? Vec3(std::hypot(f.rim, h.rim) * Vec3::UnitX()) : Vec3(0.1 * h.direction.cross(out));
    A.x = B.x + B.R * (h.point + across) - A.R * f.point;
  }

  /// A second place of a rim before a cone is there only near it.
  bool lastsApart(const FeatureGeometry& g, const FeaturePair& pair, const ContactPoint& c) const {
    return (g.contact(0, 1, pair, {A.x + 0.25 * c.normal, A.R}, B).normal - c.normal).norm() < 1e-9;
  }

  /// Edges that cross at an angle; rims that cross at an angle and nearly touch the other feature from outside, so
  /// that the solids could touch there.
  bool general() const {
    const FeatureGeometry g = geometry();
    const FeaturePair pair = features(g);
    const WorldFeature f = placeFeature(g.solid(0).feature(familyOfFirst(row.kind), pair.a), A),
                       h = placeFeature(g.solid(1).feature(familyOfSecond(row.kind), pair.b), B);
    const ContactPoint c = g.contact(0, 1, pair, A, B);
    if (row.kind == kEdgeEdge && f.apex == 0 && h.apex == 0) return f.direction.cross(h.direction).norm() > 0.2;
    if (row.kind == kEdgeEdge) return std::abs(c.normal.dot(f.direction.cross(h.direction))) > 0.3;
    if (f.rim == 0) return h.apex == 0 || h.direction.cross(c.point - h.point).norm() > 0.2;
    if (row.kind == kRimPlane) return f.direction.cross(h.direction).norm() > 0.2;
    if (!(std::abs(c.gap) < 0.02)) return false;
    const Vec3 u = (c.point - f.point).normalized(), t = f.direction.cross(u);
    if (!(c.normal.dot(u) < -0.2 && c.normal.dot(f.direction) < -0.2)) return false;
    if (h.apex > 0 && !lastsApart(g, pair, c)) return false;
    if (h.rim > 0 && h.apex == 0) {
      const Vec3 other = (c.point - c.gap * c.normal - h.point).normalized();
      return c.normal.dot(other) > 0.2 && c.normal.dot(h.direction) > 0.2 &&
             t.cross(h.direction.cross(other)).norm() > 0.5;
    }
    return row.kind != kRimEdge || t.cross(h.direction).norm() > 0.5;
  }
};

Eigen::Matrix<double, 7, 1> numbersOf(const ContactPoint& c) {
  Eigen::Matrix<double, 7, 1> all;
  all << c.gap, c.normal, c.point;
  return all;
}

/// Pose and size columns side by side.
Eigen::Matrix<double, 7, Eigen::Dynamic> columnsOf(const ContactJacobian& J) {
  Eigen::Matrix<double, 7, Eigen::Dynamic> all(7, 12 + J.size_a.cols() + J.size_b.cols());
  all << J.pose, J.size_a, J.size_b;
  return all;
}

class Gap : public ::testing::TestWithParam<GapRow> {};

TEST_P(Gap, JacobianIsTheLimitOfDifferences) {
  const double h = 5e-5;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s(GetParam(), seed);
    const auto jacobian = columnsOf(s.jacobian());
    Eigen::Matrix<double, 7, Eigen::Dynamic> differences(7, jacobian.cols());
    for (Eigen::Index c = 0; c < jacobian.cols(); ++c) {
      const auto wide = [&](double step) {
        return (numbersOf(s.moved(c, step).contact()) - numbersOf(s.moved(c, -step).contact())).eval();
      };
      differences.col(c) = (8 * wide(h) - wide(2 * h)) / (12 * h);
    }
    expectEntries(jacobian, differences, 1e-9, "jacobian");
  }
}

/// Direction c of a ContactJacobian's columns.
PairTangent directionOf(const Setting& s, Eigen::Index c) {
  const ContactJacobian J = s.jacobian();
  PairTangent d;
  d.size_a.setZero(J.size_a.cols());
  d.size_b.setZero(J.size_b.cols());
  const Eigen::Index of_a = J.size_a.cols();
  (c < 12 ? d.pose[c] : c - 12 < of_a ? d.size_a[c - 12] : d.size_b[c - 12 - of_a]) = 1;
  return d;
}

TEST_P(Gap, JacobianRatesAreTheLimitOfDifferences) {
  const double h = 5e-5;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s(GetParam(), seed);
    const FeatureGeometry g = s.geometry();
    const auto jacobian = columnsOf(s.jacobian());
    std::vector<PairTangent> directions;
    for (Eigen::Index c = 0; c < jacobian.cols(); ++c) directions.push_back(directionOf(s, c));
    const std::vector<ContactJacobian> rates = g.jacobianRates(0, 1, s.features(g), s.A, s.B, directions);
    ASSERT_EQ(rates.size(), directions.size());
    for (Eigen::Index c = 0; c < jacobian.cols(); ++c) {
      const auto wide = [&](double step) {
        return (columnsOf(s.moved(c, step).jacobian()) - columnsOf(s.moved(c, -step).jacobian())).eval();
      };
      const auto differences = ((8 * wide(h) - wide(2 * h)) / (12 * h)).eval();
      const auto found = columnsOf(rates[static_cast<std::size_t>(c)]);
      expectEntries(found, differences, 1e-9 * std::max(1.0, differences.cwiseAbs().maxCoeff()),
                    "along column " + std::to_string(c));
    }
  }
}

TEST_P(Gap, NormalIsUnitAndPointsFromBToA) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s(GetParam(), seed);
    const ContactPoint c = s.contact();
    expectEntries(c.normal.norm(), 1, 1e-15, "length of the normal");
    Setting apart = s;
    apart.A.x += 0.25 * c.normal;
    expectEntries(apart.contact().gap, c.gap + 0.25, 1e-13, "gap of a moved along n");
    expectEntries(apart.contact().normal, c.normal, 1e-13, "its normal");
  }
}

TEST_P(Gap, RateIsThatOfTheContactPoint) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s = Setting(GetParam(), seed).touching();
    const ContactPoint c = s.contact();
    expectEntries(c.gap, 0, 1e-14, "gap");
    Random random(seed);
    const Eigen::Matrix<double, 12, 1> rate = random.vector(12);
    const Vec3 u = rate.segment<3>(0) + rate.segment<3>(3).cross(c.point - s.A.x) - rate.segment<3>(6) -
                   rate.segment<3>(9).cross(c.point - s.B.x);
    expectEntries(s.jacobian().pose.row(0).dot(rate), c.normal.dot(u), 1e-13, "rate of the gap", rate.norm());
  }
}

// A motion of both bodies together changes nothing but carries normal and point along.
TEST_P(Gap, MovesWithTheBodies) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s(GetParam(), seed);
    Random random(seed + 100);
    const Mat3 R = random.rotation().toRotationMatrix();
    const Vec3 x = random.vec(2);
    Setting t = s;
    t.A = {x + R * s.A.x, R * s.A.R};
    t.B = {x + R * s.B.x, R * s.B.R};
    const ContactPoint c = s.contact(), d = t.contact();
    expectEntries(d.gap, c.gap, 1e-14, "gap");
    expectEntries(d.normal, R * c.normal, 1e-13, "normal");
    expectEntries(d.point, x + R * c.point, 1e-13, "point", 1 + (c.point - s.B.x).norm());
  }
}

TEST_P(Gap, SwappedBodiesHaveTheOppositeNormal) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s = Setting(GetParam(), seed).touching();
    const FeatureGeometry swapped = s.swappedGeometry();
    const FeaturePair features = s.swappedFeatures(swapped);
    const ContactPoint c = s.contact(), d = swapped.contact(0, 1, features, s.B, s.A);
    expectEntries(d.gap, c.gap, 1e-14, "gap");
    expectEntries(d.normal, -c.normal, 1e-14, "normal");
    expectEntries(d.point, c.point, 1e-13, "point", 1 + (c.point - s.B.x).norm());
    const ContactJacobian J = s.jacobian(), K = swapped.jacobian(0, 1, features, s.B, s.A);
    ContactJacobian expected;
    expected.pose << J.pose.rightCols<6>(), J.pose.leftCols<6>();
    expected.size_a = J.size_b;
    expected.size_b = J.size_a;
    expectEntries(columnsOf(K).row(0), columnsOf(expected).row(0), 1e-12, "d gap");
  }
}

TEST_P(Gap, IsDescribed) {
  const GapRow& row = GetParam();
  const Setting s(row, 1);
  const FeatureGeometry g = s.geometry(), swapped = s.swappedGeometry();
  EXPECT_EQ(g.describe(0, 1, s.features(g)), std::string(row.of_a) + " on " + row.of_b);
  EXPECT_EQ(swapped.describe(0, 1, s.swappedFeatures(swapped)), std::string(row.of_b) + " on " + row.of_a);
}

TEST(GapTable, EveryRowIsFoundByItsFamilies) {
  int rows = 0;
  for (Family a : {Family::vertex, Family::edge, Family::face, Family::rim})
    for (Family b : {Family::vertex, Family::edge, Family::face, Family::rim}) {
      EXPECT_EQ(hasKind(a, b), hasKind(b, a));
      const bool of_face = a == Family::face || b == Family::face, of_edge = a == Family::edge || b == Family::edge;
      EXPECT_EQ(hasKind(a, b), !(of_face && (of_edge || a == b)));
      if (!hasKind(a, b)) continue;
      ++rows;
      EXPECT_EQ(familyOfFirst(gapKind(a, b)), a);
      EXPECT_EQ(familyOfSecond(gapKind(a, b)), b);
      EXPECT_EQ(branches(gapKind(a, b)), branches(gapKind(b, a)));
    }
  EXPECT_EQ(rows, kGapKinds);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Gap, ::testing::ValuesIn(kRows), [](const auto& row) {
  std::string name = row.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

void PrintTo(const GapRow& row, std::ostream* out) { *out << row.name; }

}  // namespace
}  // namespace carom

// The smooth gaps between frozen features: Jacobians against central differences, and what every gap must keep.

#include <gtest/gtest.h>

#include "adjoint/so3.h"
#include "ode_bridge/gaps.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

enum class Kind { ball, box, plane };

struct GapRow {
  const char* name;
  Kind a, b;
  FeaturePair features, swapped;
  const char *described, *described_swapped;
};

const GapRow kRows[] = {
    {"ball on plane",
     Kind::ball,
     Kind::plane,
     {kPointPlane, 0, 0, 1},
     {kPlanePoint, 0, 0, 1},
     "ball on plane",
     "plane on ball"},
    {"vertex on plane",
     Kind::box,
     Kind::plane,
     {kPointPlane, 5, 0, 1},
     {kPlanePoint, 0, 5, 1},
     "vertex +x-y+z on plane",
     "plane on vertex +x-y+z"},
    {"vertex on face",
     Kind::box,
     Kind::box,
     {kPointPlane, 3, 4, 1},
     {kPlanePoint, 4, 3, 1},
     "vertex +x+y-z on face -z",
     "face -z on vertex +x+y-z"},
    {"ball on face",
     Kind::ball,
     Kind::box,
     {kPointPlane, 0, 3, 1},
     {kPlanePoint, 3, 0, 1},
     "ball on face +y",
     "face +y on ball"},
    {"ball on ball",
     Kind::ball,
     Kind::ball,
     {kPointPoint, 0, 0, 1},
     {kPointPoint, 0, 0, 1},
     "ball on ball",
     "ball on ball"},
    {"ball on vertex",
     Kind::ball,
     Kind::box,
     {kPointPoint, 0, 6, 1},
     {kPointPoint, 6, 0, 1},
     "ball on vertex -x+y+z",
     "vertex -x+y+z on ball"},
    {"ball on edge",
     Kind::ball,
     Kind::box,
     {kPointEdge, 0, 1, 1},
     {kEdgePoint, 1, 0, 1},
     "ball on edge +y-z",
     "edge +y-z on ball"},
    {"ball on another edge",
     Kind::ball,
     Kind::box,
     {kPointEdge, 0, 6, 1},
     {kEdgePoint, 6, 0, 1},
     "ball on edge -z+x",
     "edge -z+x on ball"},
    {"edge on edge",
     Kind::box,
     Kind::box,
     {kEdgeEdge, 0, 11, 1},
     {kEdgeEdge, 11, 0, 1},
     "edge -y-z on edge +x+y",
     "edge +x+y on edge -y-z"},
    {"edge on edge, other side",
     Kind::box,
     Kind::box,
     {kEdgeEdge, 5, 2, -1},
     {kEdgeEdge, 2, 5, -1},
     "edge +z-x on edge -y+z",
     "edge -y+z on edge +z-x"},
};

Shape shapeOf(Kind kind, const Vec3& size) {
  if (kind == Kind::ball) return Sphere{size.x()};
  if (kind == Kind::box) return Box{size};
  return Plane{Vec3(0.6, 0, 0.8), 0.3};
}

/// One pair of bodies, with everything that its gap depends on.
struct Setting {
  const GapRow& row;
  Pose A, B;
  Vec3 size_a, size_b;

  Setting(const GapRow& r, std::uint64_t seed) : row(r) {
    Random random(seed);
    A = {random.vec(1), random.rotation().toRotationMatrix()};
    B = {random.vec(1), random.rotation().toRotationMatrix()};
    size_a = Vec3(0.5, 0.6, 0.7) + random.vec(0.2);
    size_b = Vec3(0.8, 0.7, 0.6) + random.vec(0.2);
  }
  FeatureGeometry geometry() const {
    return FeatureGeometry({solidOf(shapeOf(row.a, size_a)), solidOf(shapeOf(row.b, size_b))});
  }
  ContactPoint contact() const { return geometry().contact(0, 1, row.features, A, B); }
  ContactJacobian jacobian() const { return geometry().jacobian(0, 1, row.features, A, B); }

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
  const double h = 1e-5;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s(GetParam(), seed);
    const auto jacobian = columnsOf(s.jacobian());
    Eigen::Matrix<double, 7, Eigen::Dynamic> differences(7, jacobian.cols());
    for (Eigen::Index c = 0; c < jacobian.cols(); ++c)
      differences.col(c) = (numbersOf(s.moved(c, h).contact()) - numbersOf(s.moved(c, -h).contact())) / (2 * h);
    expectEntries(jacobian, differences, 1e-7, "jacobian");
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
  const GapRow& row = GetParam();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Setting s = Setting(row, seed).touching();
    const FeatureGeometry swapped({solidOf(shapeOf(row.b, s.size_b)), solidOf(shapeOf(row.a, s.size_a))});
    const ContactPoint c = s.contact(), d = swapped.contact(0, 1, row.swapped, s.B, s.A);
    expectEntries(d.gap, c.gap, 1e-14, "gap");
    expectEntries(d.normal, -c.normal, 1e-14, "normal");
    expectEntries(d.point, c.point, 1e-13, "point", 1 + (c.point - s.B.x).norm());
    const ContactJacobian J = s.jacobian(), K = swapped.jacobian(0, 1, row.swapped, s.B, s.A);
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
  EXPECT_EQ(s.geometry().describe(0, 1, row.features), row.described);
  const FeatureGeometry swapped({solidOf(shapeOf(row.b, s.size_b)), solidOf(shapeOf(row.a, s.size_a))});
  EXPECT_EQ(swapped.describe(0, 1, row.swapped), row.described_swapped);
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

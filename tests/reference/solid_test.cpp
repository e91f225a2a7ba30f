// SPDX-License-Identifier: MIT
// Mass properties of shapes and their rates by every dimension, against sums and differences in 50 digits.

#include <gtest/gtest.h>

#include <iostream>

#include "tests/reference/worst.h"
#include "tests/reference/written_body.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom::reference {
namespace {

using test::Random;

constexpr double kSolidTolerance = 1e-13;  ///< of the volume, the extent, its square; rates by a dimension that far
const Real kHalfWidth("1e-16");

Shape randomShape(Random& random, int kind) {
  const auto size = [&] { return std::exp(random.in(-2, 1)); };
  const test::Triangles t = test::torusTriangles(size(), 0.1, 9, 6).placed(random.rotation(), random.vec(1));
  const auto tetrahedron = test::tetrahedron({0.1, 0, 0}, {size(), 0.1, 0}, {0, size(), -0.1}, {0.2, 0.1, size()});
  switch (kind) {
    case 0:
      return Sphere{size()};
    case 1:
      return Box{{size(), size(), size()}};
    case 2:
      return Cylinder{size(), size()};
    case 3:
      return Capsule{size(), size()};
    case 4:
      return Hull{tetrahedron.surface(), size(), ""};
    case 5:
      return Mesh{t.surface(), size(), ""};
    case 6:
      return Cone{size(), size()};
    default:
      break;
  }
  Compound c;
  for (int part = 0; part < 7; ++part) c.parts.push_back({randomShape(random, part), random.vec(1), random.rotation()});
  return c;
}

/// Volume, centre, and inertia about it per unit mass, as 13 numbers.
std::array<Real, 13> flat(const RealSolid& s) {
  std::array<Real, 13> all;
  all[0] = s.volume;
  for (int i = 0; i < 3; ++i) all[static_cast<std::size_t>(1 + i)] = s.center[i];
  for (int i = 0; i < 9; ++i) all[static_cast<std::size_t>(4 + i)] = s.J.column[i / 3][i % 3] / s.volume;
  return all;
}
template <class Properties>
std::array<double, 13> flat(const Properties& p) {
  std::array<double, 13> all;
  all[0] = p.volume;
  for (int i = 0; i < 3; ++i) all[static_cast<std::size_t>(1 + i)] = p.center[i];
  for (int i = 0; i < 9; ++i) all[static_cast<std::size_t>(4 + i)] = p.unit_inertia(i % 3, i / 3);
  return all;
}

RealSolid solidOf(const std::vector<PartNumbers>& parts) {
  WrittenNumbers n;
  n.parts = parts;
  return n.solid();
}

TEST(Solids, PropertiesAndRates) {
  double worst = 0, worst_rate = 0;
  for (int round = 0; round < 70; ++round) {
    SCOPED_TRACE("seed 51, round " + std::to_string(round));
    Random random(51 + static_cast<std::uint64_t>(round));
    const Shape shape = randomShape(random, round % 7);
    const ShapeKind& kind = kindOf(shape);
    const SolidProperties found = kind.properties(shape);
    std::vector<PartNumbers> parts;
    if (const auto* compound = std::get_if<Compound>(&shape))
      for (const CompoundPart& p : compound->parts) parts.push_back(partOf(p.shape, p.position, p.orientation));
    else
      parts.push_back(partOf(shape, Vec3::Zero(), Quat::Identity()));

    const double extent = kind.boundingRadius(shape);
    const auto scale = [&](std::size_t i) { return i == 0 ? found.volume : i < 4 ? extent : extent * extent; };
    const auto expected = flat(solidOf(parts));
    const auto now = flat(found);
    for (std::size_t i = 0; i < 13; ++i)
      keepWorst(worst, std::abs(now[i] - static_cast<double>(expected[i])) / scale(i));

    const Eigen::VectorXd dimensions = kind.dimensions(shape);
    std::size_t d = 0;
    for (PartNumbers& part : parts)
      for (Real& size : part.size) {
        ASSERT_LT(d, found.rates.size());
        const Real at = size;
        size = at + kHalfWidth;
        const auto high = flat(solidOf(parts));
        size = at - kHalfWidth;
        const auto low = flat(solidOf(parts));
        size = at;
        const auto rate = flat(found.rates[d]);
        for (std::size_t i = 0; i < 13; ++i) {
          const double wanted = static_cast<double>(Real((high[i] - low[i]) / (2 * kHalfWidth)));
          keepWorst(worst_rate, std::abs(rate[i] - wanted) * dimensions[static_cast<Eigen::Index>(d)] / scale(i));
        }
        ++d;
      }
    EXPECT_EQ(d, found.rates.size());
  }
  std::cout << "worst property " << worst << ", worst rate " << worst_rate << '\n';
  EXPECT_LE(worst, kSolidTolerance);
  EXPECT_LE(worst_rate, kSolidTolerance);
}

}  // namespace
}  // namespace carom::reference

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <tuple>

#include "adjoint/base/arguments.hpp"
#include "adjoint/numeric/dual.hpp"
#include "adjoint/scene/shape.h"
#include "adjoint/scene/validation.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

// The table of shapes: a row each, which stands with its formulas in the file of that name. That of a shape with a
// header of its own is declared there.
ShapeKind kindRow(KindOf<Sphere>);
ShapeKind kindRow(KindOf<Box>);
ShapeKind kindRow(KindOf<Plane>);
ShapeKind kindRow(KindOf<Capsule>);
ShapeKind kindRow(KindOf<Cylinder>);
ShapeKind kindRow(KindOf<Hull>);
ShapeKind kindRow(KindOf<Mesh>);
ShapeKind kindRow(KindOf<Compound>);

/// The shape as the kind that its row is for.
template <class Kind>
const Kind& as(const Shape& shape) {
  return std::get<Kind>(shape);
}

/// Throws InputError unless there is a number for each dimension.
inline void requireDimensions(const Eigen::VectorXd& given, Eigen::Index count) {
  checkCount("dimensions of a shape", "numbers", static_cast<std::size_t>(given.size()), static_cast<std::size_t>(count));
}

template <class S>
M3<S> diagonal(const S& x, const S& y, const S& z) {
  return V3<S>(x, y, z).asDiagonal();
}

/// Numbers of rates: mass properties computed in them carry their own rates along.
using Number = Dual<1>;

/// The rates that they carry.
inline SolidProperties carriedBy(const SolidPropertiesOf<Number>& p) {
  SolidProperties out{p.volume.rate[0], ratesOf(p.center, 0), ratesOf(p.unit_inertia, 0), {}};
  for (const SolidRateOf<Number>& r : p.rates)
    out.rates.push_back({r.volume.rate[0], ratesOf(r.center, 0), ratesOf(r.unit_inertia, 0)});
  return out;
}

/// The row of a shape that has some numbers for dimensions, from a description of it:
///   using Kind = Cone;
///   static constexpr const char* name = "cone";
///   static constexpr std::array words{"radius", "height"};
///   static auto numbers(auto& s);                                                 // std::tie of the members
///   template <class S>
///   static SolidPropertiesOf<S> solid(const Cone&, const std::array<S, 2>& numbers);  // with the rates with respect to them
///   static double outer(const Cone&), inner(const Cone&);                         // radii, see ShapeKind
///   static FarthestPoint farthest(const Cone&, const Vec3& n);
/// Numbers are taken to be lengths, and the shape to have a volume.
template <class Row, class Kind = typename Row::Kind>
ShapeKind sizedRow() {
  static constexpr std::size_t kCount = Row::words.size();
  static constexpr auto numbersOf = [](const Shape& s) {
    return std::apply([](const auto&... x) { return std::array{x...}; }, Row::numbers(as<Kind>(s)));
  };
  return {
      .name = Row::name,
      .check =
          [](const Shape& s, const validation::ShapeCheck& at) {
            const auto numbers = numbersOf(s);
            for (std::size_t i = 0; i < kCount; ++i) validation::requireLength(at.where / Row::words[i], numbers[i]);
          },
      .dimension_names = [](const Shape&) { return std::vector<std::string>(Row::words.begin(), Row::words.end()); },
      .dimensions =
          [](const Shape& s) {
            return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(numbersOf(s).data(), kCount));
          },
      .setDimensions =
          [](Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, kCount);
            std::apply([i = d.begin()](auto&... x) mutable { ((x = *i++), ...); }, Row::numbers(std::get<Kind>(s)));
          },
      .solid = [](const Shape&) { return true; },
      .properties = [](const Shape& s) { return Row::template solid<double>(as<Kind>(s), numbersOf(s)); },
      .propertiesRate =
          [](const Shape& s, const Eigen::VectorXd& d) {
            requireDimensions(d, kCount);
            const auto values = numbersOf(s);
            std::array<Number, kCount> numbers;
            for (std::size_t i = 0; i < kCount; ++i) {
              numbers[i] = values[i];
              numbers[i].rate[0] = d[static_cast<Eigen::Index>(i)];
            }
            return carriedBy(Row::template solid<Number>(as<Kind>(s), numbers));
          },
      .boundingRadius = [](const Shape& s) { return Row::outer(as<Kind>(s)); },
      .innerRadius = [](const Shape& s) { return Row::inner(as<Kind>(s)); },
      .farthest = [](const Shape& s, const Vec3& n) { return Row::farthest(as<Kind>(s), n); },
  };
}

}  // namespace carom::shapes

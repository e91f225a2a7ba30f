// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/scene/shape_kinds/kinds.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

const std::vector<CompoundPart>& parts(const Shape& s) { return std::get<Compound>(s).parts; }

// Names of part i's dimensions begin with "i."; a part may be a compound itself.
std::vector<std::string> names(const Shape& s) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < parts(s).size(); ++i) {
    const Shape& part = parts(s)[i].shape;
    for (const std::string& name : kindOf(part).dimension_names(part)) all.push_back(std::to_string(i) + "." + name);
  }
  return all;
}

Eigen::VectorXd dimensions(const Shape& s) {
  std::vector<double> all;
  for (const CompoundPart& part : parts(s)) {
    const Eigen::VectorXd d = kindOf(part.shape).dimensions(part.shape);
    all.insert(all.end(), d.begin(), d.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

void setDimensions(Shape& s, const Eigen::VectorXd& values) {
  requireDimensions(values, dimensions(s).size());
  Eigen::Index first = 0;
  for (CompoundPart& part : std::get<Compound>(s).parts) {
    const ShapeKind& kind = kindOf(part.shape);
    const Eigen::Index count = kind.dimensions(part.shape).size();
    kind.setDimensions(part.shape, values.segment(first, count));
    first += count;
  }
}

bool solid(const Shape& s) {
  return !parts(s).empty() && std::all_of(parts(s).begin(), parts(s).end(),
                                          [](const CompoundPart& p) { return kindOf(p.shape).solid(p.shape); });
}

// R I R^T. What is the same about every axis (a ball) or about the axis of the turn stays so exactly.
template <class S>
M3<S> turned(const Mat3& R, const M3<S>& I) {
  if (R.isIdentity(0)) return I;
  const M3<S> same = I(0, 0) * M3<S>::Identity();
  const M3<S> rest = R * (I - same) * R.transpose();
  return same + 0.5 * (rest + rest.transpose());
}

// Parallel axes: |d|^2 1 - d d^T, and its rate with respect to d along e.
template <class S>
M3<S> shifted(const V3<S>& d) {
  return d.squaredNorm() * M3<S>::Identity() - d * d.transpose();
}
template <class S>
M3<S> shiftedRate(const V3<S>& d, const V3<S>& e) {
  return 2 * d.dot(e) * M3<S>::Identity() - d * e.transpose() - e * d.transpose();
}

// V = sum V_i, c = sum w_i c_i, I = sum w_i (R_i I_i R_i^T + S(c_i - c)), with shares w_i = V_i/V and S(d) = |d|^2 1 -
// d d^T. By a dimension of part i (the parts' shares change and so does c, but sum w_j (c_j - c) = 0):
//   dc = dV_i/V (c_i - c) + w_i R_i dc_i
//   dI = dV_i/V (R_i I_i R_i^T + S(c_i - c) - I) + w_i (R_i dI_i R_i^T + dS(c_i - c; R_i dc_i))
template <class S, class OfPart>
SolidPropertiesOf<S> combined(const Shape& s, const OfPart& of_part) {
  struct Part {
    SolidPropertiesOf<S> solid;
    Mat3 R;
    V3<S> center;
    M3<S> inertia;  // of the part about the compound's centre, per unit mass of the part
  };
  if (parts(s).empty())
    throw InputError("found a compound without parts, which has no mass properties, expected parts");
  std::vector<Part> all;
  SolidPropertiesOf<S> p;
  for (const CompoundPart& part : parts(s)) {
    Part& a = all.emplace_back();
    a.solid = of_part(part.shape);
    a.R = part.orientation.normalized().toRotationMatrix();
    a.center = part.position + a.R * a.solid.center;
    p.volume += a.solid.volume;
  }
  for (const Part& a : all) p.center += a.solid.volume / p.volume * a.center;
  for (Part& a : all) {
    a.inertia = turned<S>(a.R, a.solid.unit_inertia) + shifted<S>(a.center - p.center);
    p.unit_inertia += a.solid.volume / p.volume * a.inertia;
  }
  for (const Part& a : all) {
    const S share = a.solid.volume / p.volume;
    for (const SolidRateOf<S>& rate : a.solid.rates) {
      const S dshare = rate.volume / p.volume;
      const V3<S> d = a.center - p.center, dcenter = a.R * rate.center;
      p.rates.push_back({rate.volume, dshare * d + share * dcenter,
                         dshare * (a.inertia - p.unit_inertia) +
                             share * (turned<S>(a.R, rate.unit_inertia) + shiftedRate<S>(d, dcenter))});
    }
  }
  return p;
}

SolidProperties compoundProperties(const Shape& s) {
  return combined<double>(s, [](const Shape& part) { return kindOf(part).properties(part); });
}

// A number, a vector or a matrix that carries rates.
Number carrying(double value, double rate) {
  Number n = value;
  n.rate[0] = rate;
  return n;
}
template <class Matrix>
auto carrying(const Matrix& values, const Matrix& rates) {
  auto out = values.template cast<Number>().eval();
  setRates(out, rates, 0);
  return out;
}

SolidProperties compoundPropertiesRate(const Shape& s, const Eigen::VectorXd& dimension_rates) {
  requireDimensions(dimension_rates, dimensions(s).size());
  Eigen::Index first = 0;
  return carriedBy(combined<Number>(s, [&](const Shape& part) {
    const ShapeKind& kind = kindOf(part);
    const SolidProperties a = kind.properties(part);
    const Eigen::Index count = kind.dimensions(part).size();
    const SolidProperties da = kind.propertiesRate(part, dimension_rates.segment(first, count));
    first += count;
    const auto joined = [](const auto& x, const auto& dx) {
      return SolidRateOf<Number>{carrying(x.volume, dx.volume), carrying(x.center, dx.center),
                                 carrying(x.unit_inertia, dx.unit_inertia)};
    };
    const auto [volume, center, unit_inertia] = joined(a, da);
    SolidPropertiesOf<Number> out{volume, center, unit_inertia, {}};
    for (std::size_t i = 0; i < a.rates.size(); ++i) out.rates.push_back(joined(a.rates[i], da.rates[i]));
    return out;
  }));
}

double boundingRadius(const Shape& s) {
  double largest = 0;
  for (const CompoundPart& part : parts(s))
    largest = std::max(largest, part.position.norm() + kindOf(part.shape).boundingRadius(part.shape));
  return largest;
}

// Of all parts the one that reaches farthest, in the axes of the compound.
FarthestPoint farthest(const Shape& s, const Vec3& n) {
  FarthestPoint best;
  Eigen::Index first = 0, of_best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (const CompoundPart& part : parts(s)) {
    const Quat R = part.orientation.normalized();
    FarthestPoint p = kindOf(part.shape).farthest(part.shape, R.conjugate() * n);
    p.corner = part.position + R * p.corner;
    p.axis = R * p.axis;
    p.corner_rates = R.toRotationMatrix() * p.corner_rates;
    const Eigen::Index at = first;
    first += p.ball_rates.size();
    const double reach = p.reach(n);
    if (reach > most) {
      p.margin = std::min(p.margin, reach - most);
      best = std::move(p), most = reach, of_best = at;
    } else {
      best.margin = std::min(best.margin, most - reach);
    }
  }
  FarthestPoint whole = FarthestPoint::at(best.corner, first);
  whole.ball = best.ball, whole.rim = best.rim, whole.axis = best.axis, whole.margin = best.margin;
  whole.corner_rates.middleCols(of_best, best.corner_rates.cols()) = best.corner_rates;
  whole.ball_rates.segment(of_best, best.ball_rates.size()) = best.ball_rates;
  whole.rim_rates.segment(of_best, best.rim_rates.size()) = best.rim_rates;
  return whole;
}

constexpr int kDeepest = 16;  // compounds inside compounds

void checkCompound(const Shape& s, const validation::ShapeCheck& at) {
  const validation::Place& where = at.where;
  if (parts(s).empty()) validation::fail(where, "no parts", "one or more");
  if (at.depth == kDeepest)
    validation::fail(where, "compounds nested deeper than " + std::to_string(kDeepest), "fewer levels");
  for (std::size_t i = 0; i < parts(s).size(); ++i) {
    const CompoundPart& part = parts(s)[i];
    const ShapeKind& kind = kindOf(part.shape);
    const validation::Place here = where / i, inner = here / kind.name;
    if (kind.endless) validation::fail(inner, std::string("a ") + kind.name, "a part of finite extent");
    kind.check(part.shape, {.where = inner, .derived = at.derived, .depth = at.depth + 1});
    validation::requireFinite(here / "position", part.position);
    validation::requireUnit(here / "orientation", part.orientation);
  }
}

}  // namespace

ShapeKind kindRow(KindOf<Compound>) {
  return {
      .name = "compound",
      .of_parts = true,
      .check = checkCompound,
      .dimension_names = names,
      .dimensions = dimensions,
      .setDimensions = setDimensions,
      .solid = solid,
      .properties = compoundProperties,
      .propertiesRate = compoundPropertiesRate,
      .boundingRadius = boundingRadius,
      .innerRadius = [](const Shape&) { return 0.0; },
      .farthest = farthest,
  };
}

}  // namespace carom::shapes

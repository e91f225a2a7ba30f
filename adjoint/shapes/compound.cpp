#include <algorithm>

#include "adjoint/errors.h"
#include "adjoint/shapes/kinds.h"

namespace carom::shapes {
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
Mat3 turned(const Mat3& R, const Mat3& I) {
  if (R.isIdentity(0)) return I;
  const Mat3 same = I(0, 0) * Mat3::Identity();
  const Mat3 rest = R * (I - same) * R.transpose();
  return same + 0.5 * (rest + rest.transpose());
}

// Parallel axes: |d|^2 1 - d d^T, and its rate by d along e.
Mat3 shifted(const Vec3& d) { return d.squaredNorm() * Mat3::Identity() - d * d.transpose(); }
Mat3 shiftedRate(const Vec3& d, const Vec3& e) {
  return 2 * d.dot(e) * Mat3::Identity() - d * e.transpose() - e * d.transpose();
}

// V = sum V_i, c = sum w_i c_i, I = sum w_i (R_i I_i R_i^T + S(c_i - c)), with shares w_i = V_i/V and S(d) = |d|^2 1 -
// d d^T. By a dimension of part i (the parts' shares change and so does c, but sum w_j (c_j - c) = 0):
//   dc = dV_i/V (c_i - c) + w_i R_i dc_i
//   dI = dV_i/V (R_i I_i R_i^T + S(c_i - c) - I) + w_i (R_i dI_i R_i^T + dS(c_i - c; R_i dc_i))
SolidProperties properties(const Shape& s) {
  struct Part {
    SolidProperties solid;
    Mat3 R;
    Vec3 center;
    Mat3 inertia;  // of the part about the compound's centre, per unit mass of the part
  };
  if (parts(s).empty())
    throw InputError("found the mass properties of a compound without parts asked for, expected parts");
  std::vector<Part> all;
  SolidProperties p;
  for (const CompoundPart& part : parts(s)) {
    Part& a = all.emplace_back();
    a.solid = kindOf(part.shape).properties(part.shape);
    a.R = part.orientation.normalized().toRotationMatrix();
    a.center = part.position + a.R * a.solid.center;
    p.volume += a.solid.volume;
  }
  for (const Part& a : all) p.center += a.solid.volume / p.volume * a.center;
  for (Part& a : all) {
    a.inertia = turned(a.R, a.solid.unit_inertia) + shifted(a.center - p.center);
    p.unit_inertia += a.solid.volume / p.volume * a.inertia;
  }
  for (const Part& a : all) {
    const double share = a.solid.volume / p.volume;
    for (const SolidRate& rate : a.solid.rates) {
      const double dshare = rate.volume / p.volume;
      const Vec3 d = a.center - p.center, dcenter = a.R * rate.center;
      p.rates.push_back(
          {rate.volume, dshare * d + share * dcenter,
           dshare * (a.inertia - p.unit_inertia) + share * (turned(a.R, rate.unit_inertia) + shiftedRate(d, dcenter))});
    }
  }
  return p;
}

double boundingRadius(const Shape& s) {
  double largest = 0;
  for (const CompoundPart& part : parts(s))
    largest = std::max(largest, part.position.norm() + kindOf(part.shape).boundingRadius(part.shape));
  return largest;
}

}  // namespace

ShapeKind compoundKind() { return {"compound", names, dimensions, setDimensions, solid, properties, boundingRadius}; }

}  // namespace carom::shapes

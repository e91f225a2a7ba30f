#include "ode_bridge/gaps.h"

#include <array>

namespace carom {
namespace {

enum class Family { vertex, edge, face };

// Columns of a FeatureJacobian.
constexpr int kP1 = 0, kD1 = 3, kR1 = 6, kP2 = 7, kD2 = 10, kR2 = 13;

ContactPoint pointPlane(const WorldFeature& f, const WorldFeature& g, double) {
  return {g.direction.dot(f.point - g.point) - f.radius, g.direction, f.point - f.radius * g.direction};
}

FeatureJacobian pointPlaneJacobian(const WorldFeature& f, const WorldFeature& g, double) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3& N = g.direction;
  J.block<1, 3>(0, kP1) = N.transpose();
  J.block<1, 3>(0, kP2) = -N.transpose();
  J.block<1, 3>(0, kD2) = (f.point - g.point).transpose();
  J(0, kR1) = -1;
  J.block<3, 3>(1, kD2).setIdentity();
  J.block<3, 3>(4, kP1).setIdentity();
  J.block<3, 3>(4, kD2) = -f.radius * Mat3::Identity();
  J.block<3, 1>(4, kR1) = -N;
  return J;
}

ContactPoint pointPoint(const WorldFeature& f, const WorldFeature& g, double) {
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  return {l - f.radius - g.radius, n, g.point + g.radius * n};
}

FeatureJacobian pointPointJacobian(const WorldFeature& f, const WorldFeature& g, double) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  const Mat3 dn = (Mat3::Identity() - n * n.transpose()) / l;
  J.block<1, 3>(0, kP1) = n.transpose();
  J.block<1, 3>(0, kP2) = -n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  J.block<3, 3>(1, kP1) = dn;
  J.block<3, 3>(1, kP2) = -dn;
  J.block<3, 3>(4, kP1) = g.radius * dn;
  J.block<3, 3>(4, kP2) = Mat3::Identity() - g.radius * dn;
  J.block<3, 1>(4, kR2) = n;
  return J;
}

ContactPoint pointEdge(const WorldFeature& f, const WorldFeature& g, double) {
  const Vec3 to = f.point - g.point, w = to - g.direction.dot(to) * g.direction;
  const double l = w.norm();
  const Vec3 n = w / l;
  return {l - f.radius - g.radius, n, f.point - f.radius * n};
}

FeatureJacobian pointEdgeJacobian(const WorldFeature& f, const WorldFeature& g, double) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3 &d = g.direction, to = f.point - g.point;
  const double t = d.dot(to);
  const Vec3 w = to - t * d;
  const double l = w.norm();
  const Vec3 n = w / l;
  const Mat3 across = (Mat3::Identity() - n * n.transpose()) / l;
  const Mat3 dw_dP = Mat3::Identity() - d * d.transpose();
  const Mat3 dw_dd = -t * Mat3::Identity() - d * to.transpose();
  J.block<1, 3>(0, kP1) = n.transpose();
  J.block<1, 3>(0, kP2) = -n.transpose();
  J.block<1, 3>(0, kD2) = -t * n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  J.block<3, 3>(1, kP1) = across * dw_dP;
  J.block<3, 3>(1, kP2) = -across * dw_dP;
  J.block<3, 3>(1, kD2) = across * dw_dd;
  J.block<3, 14>(4, 0) = -f.radius * J.block<3, 14>(1, 0);
  J.block<3, 3>(4, kP1) += Mat3::Identity();
  J.block<3, 1>(4, kR1) -= n;
  return J;
}

// Nearest point of edge 2: Q_2 + t_2 d_2 with t_2 = -w.(d_1 x c)/|c|^2, w = Q_1 - Q_2, c = d_1 x d_2.
ContactPoint edgeEdge(const WorldFeature& f, const WorldFeature& g, double sign) {
  const Vec3 c = f.direction.cross(g.direction), w = f.point - g.point;
  const Vec3 n = sign * c.normalized();
  const double t2 = -w.dot(f.direction.cross(c)) / c.squaredNorm();
  return {n.dot(w) - f.radius - g.radius, n, g.point + t2 * g.direction + g.radius * n};
}

FeatureJacobian edgeEdgeJacobian(const WorldFeature& f, const WorldFeature& g, double sign) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3 &d1 = f.direction, &d2 = g.direction, c = d1.cross(d2), w = f.point - g.point;
  const double s2 = c.squaredNorm(), s = std::sqrt(s2);
  const Vec3 n = sign / s * c, d1c = d1.cross(c);
  const double t2 = -w.dot(d1c) / s2;
  const Mat3 dc_dd1 = -skew(d2), dc_dd2 = skew(d1);
  const Mat3 dn_dc = sign / s * (Mat3::Identity() - n * n.transpose());
  J.block<3, 3>(1, kD1) = dn_dc * dc_dd1;
  J.block<3, 3>(1, kD2) = dn_dc * dc_dd2;
  J.row(0) = w.transpose() * J.block<3, 14>(1, 0);
  J.block<1, 3>(0, kP1) += n.transpose();
  J.block<1, 3>(0, kP2) -= n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  // t_2 = -w.(d_1 x c)/s2
  const Eigen::RowVector3d dt_dc = -(w.cross(d1).transpose() + 2 * t2 * c.transpose()) / s2;
  Eigen::Matrix<double, 1, 14> dt = Eigen::Matrix<double, 1, 14>::Zero();
  dt.segment<3>(kP1) = -d1c.transpose() / s2;
  dt.segment<3>(kP2) = d1c.transpose() / s2;
  dt.segment<3>(kD1) = -c.cross(w).transpose() / s2 + dt_dc * dc_dd1;
  dt.segment<3>(kD2) = dt_dc * dc_dd2;
  J.block<3, 14>(4, 0) = d2 * dt + g.radius * J.block<3, 14>(1, 0);
  J.block<3, 3>(4, kP2) += Mat3::Identity();
  J.block<3, 3>(4, kD2) += t2 * Mat3::Identity();
  J.block<3, 1>(4, kR2) += n;
  return J;
}

struct GapRow {
  const char* name;
  Family a, b;
  bool swapped;  // the gap's first feature is body b's
  ContactPoint (*contact)(const WorldFeature&, const WorldFeature&, double sign);
  FeatureJacobian (*jacobian)(const WorldFeature&, const WorldFeature&, double sign);
};

// In the order of GapKind.
constexpr std::array<GapRow, 6> kGaps{{
    {"point-plane", Family::vertex, Family::face, false, pointPlane, pointPlaneJacobian},
    {"plane-point", Family::face, Family::vertex, true, pointPlane, pointPlaneJacobian},
    {"point-point", Family::vertex, Family::vertex, false, pointPoint, pointPointJacobian},
    {"point-edge", Family::vertex, Family::edge, false, pointEdge, pointEdgeJacobian},
    {"edge-point", Family::edge, Family::vertex, true, pointEdge, pointEdgeJacobian},
    {"edge-edge", Family::edge, Family::edge, false, edgeEdge, edgeEdgeJacobian},
}};

const Feature& featureOf(const Solid& solid, Family family, int index) {
  const auto i = static_cast<std::size_t>(index);
  return family == Family::vertex ? solid.vertices[i] : family == Family::edge ? solid.edges[i] : solid.faces[i];
}

WorldFeature place(const Feature& f, const Pose& pose) {
  return {pose.x + pose.R * f.point, pose.R * f.direction, f.radius};
}

// d(feature in the world) by (x, theta, dimensions), folded into the columns of one side.
void fold(const FeatureJacobian& J, int column, const Feature& f, const Pose& pose,
          Eigen::Ref<Eigen::Matrix<double, 7, 6>> by_pose, Eigen::Matrix<double, 7, Eigen::Dynamic>& by_size) {
  const auto JP = J.middleCols<3>(column), JD = J.middleCols<3>(column + 3);
  by_pose.leftCols<3>() = JP;
  by_pose.rightCols<3>() = -JP * skew(pose.R * f.point) - JD * skew(pose.R * f.direction);
  by_size = JP * (pose.R * f.dpoint) + J.col(column + 6) * f.dradius;
}

std::string nameOf(const Solid& solid, Family family, int index) {
  if (solid.ball) return "ball";
  if (solid.plane) return "plane";
  static const char* const kAxes[] = {"x", "y", "z"};
  if (family == Family::face) return std::string("face ") + (index % 2 ? "+" : "-") + kAxes[index / 2];
  if (family == Family::edge) {
    const int k = index / 4;
    std::string text = "edge ";
    for (int j = 0; j < 2; ++j) text += std::string(index >> j & 1 ? "+" : "-") + kAxes[(k + 1 + j) % 3];
    return text;
  }
  std::string text = "vertex ";
  for (int k = 0; k < 3; ++k) text += std::string(index >> k & 1 ? "+" : "-") + kAxes[k];
  return text;
}

}  // namespace

ContactPoint FeatureGeometry::contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const {
  const GapRow& row = kGaps[static_cast<std::size_t>(f.kind)];
  const WorldFeature fa = place(featureOf(solid(a), row.a, f.a), A), fb = place(featureOf(solid(b), row.b, f.b), B);
  if (!row.swapped) return row.contact(fa, fb, f.sign);
  ContactPoint c = row.contact(fb, fa, f.sign);
  c.normal = -c.normal;
  return c;
}

ContactJacobian FeatureGeometry::jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const {
  const GapRow& row = kGaps[static_cast<std::size_t>(f.kind)];
  const Feature &fa = featureOf(solid(a), row.a, f.a), &fb = featureOf(solid(b), row.b, f.b);
  const WorldFeature wa = place(fa, A), wb = place(fb, B);
  FeatureJacobian J = row.swapped ? row.jacobian(wb, wa, f.sign) : row.jacobian(wa, wb, f.sign);
  if (row.swapped) J.middleRows<3>(1) *= -1;
  ContactJacobian out;
  fold(J, row.swapped ? kP2 : kP1, fa, A, out.pose.leftCols<6>(), out.size_a);
  fold(J, row.swapped ? kP1 : kP2, fb, B, out.pose.rightCols<6>(), out.size_b);
  return out;
}

std::string FeatureGeometry::describe(int a, int b, const FeaturePair& f) const {
  const GapRow& row = kGaps[static_cast<std::size_t>(f.kind)];
  return nameOf(solid(a), row.a, f.a) + " on " + nameOf(solid(b), row.b, f.b);
}

}  // namespace carom

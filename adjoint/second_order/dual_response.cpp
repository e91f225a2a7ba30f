// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/flight/variation_pass.hpp"
#include "adjoint/numeric/elementary.hpp"
#include "adjoint/second_order/dual_rotation.hpp"

// In closed form (variation_pass.hpp) in dual numbers with K directions, or, where that is singular or products of
// inertia are among the directions, by the variational equations of flight_triaxial_sensitivity.cpp in the same. Directions: M at
// the start of the arc, the moments, the products of inertia. For a full symmetric A = J^-1, with B = dA of a column,
//   M' = M x w,  w = A M,   dM' = dM x w + M x (A dM + B M),   (M.eta)' = w.dM + M.B M,
// dM and M.eta as Taylor series; then eta = ((dM - lambda) x M + (M.eta) M)/|M|^2, or its own series for small turns.
// The columns are dM(0) along the three axes, the moments, the products. Values of orientations are those of the arc.

namespace carom::adjoint_detail {
namespace {

constexpr std::size_t kOrder = 20;
constexpr std::size_t kMostColumns = 9;
constexpr double kSmallTurn = 0.05;
constexpr double kMargin = 3;  // of the closed form: second derivatives lose digits sooner than first ones

template <int K>
struct Steps {
  using Number = Dual<K>;
  using Vec = V3<Number>;
  using Mat = M3<Number>;
  using Columns = Eigen::Matrix<Number, 3, Eigen::Dynamic, 0, 3, kMostColumns>;

  Steps(const Arc& the_arc, const ResponseWanted& wanted)
      : arc(the_arc),
        columns(wanted.products  ? 9
                : wanted.inertia ? 6
                                 : 3) {
    const BodyModel& model = arc.model();
    A = Mat3(model.inverse_inertia.asDiagonal()).template cast<Number>();
    largest_D = model.inverse_inertia.maxCoeff();
    for (std::size_t c = 3; c < columns; ++c) {
      Mat3 E = Mat3::Zero();
      const auto i = static_cast<Eigen::Index>(c % 3), j = (i + 1) % 3, k = (i + 2) % 3;
      if (c < 6)
        E(i, i) = 1;
      else
        E(j, k) = E(k, j) = 1;
      changes.push_back(E);
      if (static_cast<int>(c) < K) setRates(A, Mat3(-valuesOf(A) * E * valuesOf(A)), c);
    }
    for (const Mat3& E : changes) B.push_back(-A * E * A);
  }

  // Coefficients of one step from M.
  void expand(const Vec& M0) {
    M[0] = M0;
    for (std::size_t c = 0; c < columns; ++c) {
      dM[c][0] = c < 3 ? Vec(Vec3::Unit(static_cast<int>(c)).template cast<Number>()) : Vec::Zero();
      along[c][0] = 0;
    }
    for (std::size_t k = 0; k < kOrder; ++k) {
      w[k] = A * M[k];
      for (std::size_t c = 0; c < columns; ++c) {
        BM[c][k] = c < 3 ? Vec::Zero() : Vec(B[c - 3] * M[k]);
        dw[c][k] = A * dM[c][k] + BM[c][k];
      }
      if constexpr (K == 3)
        nextOfConstantMoments(k);
      else
        next(k);
    }
  }

  void next(std::size_t k) {
    const double f = 1.0 / static_cast<double>(k + 1);
    Vec sum = Vec::Zero();
    for (std::size_t j = 0; j <= k; ++j) sum += M[j].cross(w[k - j]);
    M[k + 1] = f * sum;
    for (std::size_t c = 0; c < columns; ++c) {
      Vec rate = Vec::Zero();
      Number energy = 0;
      for (std::size_t j = 0; j <= k; ++j) {
        rate += dM[c][k - j].cross(w[j]) + M[j].cross(dw[c][k - j]);
        energy += w[j].dot(dM[c][k - j]);
        if (c >= 3) energy += M[j].dot(BM[c][k - j]);
      }
      dM[c][k + 1] = f * rate;
      along[c][k + 1] = f * energy;
    }
  }

  // The same with A constant and diagonal, which leaves half of the products.
  void nextOfConstantMoments(std::size_t k) {
    const double f = 1.0 / static_cast<double>(k + 1);
    const Vec3& D = arc.model().inverse_inertia;
    const double d32 = f * (D[2] - D[1]), d13 = f * (D[0] - D[2]), d21 = f * (D[1] - D[0]);
    Number m23 = 0, m31 = 0, m12 = 0;
    for (std::size_t j = 0; j <= k; ++j) {
      const Vec &m = M[j], &n = M[k - j];
      m23 += m[1] * n[2], m31 += m[2] * n[0], m12 += m[0] * n[1];
    }
    M[k + 1] = Vec(d32 * m23, d13 * m31, d21 * m12);
    for (std::size_t c = 0; c < columns; ++c) {
      Number p23 = 0, p31 = 0, p12 = 0, energy = 0;
      for (std::size_t j = 0; j <= k; ++j) {
        const Vec &m = M[j], &v = w[j], &d = dM[c][k - j];
        p23 += m[1] * d[2] + m[2] * d[1];
        p31 += m[2] * d[0] + m[0] * d[2];
        p12 += m[0] * d[1] + m[1] * d[0];
        energy += v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
      }
      dM[c][k + 1] = Vec(d32 * p23, d13 * p31, d21 * p12);
      along[c][k + 1] = f * energy;
    }
    if (columns == 3) return;
    Mat squares;  // sum of M_i M_j
    squares << Number(0), m12, m31, m12, Number(0), m23, m31, m23, Number(0);
    for (std::size_t j = 0; j <= k; ++j)
      for (Eigen::Index i = 0; i < 3; ++i) squares(i, i) += M[j][i] * M[k - j][i];
    for (std::size_t c = 3; c < columns; ++c) {
      const Mat3 b = f * valuesOf(B[c - 3]);
      for (Eigen::Index i = 0; i < 3; ++i) {  // M x (B M) and M.(B M)
        const Eigen::Index j = (i + 1) % 3, l = (i + 2) % 3;
        for (Eigen::Index n = 0; n < 3; ++n) {
          dM[c][k + 1][i] += b(l, n) * squares(j, n) - b(j, n) * squares(l, n);
          along[c][k + 1] += b(i, n) * squares(i, n);
        }
      }
    }
  }

  // The step within which the last terms of all series, each against its natural size, are 4e-15.
  double step() const {
    const double l = valuesOf(M[0]).norm(), size_M = l > 0 ? l : 1, by_J = size_M * largest_D;
    double log_step = 700;
    for (std::size_t k : {kOrder, kOrder - 1}) {
      double share = valuesOf(M[k]).squaredNorm() / (size_M * size_M);
      for (std::size_t c = 0; c < columns; ++c) {
        const double of_column = c < 3 ? 1 : by_J;
        const auto compare = [&](double vector2, double scalar, double size) {
          share = std::max(share, (vector2 + scalar * scalar / (size_M * size_M)) / (size * size));
        };
        compare(valuesOf(dM[c][k]).squaredNorm(), along[c][k].value, of_column);
        for (std::size_t i = 0; i < K; ++i)
          compare(ratesOf(dM[c][k], i).squaredNorm(), along[c][k].rate[i],
                  of_column * (i < 3 ? 1 / size_M : largest_D));
      }
      if (share > 0) log_step = std::min(log_step, (-0.5 * elementary::log(share) - 33.2) / static_cast<double>(k));
    }
    return elementary::exp(log_step);
  }

  template <class Series>
  static auto sumOf(const Series& s, double h) {
    auto sum = s[kOrder];
    for (std::size_t k = kOrder; k-- > 0;) sum = sum * Number(h) + s[k];
    return sum;
  }

  // eta by its own series; a dozen terms leave 1e-24 of it.
  Columns smallTurn(double h) const {
    constexpr std::size_t kTerms = 12;
    Columns out(3, static_cast<Eigen::Index>(columns));
    for (std::size_t c = 0; c < columns; ++c) {
      std::array<Vec, kTerms + 1> eta;
      eta[0].setZero();
      for (std::size_t k = 0; k < kTerms; ++k) {
        Vec sum = dw[c][k];
        for (std::size_t j = 0; j <= k; ++j) sum -= w[j].cross(eta[k - j]);
        eta[k + 1] = sum / static_cast<double>(k + 1);
      }
      Vec sum = eta[kTerms];
      for (std::size_t k = kTerms; k-- > 0;) sum = sum * Number(h) + eta[k];
      out.col(static_cast<Eigen::Index>(c)) = sum;
    }
    return out;
  }

  // eta of all columns at the end of a step h; `turned`: R(h)^T R(0) of the step.
  Columns etas(const Columns& dM_end, const Mat& turned, const Vec& M_end, double h) const {
    Columns out(3, dM_end.cols());
    for (Eigen::Index c = 0; c < dM_end.cols(); ++c) {
      Vec d = dM_end.col(c);
      if (c < 3) d -= turned.col(c);
      const Number m_eta = sumOf(along[static_cast<std::size_t>(c)], h);
      out.col(c) = (d.cross(M_end) + m_eta * M_end) / M_end.squaredNorm();
    }
    return out;
  }

  // R(h)^T R(0) turns by -eta, of which the values are given, as M at the start of the step and the moments change.
  static Mat turnedOf(const Mat3& now, const Columns& eta, const Vec& M_start) {
    const Eigen::Matrix3Xd by = valuesOf(eta);
    Mat turned = now.template cast<Number>();
    for (std::size_t i = 0; i < K; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      Vec3 by_lane = by.leftCols<3>() * ratesOf(M_start, i);
      if (i >= 3 && column < by.cols()) by_lane += by.col(column);
      setRates(turned, Mat3(-skew(by_lane) * now), i);
    }
    return turned;
  }

  const Arc& arc;
  std::size_t columns;
  Mat A;
  double largest_D;
  std::vector<Mat3> changes;
  std::vector<Mat> B;
  std::array<Vec, kOrder + 1> M, w;
  std::array<std::array<Vec, kOrder + 1>, kMostColumns> dM, dw, BM;
  std::array<std::array<Number, kOrder + 1>, kMostColumns> along;
};

template <int K>
BodyResponse responseOf(const typename Steps<K>::Columns& eta, const ResponseWanted& wanted) {
  using Mat = typename Steps<K>::Mat;
  BodyResponse out;
  out.products = wanted.products;
  const auto block = [&](Eigen::Index first) { return Mat(eta.template middleCols<3>(first)); };
  const Mat G = block(0), H = wanted.inertia ? block(3) : Mat(Mat::Zero());
  const Mat P = wanted.products ? block(6) : Mat(Mat::Zero());
  out.G = valuesOf(G), out.H = valuesOf(H), out.P = valuesOf(P);
  for (std::size_t i = 0; i < K; ++i) {
    out.dG.push_back(ratesOf(G, i));
    out.dH.push_back(ratesOf(H, i));
    out.dP.push_back(ratesOf(P, i));
  }
  return out;
}

// The ends of the stretch move as its variations say.
template <int K>
RotationStretch<Dual<K>> movedStretch(const RotationStretch<double>& s) {
  const VariationPass<double> pass(s);
  RotationStretch<Dual<K>> out{s.D.cast<Dual<K>>(),       s.start.cast<Dual<K>>(),  s.end.cast<Dual<K>>(),
                               s.squares.cast<Dual<K>>(), s.turned.cast<Dual<K>>(), s.elapsed};
  const auto move = [&](std::size_t first, const Mat3& end, const Mat3& squares, const Mat3& eta) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const std::size_t lane = first + static_cast<std::size_t>(i);
      setRates(out.end, end.col(i), lane);
      setRates(out.squares, squares.col(i), lane);
      setRates(out.turned, Mat3(-skew(Vec3(eta.col(i))) * s.turned), lane);
    }
  };
  move(0, pass.momentumByStart(), pass.squaresByStart(), pass.turnByStart());
  setRates(out.start, Vec3::UnitX(), 0), setRates(out.start, Vec3::UnitY(), 1), setRates(out.start, Vec3::UnitZ(), 2);
  if constexpr (K >= 6) {
    const Mat3 by_I = -Mat3(s.D.cwiseAbs2().asDiagonal());
    move(3, pass.momentumByD() * by_I, pass.squaresByD() * by_I, pass.turnByInertia());
    for (Eigen::Index i = 0; i < 3; ++i) out.D[i].rate[static_cast<std::size_t>(3 + i)] = by_I(i, i);
  }
  return out;
}

template <int K>
BodyResponse closedResponse(const RotationStretch<double>& stretch, const ResponseWanted& wanted) {
  const VariationPass<Dual<K>> pass(movedStretch<K>(stretch));
  typename Steps<K>::Columns eta(3, wanted.products ? 9 : wanted.inertia ? 6 : 3);
  eta.template leftCols<3>() = pass.turnByStart();
  if (wanted.inertia) eta.template middleCols<3>(3) = pass.turnByInertia();
  if (wanted.products) eta.template middleCols<3>(6) = pass.turnByProducts();
  return responseOf<K>(eta, wanted);
}

template <int K>
BodyResponse respond(const Arc& arc, double elapsed, const ResponseWanted& wanted) {
  using S = Steps<K>;
  using Vec = typename S::Vec;
  using Mat = typename S::Mat;
  using Columns = typename S::Columns;
  const auto steps_owner = std::make_unique<S>(arc, wanted);
  S& steps = *steps_owner;
  const auto count = static_cast<Eigen::Index>(steps.columns);
  const Vec3 L = arc.startState().L;
  const auto orientation = [&](double s) { return arc.stateAt(arc.start() + s).q.toRotationMatrix(); };

  Mat3 R = orientation(0);
  Vec M = Vec3(R.transpose() * L).cast<Dual<K>>();
  for (std::size_t i = 0; i < 3; ++i) M[static_cast<Eigen::Index>(i)].rate[i] = 1;
  // (dM, eta) so far by the columns
  Columns dM = Columns::Zero(3, count), eta = Columns::Zero(3, count);
  for (Eigen::Index c = 0; c < 3; ++c) dM(c, c) = 1;
  std::size_t made = 0;
  for (double done = 0; done < elapsed;) {
    steps.expand(M);
    const double h = std::min(elapsed - done, steps.step());
    const bool last = !(done + h < elapsed);
    const Mat3 R_end = orientation(last ? elapsed : done + h), turned_now = R_end.transpose() * R;
    const Vec3 M_end_now = R_end.transpose() * L;
    Vec M_end = S::sumOf(steps.M, h);
    for (Eigen::Index i = 0; i < 3; ++i) M_end[i].value = M_end_now[i];
    Columns dM_step(3, count), eta_step;
    for (Eigen::Index c = 0; c < count; ++c) dM_step.col(c) = S::sumOf(steps.dM[static_cast<std::size_t>(c)], h);
    const bool small = M_end_now.norm() * steps.largest_D * h < kSmallTurn;
    if (small) eta_step = steps.smallTurn(h);
    const Columns eta_now = small ? eta_step : steps.etas(dM_step, turned_now.template cast<Dual<K>>(), M_end, h);
    const Mat turned = steps.turnedOf(turned_now, eta_now, M);
    if (!small) eta_step = steps.etas(dM_step, turned, M_end, h);
    const Mat G = eta_step.template leftCols<3>(), Phi = dM_step.template leftCols<3>();
    Columns next_eta = turned * eta + G * dM, next_dM = Phi * dM;
    next_eta.rightCols(count - 3) += eta_step.rightCols(count - 3);
    next_dM.rightCols(count - 3) += dM_step.rightCols(count - 3);
    eta = next_eta, dM = next_dM;
    M = M_end, R = R_end;
    if (!last && (++made == TriaxialRotation::kMostSegments || !(done + h > done)))
      throw NotComputable("the second derivative of a rotation takes more than " +
                          std::to_string(TriaxialRotation::kMostSegments) + " Taylor series");
    done = last ? elapsed : done + h;
  }
  return responseOf<K>(eta, wanted);
}

}  // namespace

BodyResponse bodyResponse(const Arc& arc, double elapsed, const ResponseWanted& wanted) {
  if (wanted.lanes == 9) return respond<9>(arc, elapsed, wanted);
  TriaxialRotation rotation;
  rotation.begin(arc.model().inverse_inertia, arc.startState().q, arc.startState().L);
  rotation.extendTo(elapsed);
  if (const auto stretch = rotation.stretchOver(elapsed, kMargin))
    return wanted.lanes == 6 ? closedResponse<6>(*stretch, wanted) : closedResponse<3>(*stretch, wanted);
  if (wanted.lanes == 6) return respond<6>(arc, elapsed, wanted);
  return respond<3>(arc, elapsed, wanted);
}

}  // namespace carom::adjoint_detail

// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_force_rates.hpp"

namespace carom::adjoint_detail {
namespace {

/// What forces do to a body, by their sum and their moment.
struct Answer {
  using Number = ConstrainedLanes::Number;
  V3<Number> acceleration, spin_rate;

  V3<Number> at(const V3<Number>& r) const { return acceleration + spin_rate.cross(r); }
};

void addRates(V3<ConstrainedLanes::Number>& x, const Vec3& rate, std::size_t lane) {
  for (int i = 0; i < 3; ++i) x[i].rate[lane] += rate[i];
}

}  // namespace

ConstrainedForceRates::ConstrainedForceRates(const ConstrainedInstant& now, bool redundant)
    : now_(now), dynamics_(now.body, now.contacts, redundant, &inverse_), redundant_(redundant) {
  if (!redundant_ || dynamics_.solution().size() == 0) return;
  const Eigen::MatrixXd& B = dynamics_.matrix();
  without_effect_ = Eigen::MatrixXd::Identity(B.rows(), B.rows()) - inverse_ * B;
  weights_ = inverse_.transpose() * dynamics_.solution();
}

ForceLanes ConstrainedForceRates::in(const ConstrainedLanes& lanes) const {
  const std::size_t n = lanes.contacts.size();
  ForceLanes out{std::vector<V3<Number>>(n), lanes.body.gravity, V3<Number>::Zero()};
  for (std::size_t k = 0; k < n; ++k) {
    const ContactInstant<Number>& c = lanes.contacts[k];
    out.forces[k] = dynamics_.force(k).cast<Number>();
    if (c.mode == ContactMode::slides) out.forces[k] = c.push() * dynamics_.solution()[dynamics_.unknown(k)];
    out.acceleration += out.forces[k] * lanes.body.inverse_mass;
    out.moment += c.r.cross(out.forces[k]);
  }
  if (n == 0) return out;
  Rates dy = -inverse_ * rowRates(lanes, out);
  if (redundant_) dy += without_effect_ * leastNormRates(lanes);
  for (std::size_t k = 0; k < n; ++k) {
    const ContactInstant<double>& c = now_.contacts[k];
    const Eigen::Index row = dynamics_.unknown(k);
    const Vec3 push = c.push();
    for (Eigen::Index lane = 0; lane < dy.cols(); ++lane) {
      const Vec3 df = c.mode == ContactMode::sticks ? Vec3(dy.block<3, 1>(row, lane)) : Vec3(push * dy(row, lane));
      const auto at = static_cast<std::size_t>(lane);
      addRates(out.forces[k], df, at);
      addRates(out.acceleration, df * now_.body.inverse_mass, at);
      addRates(out.moment, c.r.cross(df), at);
    }
  }
  return out;
}

// db + dB y: of the accelerations that the constraints keep at 0, under forces that are kept.
ConstrainedForceRates::Rates ConstrainedForceRates::rowRates(const ConstrainedLanes& lanes, const ForceLanes& kept) const {
  const BodyInstant<Number>& body = lanes.body;
  const Answer answer{kept.acceleration, body.A * V3<Number>(kept.moment - body.omega.cross(body.L))};
  Rates rates(dynamics_.solution().size(), ConstrainedLanes::kColumns);
  for (std::size_t k = 0; k < lanes.contacts.size(); ++k) {
    const ContactInstant<Number>& c = lanes.contacts[k];
    const V3<Number> slip_rate = answer.at(c.r) + body.omega.cross(V3<Number>(c.point_rate - body.v)) - c.support_acceleration;
    const Eigen::Index row = dynamics_.unknown(k);
    if (c.mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) takeRates(rates, row + i, slip_rate[i]);
    } else {
      takeRates(rates, row, c.n.dot(slip_rate) + c.normal_rate.dot(body.relativeVelocity(c)));
    }
  }
  return rates;
}

// dB^T w, with w = B^+^T y kept: how forces w along the constraints would move the body along the pushes of the contacts.
ConstrainedForceRates::Rates ConstrainedForceRates::leastNormRates(const ConstrainedLanes& lanes) const {
  V3<Number> sum = V3<Number>::Zero(), moment = V3<Number>::Zero();
  for (std::size_t k = 0; k < lanes.contacts.size(); ++k) {
    const ContactInstant<Number>& c = lanes.contacts[k];
    const Eigen::Index row = dynamics_.unknown(k);
    const V3<Number> along = c.mode == ContactMode::sticks ? V3<Number>(Vec3(weights_.segment<3>(row)).cast<Number>())
                                                        : V3<Number>(c.n * weights_[row]);
    sum += along, moment += c.r.cross(along);
  }
  const Answer answer{sum * lanes.body.inverse_mass, lanes.body.A * moment};
  Rates rates(weights_.size(), ConstrainedLanes::kColumns);
  for (std::size_t k = 0; k < lanes.contacts.size(); ++k) {
    const ContactInstant<Number>& c = lanes.contacts[k];
    const V3<Number> moved = answer.at(c.r);
    const Eigen::Index row = dynamics_.unknown(k);
    if (c.mode == ContactMode::sticks) {
      for (int i = 0; i < 3; ++i) takeRates(rates, row + i, moved[i]);
    } else {
      takeRates(rates, row, c.push().dot(moved));
    }
  }
  return rates;
}

}  // namespace carom::adjoint_detail

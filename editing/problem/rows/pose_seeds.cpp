// SPDX-License-Identifier: MIT
#include "editing/problem/rows/pose_seeds.hpp"

#include "adjoint/derivative/seed.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

StateSeed seedOfPose(int body, const Instant& at, const Eigen::Matrix<double, 1, 6>& by_pose,
                     const Eigen::VectorXd& by_size) {
  StateSeed seed;
  seed.body = body;
  seed.at = at;
  seed.center_of_mass = by_pose.head<3>().transpose();
  seed.orientation = by_pose.tail<3>().transpose();
  seed.size = by_size;
  return seed;
}

}  // namespace

Pose shapePoseAt(const Motion& motion, int body, const Instant& at) {
  return shapePose(motion, body, readPlace(motion, body, at).state);
}

std::vector<StateSeed> seedsOfPair(const ContactJacobian& J, int row, int a, int b, const Instant& at) {
  return {seedOfPose(a, at, J.pose.row(row).head<6>(), J.size_a.row(row).transpose()),
          seedOfPose(b, at, J.pose.row(row).tail<6>(), J.size_b.row(row).transpose())};
}

PairTangent tangentOfPair(const BodyStateRate& of_a, const BodyStateRate& of_b) {
  PairTangent rate;
  rate.pose << of_a.center_of_mass, of_a.orientation, of_b.center_of_mass, of_b.orientation;
  rate.size_a = of_a.size, rate.size_b = of_b.size;
  return rate;
}

}  // namespace carom::editing_detail

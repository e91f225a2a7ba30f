// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_program.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/contact/cone_program.hpp"
#include "adjoint/contact/cone_terms.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr int kPrograms = 40;

// The answer u' = K f + b of the places of all contacts, d^2(gap)/dt^2 along their normals.
ConeProgramOf<double> programOf(const BodyInstant<double>& body, std::vector<ContactInstant<double>> contacts) {
  for (ContactInstant<double>& c : contacts) c.mode = ContactMode::sticks;
  const ConstrainedDynamics all(body, contacts, true);
  ConeProgramOf<double> program;
  program.K = all.matrix(), program.b = all.withoutForces();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactInstant<double>& c = contacts[k];
    program.normal.push_back(c.n), program.friction.push_back(c.friction);
    program.b.segment<3>(all.unknown(k)) += c.normal_rate.dot(body.relativeVelocity(c)) * c.n;
  }
  program.offset.assign(contacts.size(), 0.0), program.free.assign(contacts.size(), 0);
  return program;
}

}  // namespace

bool modesByProgram(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts,
                    const std::function<bool(const ProgramModes&)>& takes) {
  const ConeProgramOf<double> unshifted = programOf(body, contacts);
  ConeProgramOf<double> program = unshifted;
  for (int i = 0; i < kPrograms; ++i) {
    ConePointOf<double> at;
    try {
      at = solveConeProgram(program);
    } catch (const NotComputable&) {
      return false;
    }
    ProgramModes modes{at.state, {}};
    for (const Vec3& friction : at.direction) modes.direction.push_back(-friction);
    if (takes(modes)) return true;
    const ConeTerms<double> terms(program, at);
    program.b = unshifted.b;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto row = 3 * static_cast<Eigen::Index>(k);
      const Vec3 &n = contacts[k].n, moved = terms.V.segment<3>(row);
      program.b.segment<3>(row) += contacts[k].friction * (moved - n.dot(moved) * n).norm() * n;
    }
  }
  return false;
}

}  // namespace carom::adjoint_detail

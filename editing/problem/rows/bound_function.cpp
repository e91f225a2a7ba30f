// SPDX-License-Identifier: MIT
#include "editing/problem/rows/bound_function.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "adjoint/derivative/derivative_arguments.hpp"
#include "editing/detail/messages.hpp"
#include "editing/detail/thrown_by_user.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/instants.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

void check(const RowReading& reading, const Motion& motion, const std::string& where) {
  if (!std::isfinite(reading.value))
    throw InputError(where, "found the value " + number(reading.value) +
                                ", expected a finite number, or the reason in `missing`");
  if (reading.seeds.empty() && reading.doubt.empty())
    throw InputError(where, "found no seeds, expected the derivative, or the reason in `doubt`");
  for (const StateSeed& seed : reading.seeds) checkSeed(where.c_str(), motion, seed);
}

/// Whose count is checked, and whose exceptions are those of the caller.
SeedRates checkedRates(SeedRates rates, std::size_t count, const std::string& where) {
  return [rates = std::move(rates), count, where](std::span<const BodyStateRate> of_states) {
    return guarded([&] {
      std::vector<StateSeed> out = rates(of_states);
      if (out.size() != count)
        throw InputError(where, "found rates of " + std::to_string(out.size()) + " seeds, expected " +
                                    std::to_string(count));
      return out;
    });
  };
}

}  // namespace

BoundFunction::BoundFunction(const Scene& scene, const MotionFunction& f, double duration, std::string place)
    : function(f), where(std::move(place)), end(duration) {
  if (f.name.empty()) throw InputError(where, "found no name, expected one for messages");
  where += " '" + f.name + "'";
  if (!f.read) throw InputError(where, "found no function, expected one of the motion");
  if (!(f.scale > 0 && std::isfinite(f.scale)))
    throw InputError(where + "/scale", "found " + number(f.scale) + ", expected a number > 0");
  if (!f.until) return;
  checkWhen(*f.until, where + "/until");
  if (f.until->span) throw InputError(where + "/until", "found a span, expected a time, an impact or rest");
  if (f.until->isTime()) {
    if (!f.body.empty()) throw InputError(where + "/body", "found '" + f.body + "' beside a time, expected none");
    if (!(f.until->time <= duration))
      throw InputError(where + "/until", "found " + number(f.until->time) + ", expected a time in [0, " +
                                             number(duration) + "], the duration of the edit");
    end = f.until->time;
    return;
  }
  body = findAt(where + "/body", [&] { return bodyIndex(scene, f.body); });
  if (f.until->rest) checkComesToRest(scene.bodies[static_cast<std::size_t>(body)], where + "/body");
  if (!f.until->with.empty())
    with = findAt(where + "/until/with", [&] { return bodyIndex(scene, f.until->with); });
}

std::optional<Instant> BoundFunction::awaited(const Motion& motion) const {
  return findInstant(motion, body, *function.until, with);
}

double BoundFunction::extentIn(const Motion& motion) const {
  if (!waits()) return std::min(end, motion.end);
  const std::optional<Instant> instant = awaited(motion);
  return instant ? timeOf(motion, *instant) : 0;
}

RowReading BoundFunction::read(const Motion& motion) const {
  RowReading reading;
  if (waits() && !awaited(motion)) {
    reading.missing = describeLack(*function.until, function.body) + " within " + number(motion.end) + " s; '" +
                      function.name + "' is read after it.";
  } else if (!waits() && !(motion.end >= end)) {
    reading.missing = "The motion ends at " + number(motion.end) + " s, before " + number(end) + " s, up to which '" +
                      function.name + "' reads it.";
    if (motion.status != MotionStatus::complete) reading.missing += " " + motion.message;
  }
  if (!reading.missing.empty()) return reading;
  reading = guarded([&] {
    RowReading read = function.read(motion);
    if (read.missing.empty()) check(read, motion, where);
    return read;
  });
  if (reading.seed_rates)
    reading.seed_rates = checkedRates(std::move(reading.seed_rates), reading.seeds.size(), where);
  return reading;
}

}  // namespace carom::editing_detail

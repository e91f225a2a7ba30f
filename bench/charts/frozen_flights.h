// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"
#include "bench/charts/error.h"
#include "bench/charts/flight_models.h"

namespace carom::charts {

/// The motion `like` once more, along its impact sequence (like adjoint/simulate/simulate_along.h: nothing is searched
/// for), with the rotation of all flights carried by `model` in steps of `step`. Impacts are where the gap comes to
/// zero on these flights. States of all bodies at the end. Only for impacts of one contact each.
States endByModel(const Motion& like, const FlightModel& model, double step);

}  // namespace carom::charts

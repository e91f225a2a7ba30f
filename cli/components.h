// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/answers/info_json.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::cli {

/// Bodies that the scene starts at rest on each other, and why they rest; where such bodies end the motion at once, why.
std::vector<formats_detail::ScenePlan::Component> componentsAtStart(const Scene& scene, OdeContacts& contacts);

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
// Apart from info.cpp: a source with definitions of its own is not compiled together with others.
#include "cli/build_facts.h"

namespace carom::cli {

BuildFacts buildFacts() { return {CAROM_BUILD_TYPE, CAROM_COMPILER, CAROM_ODE_VERSION, CAROM_IPOPT_VERSION}; }

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#include "formats/mesh/obj_reader.hpp"

#include "fuzz/require.h"
#include "fuzz/surfaces.h"
#include "fuzz/targets.h"

namespace carom::fuzz {

using namespace formats_detail;

void readObj(std::string_view bytes) {
  TriangleSoup soup;
  try {
    soup = parseObj(bytes);
  } catch (const InputError& error) {
    requireMessage(error);
    return;
  }
  requireSurfaces(soup);
}

}  // namespace carom::fuzz

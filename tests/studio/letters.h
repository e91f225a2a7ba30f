// SPDX-License-Identifier: MIT
#pragma once

#include "studio/mailbox.h"

namespace carom::studio {

/// A drag of gesture 1, with seq + 100 as its id.
inline Letter drag(SocketId from, std::int64_t seq) {
  Drag drag;
  drag.gesture = 1, drag.seq = seq;
  return {from, {seq + 100, drag}};
}

}  // namespace carom::studio

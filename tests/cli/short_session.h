// SPDX-License-Identifier: MIT
#pragma once

#include "editing/session.h"
#include "formats/documents/journal_json.h"

namespace carom::test {

/// A ball that bounces on a floor is dragged once.
SessionJournal shortSession();
/// With what windows over sessions do: goals met together, a hand that rests, nails that are dragged, other content.
SessionJournal studioSession();

}  // namespace carom::test

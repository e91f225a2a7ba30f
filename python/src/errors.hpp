// SPDX-License-Identifier: MIT
#pragma once

namespace carom::python {

/// From here on InputError, FormatError and NotComputable of the library are raised as those of carom/errors.py.
void registerErrors();

}  // namespace carom::python

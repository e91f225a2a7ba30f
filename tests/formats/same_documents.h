// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/base/document.h"

namespace carom::formats_test {

// Bit for bit, but for the entries of an inertia matrix (15 digits).
void expectSameScene(const Scene& a, const Scene& b);
void expectSameEdit(const Document& a, const Document& b);

/// Writes the document, reads it again: the same document, and the same text.
void expectRoundTrip(const Document& document, const std::string& name);

}  // namespace carom::formats_test

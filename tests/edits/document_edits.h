// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/edit.h"
#include "formats/base/document.h"

namespace carom::test {

/// A document of tests/edits/documents.
Document editDocument(const std::string& name);

/// Its edit as it is, or with `options`.
EditResult solveDocument(const Document& document, const EditOptions& options = {});

/// CPU time of this process, s: what an edit takes on all cores together.
double cpuSeconds();

}  // namespace carom::test

// SPDX-License-Identifier: MIT
#include "tests/edits/document_edits.h"

#include <ctime>

#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::test {

Document editDocument(const std::string& name) {
  return readDocument(projectFile("tests/edits/documents/" + name + ".json"));
}

EditResult solveDocument(const Document& document, const EditOptions& options) {
  OdeContacts contacts(document.scene);
  return Edit(document.scene, contacts, document.duration, document.controls, document.constraints).solve(options);
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace carom::test

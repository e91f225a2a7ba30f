// SPDX-License-Identifier: MIT
// Files of other programs.
#include "studio/imports.h"
#include "studio/refusal.h"
#include "studio/worker.h"

namespace carom::studio {

void Worker::perform(const Asker& asker, const Upload& upload) {
  UploadedFile& file = uploads_[asker.socket];
  try {
    addPart(file, upload);
  } catch (const InputError&) {
    uploads_.erase(asker.socket);
    throw;
  }
  tabs_.tell(asker.socket, answering(asker.id, uploadedMessage(file.bytes.size())));
}

/// What is open stays until the imported scene is there, simulated and all.
void Worker::perform(const Asker& asker, const Import& import) {
  if (scene_) sessionFor(asker);
  requireNoHold();
  std::optional<UploadedFile> uploaded;
  const auto sent = uploads_.find(asker.socket);
  if (import.path.empty()) {
    if (sent == uploads_.end()) throw InputError("/path", "found no file, expected one of the folder, or one that was uploaded");
    uploaded = sent->second;
  }
  const std::string& name = uploaded ? uploaded->name : import.path;
  const bool mesh = name.ends_with(".obj") || name.ends_with(".OBJ");
  if (!mesh && scene_ && scene_->isChanged() && !import.replace) throw FileConflict("the open scene has unsaved changes");
  tabs_.tell(asker.socket, answering(asker.id, progressMessage("importing " + name)));
  const ImportedFile imported = importFile(workspace_, import, uploaded);
  if (!imported.mesh) {
    try {
      show(workspace_.open(imported.path), imported.path, imported.path);
    } catch (const std::exception&) {
      removeImported(workspace_, imported);
      throw;
    }
  }
  uploads_.erase(asker.socket);
  tabs_.tell(asker.socket, answering(asker.id, importedMessage(imported)));
  if (imported.mesh) return;
  sayAll(asker);
  sayKeptProblem();
}

}  // namespace carom::studio

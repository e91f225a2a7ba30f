// SPDX-License-Identifier: MIT
#include "formats/answers/status_json.hpp"

#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

namespace {

/// A document of these members alone.
template <class... Members>
std::string documentOf(const Members&... members) {
  JsonWriter out;
  out.beginObject().members(members...).endObject();
  return out.take();
}

}  // namespace

void writeRepairs(JsonWriter& out, const Document& document) {
  out.objects("repairs", document.repairs, JsonWriter::Layout::line,
              [&](const FileRepair& repair) { out.members("file", repair.file, "what", repair.what); });
}

std::string errorJson(const std::string& message, const std::string& file, const std::string& pointer) {
  JsonWriter out;
  out.beginObject().key("error").beginObject();
  out.members("message", message, "file", file, "pointer", pointer).endObject().endObject();
  return out.take();
}

std::string validateJson(const std::string& file, const Document& document, const std::string& message) {
  JsonWriter out;
  out.beginObject().members("valid", true, "file", file, "bodies", document.scene.bodies.size(), "controls",
                            document.controls.size(), "constraints", document.constraints.size());
  writeRepairs(out, document);
  out.members("message", message).endObject();
  return out.take();
}

std::string exportJson(const std::string& file, std::size_t bytes, const Motion& motion) {
  return documentOf("file", file, "bytes", bytes, "status", nameOf(motion.status), "message", motion.message, "end",
                    motion.end);
}

std::string importJson(const std::string& file, const Imported& imported, const std::vector<std::string>& meshes) {
  const Document& document = imported.document;
  const ImportReport& report = imported.report;
  return documentOf("file", file, "bodies", document.scene.bodies.size(), "materials", document.scene.materials.size(),
                    "controls", document.controls.size(), "constraints", document.constraints.size(), "meshes", meshes,
                    "joints", report.joints, "triggers", report.triggers, "warnings", report.warnings);
}

std::string programJson(const ProgramInfo& info) {
  JsonWriter out;
  out.beginObject().members("version", info.version, "build", info.build, "compiler", info.compiler);
  out.objects("libraries", info.libraries, JsonWriter::Layout::line, [&](const ProgramInfo::Library& library) {
    out.members("name", library.name, "version", library.version);
  });
  out.members("scene_format", info.scene_format, "exports", info.exports).endObject();
  return out.take();
}

}  // namespace carom::formats_detail

// SPDX-License-Identifier: MIT
#include "formats/answers/status_json.h"

#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

using Layout = JsonWriter::Layout;

std::string errorJson(const std::string& message, const std::string& file, const std::string& pointer) {
  JsonWriter out;
  out.beginObject().key("error").beginObject();
  out.key("message").text(message);
  out.key("file").text(file);
  out.key("pointer").text(pointer);
  out.endObject().endObject();
  return out.take();
}

std::string validateJson(const std::string& file, const Document& document, const std::string& message) {
  JsonWriter out;
  out.beginObject();
  out.key("valid").boolean(true);
  out.key("file").text(file);
  out.key("bodies").integer(static_cast<long long>(document.scene.bodies.size()));
  out.key("controls").integer(static_cast<long long>(document.controls.size()));
  out.key("constraints").integer(static_cast<long long>(document.constraints.size()));
  out.key("message").text(message);
  out.endObject();
  return out.take();
}

std::string exportJson(const std::string& file, std::size_t bytes, const Motion& motion) {
  JsonWriter out;
  out.beginObject();
  out.key("file").text(file);
  out.key("bytes").integer(static_cast<long long>(bytes));
  out.key("status").text(nameOf(motion.status));
  out.key("message").text(motion.message);
  out.key("end").number(motion.end);
  out.endObject();
  return out.take();
}

std::string importJson(const std::string& file, const Imported& imported, const std::vector<std::string>& meshes) {
  const Document& document = imported.document;
  JsonWriter out;
  out.beginObject();
  out.key("file").text(file);
  out.key("bodies").integer(static_cast<long long>(document.scene.bodies.size()));
  out.key("materials").integer(static_cast<long long>(document.scene.materials.size()));
  out.key("controls").integer(static_cast<long long>(document.controls.size()));
  out.key("constraints").integer(static_cast<long long>(document.constraints.size()));
  out.key("meshes").texts(meshes);
  out.key("joints").texts(imported.report.joints);
  out.key("triggers").texts(imported.report.triggers);
  out.key("warnings").texts(imported.report.warnings);
  out.endObject();
  return out.take();
}

std::string programJson(const ProgramInfo& info) {
  JsonWriter out;
  out.beginObject();
  out.key("version").text(info.version);
  out.key("build").text(info.build);
  out.key("compiler").text(info.compiler);
  out.key("libraries").beginArray();
  for (const ProgramInfo::Library& library : info.libraries) {
    out.beginObject(Layout::line);
    out.key("name").text(library.name);
    out.key("version").text(library.version);
    out.endObject();
  }
  out.endArray();
  out.key("scene_format").integer(info.scene_format);
  out.key("exports").texts(info.exports);
  out.endObject();
  return out.take();
}

}  // namespace carom

#include "formats/scene_json.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "formats/detail/json.hpp"
#include "formats/detail/scene_reader.hpp"
#include "formats/write_file.h"

namespace carom {
namespace {

using detail::Json;

/// First of all: a document of another version may break every other rule.
void requireVersion(const Json& document) {
  if (!document.is_object()) detail::fail("", detail::describe(document), "an object that begins with \"carom\": 1");
  const auto version = document.find("carom");
  if (version == document.end()) detail::fail("", "no member \"carom\"", "\"carom\": 1, the version of the format");
  if (*version != 1)
    detail::fail("/carom", detail::describe(*version), "1, the version of the format that this program reads");
}

std::string tooLarge(const std::string& found) {
  return "found " + found + ", expected at most " + std::to_string(kLargestDocument) + " bytes";
}

std::string readText(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw FormatError(path, "", "found no such file, expected a scene document");
  if (std::filesystem::is_directory(status)) throw FormatError(path, "", "found a folder, expected a file");
  if (std::filesystem::is_regular_file(status)) {
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size > kLargestDocument)
      throw FormatError(path, "", tooLarge("a file of " + std::to_string(size) + " bytes"));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FormatError(path, "", "found a file that cannot be opened, expected one that may be read");
  // A pipe has no size before it is read.
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > kLargestDocument) throw FormatError(path, "", tooLarge("more"));
  }
  return text;
}

}  // namespace

Document parseDocument(std::string_view text, const std::string& name) try {
  if (text.size() > kLargestDocument) throw InputError(tooLarge("a text of " + std::to_string(text.size()) + " bytes"));
  const Json json = detail::parseJson(text);
  requireVersion(json);
  detail::requireSchema(json);
  Document document;
  document.scene = detail::readScene(json);
  validate(document.scene);
  if (const auto duration = json.find("duration"); duration != json.end()) document.duration = duration->get<double>();
  document.controls = detail::readControls(json, document.scene);
  document.constraints = detail::readConstraints(json, document.scene, document.duration);
  return document;
} catch (const InputError& error) {
  throw FormatError(name, error.where(), error.message());
}

Document readDocument(const std::string& path) { return parseDocument(readText(path), path); }

void saveDocument(const std::string& path, const Document& document) try {
  const std::string text = writeDocument(document);
  parseDocument(text, path);
  writeFile(path, text);
} catch (const FormatError&) {
  throw;
} catch (const InputError& error) {
  throw FormatError(path, error.where() == path ? "" : error.where(), error.message());
}

}  // namespace carom

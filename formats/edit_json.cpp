#include "formats/edit_json.h"

#include "formats/json_writer.h"

namespace carom {
namespace {

using Layout = JsonWriter::Layout;

void writeChanged(JsonWriter& out, const std::vector<ChangedNumber>& changed) {
  out.key("changed").beginArray();
  for (const ChangedNumber& number : changed) {
    out.beginObject(Layout::line);
    out.key("control").integer(number.control);
    out.key("component").text(number.component);
    out.key("name").text(number.name);
    out.key("before").number(number.before);
    out.key("after").number(number.after);
    out.endObject();
  }
  out.endArray();
}

void writeResiduals(JsonWriter& out, const std::vector<HeldNumber>& residuals) {
  out.key("residuals").beginArray();
  for (const HeldNumber& number : residuals) {
    out.beginObject(Layout::line);
    out.key("constraint").integer(number.constraint);
    out.key("component").text(number.component);
    out.key("name").text(number.name);
    out.key("value").number(number.value);
    out.key("target").number(number.target);
    out.key("error").number(number.error);
    out.key("scaled_error").number(number.scaled_error);
    out.endObject();
  }
  out.endArray();
}

void writeLines(JsonWriter& out, const char* name, const std::vector<std::string>& lines) {
  out.key(name).beginArray();
  for (const std::string& line : lines) out.text(line);
  out.endArray();
}

void writeSequenceChanges(JsonWriter& out, const std::vector<SequenceChange>& changes) {
  const auto event = [&](int index) { index < 0 ? out.null() : out.integer(index); };
  out.key("sequence_changes").beginArray();
  for (const SequenceChange& change : changes) {
    out.beginObject(Layout::line);
    out.key("kind").text(nameOf(change.kind));
    out.key("before");
    event(change.before);
    out.key("after");
    event(change.after);
    out.key("sentence").text(change.sentence);
    out.endObject();
  }
  out.endArray();
}

void writeOutput(JsonWriter& out, const std::vector<std::string>& outputs, std::size_t index) {
  out.key("output");
  index < outputs.size() && !outputs[index].empty() ? out.text(outputs[index]) : out.null();
}

void writeAlternatives(JsonWriter& out, const EditResult& result, const std::vector<std::string>& outputs) {
  out.key("alternatives").beginArray();
  for (std::size_t i = 0; i < result.alternatives.size(); ++i) {
    const EditAlternative& other = result.alternatives[i];
    out.beginObject();
    out.key("objective").number(other.objective);
    out.key("residual").number(other.residual);
    out.key("scaled_residual").number(other.scaled_residual);
    writeChanged(out, other.changed);
    writeLines(out, "sequence", other.sequence);
    writeSequenceChanges(out, other.sequence_changes);
    writeOutput(out, outputs, i + 1);
    out.endObject();
  }
  out.endArray();
}

}  // namespace

std::string editJson(const EditResult& result, const std::vector<std::string>& outputs) {
  JsonWriter out;
  out.beginObject();
  out.key("status").text(nameOf(result.status));
  out.key("message").text(result.message);
  writeChanged(out, result.changed);
  writeResiduals(out, result.residuals);
  out.key("residual").number(result.residual);
  out.key("scaled_residual").number(result.scaled_residual);
  out.key("objective").number(result.objective);
  out.key("iterations").integer(result.iterations);
  out.key("milliseconds").number(result.milliseconds);
  writeLines(out, "sequence_before", result.sequence_before);
  writeLines(out, "sequence_after", result.sequence_after);
  out.key("signature_changed").boolean(result.signature_changed);
  writeSequenceChanges(out, result.sequence_changes);
  out.key("reliable").boolean(result.reliability.reliable);
  writeOutput(out, outputs, 0);
  writeAlternatives(out, result, outputs);
  out.endObject();
  return out.take();
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "formats/answers/edit_json.h"

#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

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
    if (!(number.lower == number.upper)) out.key("min").number(number.lower).key("max").number(number.upper);
    out.key("error").number(number.error);
    out.key("scaled_error").number(number.scaled_error);
    out.endObject();
  }
  out.endArray();
}

void writeTimes(JsonWriter& out, const std::vector<MetTime>& times) {
  out.key("times").beginArray();
  for (const MetTime& met : times) {
    out.beginObject(Layout::line);
    out.key("constraint").integer(met.constraint);
    out.key("name").text(met.name);
    out.key("from").number(met.from);
    out.key("to").number(met.to);
    out.key("time").number(met.time);
    out.endObject();
  }
  out.endArray();
}

void writeCertificate(JsonWriter& out, const Certificate& certificate) {
  out.key("certificate");
  if (!certificate.taken) {
    out.null();
    return;
  }
  out.beginObject();
  out.key("residual").number(certificate.residual);
  out.key("scaled_residual").number(certificate.scaled_residual);
  out.key("energy_drift").number(certificate.energy_drift);
  out.key("energy_gain").number(certificate.energy_gain);
  out.key("deepest_penetration");
  certificate.deepest_penetration ? out.number(*certificate.deepest_penetration) : out.null();
  out.key("reliable").boolean(certificate.reliability.reliable);
  out.key("events").integer(certificate.reliability.events);
  out.key("smallest_margin").number(certificate.reliability.smallest_margin);
  out.key("signature_radius").number(certificate.signature_radius);
  out.key("signature_event").text(certificate.signature_event);
  out.endObject();
}

void writeConflicts(JsonWriter& out, const WhyNot& why) {
  out.key("conflicts").beginArray();
  for (const WhyNot::Conflict& conflict : why.conflicts) {
    out.beginObject(Layout::line);
    out.key("residuals").beginArray();
    for (const int row : conflict.rows) out.integer(row);
    out.endArray();
    out.key("names").texts(conflict.names);
    out.endObject();
  }
  out.endArray();
  out.key("inside").beginArray();
  for (const WhyNot::Inside& inside : why.inside) {
    out.beginObject(Layout::line);
    out.key("constraint").integer(inside.constraint);
    out.key("name").text(inside.name);
    out.key("body").text(inside.solid);
    out.endObject();
  }
  out.endArray();
}

void writeBounds(JsonWriter& out, const WhyNot& why) {
  out.key("at_bounds").beginArray();
  for (const WhyNot::AtBound& at : why.at_bounds) {
    out.beginObject(Layout::line);
    out.key("control").integer(at.control);
    out.key("name").text(at.name);
    out.key("side").text(at.upper ? "max" : "min");
    out.key("bound").number(at.bound);
    out.key("removes").number(at.removes);
    out.key("change").number(at.change);
    out.endObject();
  }
  out.endArray();
}

void writeHelp(JsonWriter& out, const WhyNot& why) {
  out.key("would_help").beginArray();
  for (const WhyNot::Help& help : why.would_help) {
    out.beginObject(Layout::line);
    out.key("name").text(help.name);
    out.key("vary").text(help.control.vary);
    if (!help.control.body.empty()) out.key("body").text(help.control.body);
    if (!help.control.material.empty()) out.key("material").text(help.control.material);
    if (help.control.vary == "tilt") out.key("impact").integer(help.control.impact);
    if (!help.control.components.empty()) out.key("components").texts(help.control.components);
    out.key("removes").number(help.removes);
    out.key("change").number(help.change);
    out.key("restores_rank").boolean(help.restores_rank);
    out.key("solves");
    help.tried ? out.boolean(help.solves) : out.null();
    out.endObject();
  }
  out.endArray();
}

void writeWhyNot(JsonWriter& out, const WhyNot& why) {
  out.key("why_not");
  if (why.sentences.empty()) {
    out.null();
    return;
  }
  out.beginObject();
  writeConflicts(out, why);
  writeBounds(out, why);
  writeHelp(out, why);
  out.key("rows").integer(why.rows);
  out.key("rank").integer(why.rank);
  out.key("extended_rank").integer(why.extended_rank);
  out.key("sentences").texts(why.sentences);
  out.endObject();
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
    out.key("sequence").texts(other.sequence);
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
  writeTimes(out, result.times);
  out.key("residual").number(result.residual);
  out.key("scaled_residual").number(result.scaled_residual);
  out.key("objective").number(result.objective);
  out.key("iterations").integer(result.iterations);
  out.key("growth").number(result.growth);
  out.key("milliseconds").number(result.milliseconds);
  out.key("sequence_before").texts(result.sequence_before);
  out.key("sequence_after").texts(result.sequence_after);
  out.key("signature_changed").boolean(result.signature_changed);
  writeSequenceChanges(out, result.sequence_changes);
  out.key("reliable").boolean(result.reliability.reliable);
  writeCertificate(out, result.certificate);
  writeWhyNot(out, result.why_not);
  writeOutput(out, outputs, 0);
  writeAlternatives(out, result, outputs);
  out.endObject();
  return out.take();
}

}  // namespace carom

// SPDX-License-Identifier: MIT
#include "formats/answers/edit_json.hpp"

#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

namespace {

using Layout = JsonWriter::Layout;

void writeChanged(JsonWriter& out, const std::vector<ChangedNumber>& changed, bool fitted = false) {
  out.objects("changed", changed, Layout::line, [&](const ChangedNumber& number) {
    out.members("control", number.control, "component", number.component, "name", number.name);
    out.members("before", number.before, "after", number.after, "share", number.share);
    if (fitted) out.members("standard_deviation", number.standard_deviation);
  });
}

void writeResiduals(JsonWriter& out, const char* member, const std::vector<ConstrainedNumber>& residuals) {
  out.objects(member, residuals, Layout::line, [&](const ConstrainedNumber& number) {
    out.members("constraint", number.constraint, "component", number.component, "name", number.name);
    out.members("value", number.value, "target", number.target);
    if (!(number.lower == number.upper)) out.members("min", number.lower, "max", number.upper);
    out.members("error", number.error, "scaled_error", number.scaled_error);
  });
}

void writeTimes(JsonWriter& out, const std::vector<MetTime>& times) {
  out.objects("times", times, Layout::line, [&](const MetTime& met) {
    out.members("constraint", met.constraint, "name", met.name, "from", met.from, "to", met.to, "time", met.time);
  });
}

void writeCertificate(JsonWriter& out, const Certificate& certificate) {
  out.key("certificate");
  if (!certificate.taken) {
    out.null();
    return;
  }
  out.beginObject();
  out.members("residual", certificate.residual, "scaled_residual", certificate.scaled_residual);
  out.members("energy_drift", certificate.energy_drift, "energy_gain", certificate.energy_gain);
  out.members("deepest_penetration", certificate.deepest_penetration);
  out.members("reliable", certificate.reliability.reliable, "events", certificate.reliability.events);
  out.members("smallest_margin", certificate.reliability.smallest_margin);
  out.members("signature_radius", certificate.signature_radius, "signature_event", certificate.signature_event);
  out.endObject();
}

void writeWhyNot(JsonWriter& out, const WhyNot& why) {
  out.key("why_not");
  if (why.sentences.empty()) {
    out.null();
    return;
  }
  out.beginObject();
  out.objects("conflicts", why.conflicts, Layout::line, [&](const WhyNot::Conflict& conflict) {
    out.members("residuals", conflict.rows, "names", conflict.names);
  });
  out.objects("inside", why.inside, Layout::line, [&](const WhyNot::Inside& inside) {
    out.members("constraint", inside.constraint, "name", inside.name, "body", inside.solid);
  });
  out.objects("at_bounds", why.at_bounds, Layout::line, [&](const WhyNot::AtBound& at) {
    out.members("control", at.control, "name", at.name, "side", at.upper ? "max" : "min");
    out.members("bound", at.bound, "removes", at.removes, "change", at.change);
  });
  out.objects("would_help", why.would_help, Layout::line, [&](const WhyNot::Help& help) {
    out.members("name", help.name);
    writeVaried(out, help.control);
    out.members("removes", help.removes, "change", help.change, "restores_rank", help.restores_rank);
    out.members("solves", help.tried ? std::optional(help.solves) : std::nullopt);
  });
  out.members("rows", why.rows, "rank", why.rank, "extended_rank", why.extended_rank, "sentences", why.sentences);
  out.endObject();
}

void writeSequenceChanges(JsonWriter& out, const std::vector<SequenceChange>& changes) {
  const auto event = [](int index) { return index < 0 ? std::nullopt : std::optional(index); };
  out.objects("sequence_changes", changes, Layout::line, [&](const SequenceChange& change) {
    out.members("kind", nameOf(change.kind), "before", event(change.before), "after", event(change.after));
    out.members("matters", change.matters, "sentence", change.sentence);
  });
}

}  // namespace

std::string editJson(const EditResult& result, const std::vector<std::string>& outputs) {
  std::size_t solution = 0;
  const auto next_output = [&] { return solution < outputs.size() ? textOrNone(outputs[solution++]) : std::nullopt; };
  JsonWriter out;
  out.beginObject();
  out.members("status", nameOf(result.status), "message", result.message, "met", result.met);
  const Fit& fit = result.fit;
  writeChanged(out, result.changed, fit.rows > 0);
  writeResiduals(out, "residuals", result.residuals);
  if (fit.rows > 0) {
    writeResiduals(out, "soft_residuals", result.soft_residuals);
    out.key("fit").beginObject(Layout::line);
    out.members("rows", fit.rows, "parameters", fit.parameters, "sum_of_squares", fit.sum_of_squares);
    out.members("deviation", fit.deviation, "message", textOrNone(fit.message));
    out.endObject();
  }
  writeTimes(out, result.times);
  out.members("residual", result.residual, "scaled_residual", result.scaled_residual, "objective", result.objective);
  out.members("iterations", result.iterations, "growth", result.growth, "milliseconds", result.milliseconds);
  out.members("sequence_before", result.sequence_before, "sequence_after", result.sequence_after);
  out.members("signature_changed", result.signature_changed);
  writeSequenceChanges(out, result.sequence_changes);
  out.members("reliable", result.reliability.reliable);
  writeCertificate(out, result.certificate);
  writeWhyNot(out, result.why_not);
  out.members("output", next_output());
  out.objects("alternatives", result.alternatives, Layout::block, [&](const EditAlternative& other) {
    out.members("objective", other.objective, "much_dearer", other.much_dearer);
    out.members("residual", other.residual, "scaled_residual", other.scaled_residual);
    writeChanged(out, other.changed);
    out.members("sequence", other.sequence);
    writeSequenceChanges(out, other.sequence_changes);
    out.members("output", next_output());
  });
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail

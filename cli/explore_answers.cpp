// SPDX-License-Identifier: MIT
#include "cli/explore_answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "adjoint/base/errors.h"
#include "cli/table.h"
#include "formats/json/json_writer.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr std::size_t kMostOutcomes = 12, kMostImpacts = 6;
constexpr std::array kFaces = {"none", "+x", "-x", "+y", "-y", "+z", "-z"};

std::string percent(Output& out, double share) { return out.rounded(100 * share); }
std::string interval(Output& out, const Share& share) {
  return percent(out, share.lower) + " to " + percent(out, share.upper);
}

/// What happens in a world, in a line.
std::vector<std::string> impactsOf(const Exploration& exploration, const Outcome& outcome) {
  if (!hasMotion(outcome.status)) return {};
  try {
    return exploration.motionOf(outcome.example).describeEvents();
  } catch (const InputError&) {
    return {};
  }
}

std::string lineOf(const std::vector<std::string>& impacts) {
  std::string line;
  for (std::size_t k = 0; k < std::min(impacts.size(), kMostImpacts); ++k) line += (k > 0 ? ", " : "") + impacts[k];
  if (impacts.size() > kMostImpacts) line += ", and " + std::to_string(impacts.size() - kMostImpacts) + " more";
  return line.empty() ? "no impact" : line;
}

void printOutcomes(Output& out, const ExploreAnswer& answer) {
  const std::vector<Outcome>& outcomes = answer.summary.outcomes;
  out.text() << "\nOutcomes: " << outcomes.size() << " different impact sequences and ends\n";
  Table table({">share [%]", ">95 % interval [%]", ">worlds", "end", ">example", "impacts"});
  for (std::size_t k = 0; k < std::min(outcomes.size(), kMostOutcomes); ++k) {
    const Outcome& o = outcomes[k];
    table.row({percent(out, o.share.share), interval(out, o.share), std::to_string(o.share.count),
               nameOfWorldStatus(o.status), std::to_string(o.example),
               hasMotion(o.status) ? lineOf(impactsOf(answer.exploration, o)) : "-"});
  }
  table.print(out);
  if (outcomes.size() <= kMostOutcomes) return;
  std::uint64_t rest = 0;
  for (std::size_t k = kMostOutcomes; k < outcomes.size(); ++k) rest += outcomes[k].share.count;
  out.text() << outcomes.size() - kMostOutcomes << " more, with "
             << percent(out, shareOf(rest, answer.summary.worlds).share) << " % of the worlds together\n";
}

void printRows(Output& out, const ExploreAnswer& answer) {
  const std::vector<ExploredRow>& rows = answer.exploration.rows();
  if (rows.empty()) return;
  out.text() << "\nConstraints\n";
  Table table({"row", "unit", ">worlds", ">mean", ">deviation", ">2.5 %", ">median", ">97.5 %", "wanted", ">within [%]",
               ">95 % interval [%]"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RowSummary& row = answer.summary.rows[i];
    const bool has_range = rows[i].isRange();
    table.row({rows[i].name, rows[i].unit.empty() ? "" : rows[i].unit.substr(1), std::to_string(row.count),
               out.number(row.mean), out.rounded(row.deviation), out.number(row.quantiles[0]),
               out.number(row.quantiles[2]), out.number(row.quantiles[4]),
               describeWanted(out, rows[i].lower, rows[i].lower, rows[i].upper),
               has_range ? percent(out, row.within.share) : "-", has_range ? interval(out, row.within) : "-"});
  }
  table.print(out);
  const auto ranges = std::count_if(rows.begin(), rows.end(), [](const ExploredRow& row) { return row.isRange(); });
  if (ranges > 0)
    out.text() << "All ranges kept to, nothing missing: " << percent(out, answer.summary.met.share) << " % ("
               << interval(out, answer.summary.met) << ")\n";
}

void printFaces(Output& out, const ExploreAnswer& answer) {
  if (answer.summary.faces.empty()) return;
  out.text() << "\nFaces up at the end\n";
  Table table({"box", "face", ">share [%]", ">95 % interval [%]", ">worlds"});
  for (const FaceSummary& box : answer.summary.faces)
    for (std::size_t f = 1; f <= kFaces.size(); ++f) {
      const Share& share = box.faces[f % kFaces.size()];
      if (share.count > 0)
        table.row({box.box, kFaces[f % kFaces.size()], percent(out, share.share), interval(out, share),
                   std::to_string(share.count)});
    }
  table.print(out);
}

void printNearest(Output& out, const ExploreAnswer& answer) {
  if (answer.nearest.empty()) return;
  out.text() << "\nNearest to all constraints\n";
  Table table({">world", ">distance"});
  for (const NearWorld& near : answer.nearest) table.row({std::to_string(near.world), out.rounded(near.distance)});
  table.print(out);
}

void writeShare(JsonWriter& json, const char* name, const Share& share) {
  json.key(name).beginObject(JsonWriter::Layout::line);
  json.members("worlds", share.count, "share", share.share, "lower", share.lower, "upper", share.upper).endObject();
}

void writeRow(JsonWriter& json, const ExploredRow& row, const RowSummary& summary) {
  json.members("name", row.name, "constraint", row.constraint, "worlds", summary.count);
  const auto finite = [](double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; };
  json.members("lower", finite(row.lower), "upper", finite(row.upper), "mean", finite(summary.mean), "deviation",
               finite(summary.deviation));
  json.key("quantiles");
  if (summary.count > 0)
    json.value(summary.quantiles);
  else
    json.null();
  if (row.isRange()) writeShare(json, "within", summary.within);
}

}  // namespace

void printExploration(Output& out, const ExploreAnswer& answer) {
  const ExploreSummary& summary = answer.summary;
  out.text() << answer.table.size() << (answer.table.size() == 1 ? " world" : " worlds") << ", " << answer.table.numbers
             << " numbers drawn of each";
  if (answer.table.size() < answer.asked)
    out.text() << "; " << out.styled(Look::warning, "stopped") << " before " << answer.asked;
  out.text() << '\n';
  for (const std::string& note : answer.exploration.notes()) out.text() << note << '\n';
  if (summary.outside > 0)
    out.text() << summary.outside << " worlds lie outside of bounds; shares are of the other " << summary.worlds
               << ".\n";
  if (summary.worlds == 0) return;
  printOutcomes(out, answer);
  printRows(out, answer);
  printFaces(out, answer);
  printNearest(out, answer);
  if (summary.without_derivative > 0)
    out.text() << "\nIn " << summary.without_derivative << " worlds a derivative does not exist.\n";
  if (summary.unreliable > 0)
    out.text() << "\nIn " << summary.unreliable << " worlds a derivative is not to be relied on.\n";
}

std::string exploreJson(const ExploreAnswer& answer) {
  using Layout = JsonWriter::Layout;
  const ExploreSummary& summary = answer.summary;
  JsonWriter json;
  json.beginObject().members("worlds", answer.table.size(), "asked", answer.asked, "counted", summary.worlds, "outside",
                             summary.outside);
  json.members("points", answer.exploration.options().points == Points::sobol ? "sobol" : "random", "seed",
               answer.exploration.options().seed);
  json.members("notes", answer.exploration.notes());
  json.objects("numbers", answer.exploration.numbers(), Layout::line, [&](const DrawnNumber& number) {
    json.members("name", number.name, "control", number.control, "component", number.component);
  });
  json.key("outcomes").beginArray();
  for (std::size_t k = 0; k < summary.outcomes.size(); ++k) {
    const Outcome& outcome = summary.outcomes[k];
    json.beginObject();
    writeShare(json, "share", outcome.share);
    json.members("status", nameOfWorldStatus(outcome.status), "example", outcome.example);
    if (k < kMostOutcomes)
      json.members("impacts", impactsOf(answer.exploration, outcome));  // for more a world is simulated each
    json.endObject();
  }
  json.endArray().key("rows").beginArray();
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    json.beginObject();
    writeRow(json, answer.exploration.rows()[i], summary.rows[i]);
    json.endObject();
  }
  json.endArray().key("faces").beginArray();
  for (const FaceSummary& box : summary.faces) {
    json.beginObject().members("body", box.box);
    for (std::size_t f = 0; f < kFaces.size(); ++f) writeShare(json, kFaces[f], box.faces[f]);
    json.endObject();
  }
  json.endArray();
  writeShare(json, "met", summary.met);
  json.objects("nearest", answer.nearest, Layout::line,
               [&](const NearWorld& near) { json.members("world", near.world, "distance", near.distance); });
  json.members("without_derivative", summary.without_derivative, "unreliable", summary.unreliable);
  json.endObject();
  return json.take();
}

}  // namespace carom::cli

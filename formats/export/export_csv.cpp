// SPDX-License-Identifier: MIT
#include "formats/export/export_csv.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "adjoint/base/errors.h"

namespace carom {
namespace {

constexpr const char* kColumns =
    "time [s],body,kind,event,position.x [m],position.y [m],position.z [m],"
    "orientation.w,orientation.x,orientation.y,orientation.z,"
    "velocity.x [m/s],velocity.y [m/s],velocity.z [m/s],"
    "angular_velocity.x [rad/s],angular_velocity.y [rad/s],angular_velocity.z [rad/s],"
    "path\r\n";

constexpr double kMostRows = 2e6;  // half a gigabyte

enum class RowKind { sample, before, after };
constexpr const char* kKindNames[] = {"sample", "before", "after"};

struct CsvRow {
  double time = 0;
  int body = 0;
  RowKind kind = RowKind::sample;
  int event = -1;  // -1: a sample
};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

bool hasEventAt(const Motion& motion, int body, double t) {
  const auto& events = motion.world_lines[body].events;
  const auto first = std::lower_bound(events.begin(), events.end(), t,
                                      [&](int e, double time) { return motion.events[e].time < time; });
  return first != events.end() && motion.events[*first].time == t;
}

void addSamples(const Motion& motion, int body, double rate, std::vector<CsvRow>& rows) {
  const auto add = [&](double t) {
    if (!hasEventAt(motion, body, t)) rows.push_back({t, body, RowKind::sample, -1});
  };
  long k = 0;
  for (; static_cast<double>(k) / rate < motion.end; ++k) add(static_cast<double>(k) / rate);
  add(motion.end);
}

// Null when the motion ends in the event.
const Arc* arcAfter(const Motion& motion, const Participant& p) {
  const auto& arcs = motion.world_lines[p.body].arcs;
  return p.next() < static_cast<int>(arcs.size()) ? &arcs[p.next()] : nullptr;
}

std::vector<CsvRow> rowsOf(const Motion& motion, double rate) {
  std::vector<CsvRow> rows;
  const auto& bodies = motion.scene->bodies;
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body)
    if (!bodies[body].fixed) addSamples(motion, body, rate, rows);
  for (int e = 0; e < static_cast<int>(motion.events.size()); ++e) {
    const auto& participants = motion.events[e].participants;
    for (const Participant& p : participants) rows.push_back({motion.events[e].time, p.body, RowKind::before, e});
    for (const Participant& p : participants)
      if (arcAfter(motion, p)) rows.push_back({motion.events[e].time, p.body, RowKind::after, e});
  }
  // Stable: rows of one time keep the order they were made in, samples first, then the events in their order.
  std::stable_sort(rows.begin(), rows.end(), [](const CsvRow& a, const CsvRow& b) { return a.time < b.time; });
  return rows;
}

// Of several events of one instant, the state after one of them is the state before the next.
BodyState stateAfter(const Motion& motion, int event, int body) {
  const Arc* next = arcAfter(motion, *motion.events[event].find(body));
  return toBodyState(next->model(), next->startState());
}

BodyState stateOf(const Motion& motion, const CsvRow& row) {
  if (row.kind == RowKind::before) return motion.stateBefore(row.event, row.body);
  if (row.kind == RowKind::after) return stateAfter(motion, row.event, row.body);
  return motion.stateAt(row.body, row.time);
}

// What the body does there: before an event what it did, at the time of a sample what it does from then on. Nothing
// where the motion ends as it is not known.
std::string pathOf(const Motion& motion, const CsvRow& row) {
  if (row.kind == RowKind::after && row.time == motion.end && motion.status != MotionStatus::complete) return "";
  const int arc = row.kind == RowKind::sample   ? motion.arcAt(row.body, row.time)
                  : row.kind == RowKind::before ? motion.events[row.event].find(row.body)->arc
                                                : motion.events[row.event].find(row.body)->next();
  return nameOf(motion.world_lines[row.body].arcs[arc].kind());
}

std::string allDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

void appendRow(std::string& out, const Motion& motion, const CsvRow& row) {
  const BodyState s = stateOf(motion, row);
  const Quat& q = s.orientation;
  out += allDigits(row.time) + "," + quoted(motion.scene->bodies[row.body].name) + "," +
         kKindNames[static_cast<int>(row.kind)] + ",";
  if (row.event >= 0) out += std::to_string(row.event + 1);
  for (const double value :
       {s.position.x(), s.position.y(), s.position.z(), q.w(), q.x(), q.y(), q.z(), s.velocity.x(), s.velocity.y(),
        s.velocity.z(), s.angular_velocity.x(), s.angular_velocity.y(), s.angular_velocity.z()}) {
    if (!std::isfinite(value))
      throw InputError("body '" + motion.scene->bodies[row.body].name + "'",
                       "its motion holds a number that is not finite; nothing was written");
    out += "," + allDigits(value);
  }
  out += "," + pathOf(motion, row) + "\r\n";
}

}  // namespace

std::string csvText(const Motion& motion, double rate) {
  if (!(rate > 0 && rate <= 1e6))
    throw InputError("csv rate", "found " + std::to_string(rate) + ", expected a number of rows a second up to 1e6");
  const double rows = rate * motion.end * static_cast<double>(motion.scene->bodies.size());
  if (!(rows <= kMostRows))
    throw InputError("csv rate", "found " + std::to_string(rate) + ", which makes " + std::to_string(rows) +
                                     " rows, expected one that makes at most " + std::to_string(kMostRows));
  std::string out = kColumns;
  for (const CsvRow& row : rowsOf(motion, rate)) appendRow(out, motion, row);
  return out;
}

}  // namespace carom

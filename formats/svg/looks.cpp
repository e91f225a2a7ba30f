// SPDX-License-Identifier: MIT
#include "formats/svg/looks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "formats/drawing/motion_extent.hpp"

namespace carom::formats_detail {
namespace {

constexpr int kMostLines = 24;      // each has its own colour and dash
constexpr int kChosenLines = 8;     // of more bodies
constexpr double kNear = 14;        // px: lines as near as that are neighbours
constexpr double kMostInk = 0.16;   // of the panel's area, for thin lines
constexpr double kSamples = 20000;  // places of a path

std::vector<int> movingBodies(const Scene& scene) {
  std::vector<int> bodies;
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body)
    if (!scene.bodies[static_cast<std::size_t>(body)].fixed) bodies.push_back(body);
  return bodies;
}

/// All moving bodies in the order in which they deserve a line.
std::vector<int> byInterest(const Motion& motion, const std::vector<int>& first) {
  std::vector<int> bodies = movingBodies(*motion.scene);
  std::vector<double> interest(motion.scene->bodies.size(), 0);
  for (const int body : bodies) interest[static_cast<std::size_t>(body)] = pathExtent(motion, body).diagonal().norm();
  for (const int body : first) interest[static_cast<std::size_t>(body)] = HUGE_VAL;
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) {
    return interest[static_cast<std::size_t>(a)] > interest[static_cast<std::size_t>(b)];
  });
  return bodies;
}

/// Path data in every view; nothing when it takes more than `most` bytes in all.
bool drawLines(const Motion& motion, const std::vector<View>& views, const std::vector<int>& bodies, double tolerance,
               std::size_t most, std::vector<BodyLook>& looks) {
  std::size_t bytes = 0;
  for (const int body : bodies) {
    BodyLook& look = looks[static_cast<std::size_t>(body)];
    look.paths.clear();
    for (const View& view : views) {
      look.paths.push_back(pathData(motion, body, view, tolerance));
      bytes += look.paths.back().size();
    }
    if (bytes > most) return false;
  }
  return true;
}

/// How much two lines want different colours.
class Conflicts {
 public:
  Conflicts(const Motion& motion, const std::vector<View>& views, const std::vector<int>& lines)
      : count_(lines.size()), weights_(count_ * count_, 0) {
    addMeetings(motion, lines);
    for (const View& view : views) addNearness(motion, view, lines);
  }
  double between(std::size_t a, std::size_t b) const { return weights_[a * count_ + b]; }

 private:
  void add(std::size_t a, std::size_t b, double weight) {
    weights_[a * count_ + b] += weight;
    weights_[b * count_ + a] += weight;
  }

  void addMeetings(const Motion& motion, const std::vector<int>& lines) {
    std::vector<int> rank(motion.scene->bodies.size(), -1);
    for (std::size_t i = 0; i < count_; ++i) rank[static_cast<std::size_t>(lines[i])] = static_cast<int>(i);
    for (const Event& event : motion.events)
      for (const Contact& contact : event.contacts) {
        const int a = rank[static_cast<std::size_t>(contact.a)], b = rank[static_cast<std::size_t>(contact.b)];
        constexpr double kMeeting = 1e6;  // counts more than any nearness
        if (a >= 0 && b >= 0) add(static_cast<std::size_t>(a), static_cast<std::size_t>(b), kMeeting);
      }
  }

  // Squares of the panel through which both lines run.
  void addNearness(const Motion& motion, const View& view, const std::vector<int>& lines) {
    std::vector<std::set<std::pair<long, long>>> squares(count_);
    for (std::size_t i = 0; i < count_; ++i)
      for (const PathSample& sample : samplesOfPath(motion, lines[i], view, 0.5 * kNear, kSamples))
        squares[i].emplace(std::lround(sample.pixel.x() / kNear), std::lround(sample.pixel.y() / kNear));
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double shared = 0;
        for (const auto& square : squares[i]) shared += squares[j].contains(square) ? 1 : 0;
        if (shared > 0) add(i, j, shared);
      }
  }

  std::size_t count_;
  std::vector<double> weights_;
};

/// The colour that disturbs its neighbours least, no colour more often than there are dashes.
std::size_t bestColour(std::size_t line, const std::vector<int>& chosen, const Conflicts& conflicts, std::size_t kinds) {
  std::vector<double> cost(kinds, 0), uses(kinds, 0);
  for (std::size_t other = 0; other < chosen.size(); ++other) {
    if (chosen[other] < 0) continue;
    const auto colour = static_cast<std::size_t>(chosen[other]);
    cost[colour] += conflicts.between(line, other);
    uses[colour] += 1;
  }
  std::size_t best = kinds;
  for (std::size_t step = 0; step < kinds; ++step) {
    const std::size_t colour = (line + step) % kinds;  // its own by rank first, as in 3-D exports
    if (uses[colour] >= static_cast<double>(kPathDashes.size())) continue;
    if (best == kinds || cost[colour] < cost[best] || (cost[colour] == cost[best] && uses[colour] < uses[best]))
      best = colour;
  }
  return best;
}

/// Colours by the greedy method of Brelaz: next comes the line with most colours around it.
void colourLines(const Motion& motion, const std::vector<View>& views, const std::vector<int>& lines,
                 std::vector<BodyLook>& looks) {
  const std::vector<Colour> palette = bodyColours();
  std::vector<int> chosen(lines.size(), -1);
  if (lines.size() <= palette.size()) {
    for (std::size_t i = 0; i < lines.size(); ++i) chosen[i] = static_cast<int>(i);
  } else {
    const Conflicts conflicts(motion, views, lines);
    for (std::size_t done = 0; done < lines.size(); ++done) {
      std::size_t next = lines.size(), most = 0;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (chosen[i] >= 0) continue;
        std::set<int> around;
        for (std::size_t j = 0; j < lines.size(); ++j)
          if (chosen[j] >= 0 && conflicts.between(i, j) > 0) around.insert(chosen[j]);
        if (next == lines.size() || around.size() > most) next = i, most = around.size();
      }
      chosen[next] = static_cast<int>(bestColour(next, chosen, conflicts, palette.size()));
    }
  }
  std::vector<std::size_t> used(palette.size(), 0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto colour = static_cast<std::size_t>(chosen[i]);
    BodyLook& look = looks[static_cast<std::size_t>(lines[i])];
    look.colour = palette[colour];
    look.dash = used[colour]++;
  }
}

/// Whether thin lines of the crowd would leave white between them.
bool leavesWhite(const Motion& motion, const std::vector<View>& views, const std::vector<BodyLook>& looks) {
  for (const View& view : views) {
    double ink = 0;
    for (std::size_t body = 0; body < looks.size(); ++body)
      if (looks[body].as == BodyLook::As::crowd) ink += lengthOfPath(motion, static_cast<int>(body), view);
    if (ink > kMostInk * view.panel.width * view.panel.height) return false;
  }
  return true;
}

void drawCrowd(const Motion& motion, const std::vector<View>& views, std::size_t most, PathPlan& plan) {
  std::vector<int> crowd;
  for (std::size_t body = 0; body < plan.looks.size(); ++body)
    if (plan.looks[body].as == BodyLook::As::crowd) crowd.push_back(static_cast<int>(body));
  plan.crowd = static_cast<int>(crowd.size());
  constexpr double kCrowdTolerance = 0.5;
  plan.shaded = !leavesWhite(motion, views, plan.looks) ||
                !drawLines(motion, views, crowd, kCrowdTolerance, most, plan.looks);
  if (!crowd.empty() && !plan.shaded) plan.tolerance = std::max(plan.tolerance, kCrowdTolerance);
}

}  // namespace

PathPlan planPaths(const Motion& motion, const std::vector<View>& views, const std::vector<int>& first,
                   std::size_t most) {
  PathPlan plan;
  const std::vector<int> ordered = byInterest(motion, first);
  const int moving = static_cast<int>(ordered.size());
  const int lines_at_first = moving <= kMostLines ? moving : kChosenLines;
  for (const int count : {lines_at_first, std::min(lines_at_first, kChosenLines), 4, 1, 0}) {
    if (count > lines_at_first) continue;
    std::vector<int> lines(ordered.begin(), ordered.begin() + count);
    std::sort(lines.begin(), lines.end());
    for (const double tolerance : {0.25, 0.5, 1.0}) {
      plan.looks.assign(motion.scene->bodies.size(), {});
      if (!drawLines(motion, views, lines, tolerance, most, plan.looks)) continue;
      for (const int body : ordered) plan.looks[static_cast<std::size_t>(body)].as = BodyLook::As::crowd;
      for (const int body : lines) plan.looks[static_cast<std::size_t>(body)].as = BodyLook::As::line;
      plan.tolerance = tolerance, plan.lines = count;
      colourLines(motion, views, lines, plan.looks);
      drawCrowd(motion, views, most / 2, plan);
      return plan;
    }
  }
  return plan;  // never reached: no lines fit any size
}

}  // namespace carom::formats_detail

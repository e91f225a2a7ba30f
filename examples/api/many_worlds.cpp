// SPDX-License-Identifier: MIT
// Many worlds of one throw: how likely the ball clears a wall, which worlds come nearest, and a run that goes on from a
// store.
#include <cstdio>
#include <filesystem>

#include "editing/distribution.h"
#include "explore/explore.h"
#include "explore/store/question.h"
#include "explore/store/table_bytes.h"
#include "explore/store/table_csv.h"
#include "explore/worlds/summary.h"
#include "formats/base/document.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Document throwOverWall() {
  Body floor, wall, ball, die;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  wall.name = "wall", wall.fixed = true, wall.shape = Box{{0.1, 2, 0.6}}, wall.position = {1.5, 0, 0.3};
  ball.name = "ball", ball.mass = 0.06, ball.shape = Sphere{0.03}, ball.position = {0, 0, 1}, ball.velocity = {3, 0, 1};
  die.name = "die", die.mass = 0.01, die.shape = Box{{0.02, 0.02, 0.02}}, die.position = {-1, 0, 0.05};
  Document document;
  document.scene.bodies = {floor, wall, ball, die};
  document.scene.bodies[2].material = "rubber";
  document.scene.materials.push_back({.name = "rubber", .elasticity = 0.7, .friction = 0.4});
  document.duration = 0.9;
  Control speed = velocity("ball"), bounce = elasticity("rubber"), grip = friction("rubber"), turn = orientation("die");
  speed.distribution = Distribution(NormalDistribution{{}, {0.3, 0.05, 0.3}});
  bounce.distribution = UniformDistribution{{0.6}, {0.8}};
  grip.distribution = LogNormalDistribution{{0.4}, {0.2}};
  turn.distribution = UniformOrientation{};
  document.controls = {speed, bounce, grip, turn};
  Target beyond{"position", {any, any, any}};
  beyond.min = {1.8, any, any};
  document.constraints = {{"ball", 0.9, {beyond}}};
  return document;
}

void printShare(const char* what, const Share& share) {
  std::printf("%-34s %.3f, with 95 %% confidence in [%.3f, %.3f]\n", what, share.share, share.lower, share.upper);
}

}  // namespace

int main() {
  const Document document = throwOverWall();
  OdeContacts contacts(document.scene);
  const ExploreOptions options{.points = Points::sobol, .gradients = true};
  const Exploration exploration(document.scene, contacts, document.duration, document.controls, document.constraints,
                                options);
  for (const DrawnNumber& number : exploration.numbers()) std::printf("drawn: %s\n", number.name.c_str());
  for (const ExploredRow& row : exploration.rows())
    std::printf("read:  %s, from %g%s\n", row.name.c_str(), row.lower, row.unit.c_str());

  ExploreRun run;
  std::uint64_t done = 0;
  run.progress = [&](const ExploreProgress& progress) { done = progress.done; };
  const WorldTable table = explore(exploration, 1000, run);
  std::printf("%llu worlds, %zu numbers and %zu rows each\n", static_cast<unsigned long long>(done), table.numbers,
              table.rows);

  const ExploreSummary summary = summarise(exploration, table);
  printShare("beyond the wall:", summary.met);
  const RowSummary& x = summary.rows[0];
  std::printf("x at 0.9 s: mean %.3f m, standard deviation %.3f m\n", x.mean, x.deviation);
  const Outcome& first = summary.outcomes[0];
  std::printf("most frequent of %zu outcomes: %s\n", summary.outcomes.size(), nameOfWorldStatus(first.status));
  const FaceSummary& die = summary.faces[0];
  printShare(("+z of '" + die.box + "' up:").c_str(), die.faces[5]);

  for (const NearWorld& near : nearestWorlds(exploration, table, 1))
    std::printf("nearest: world %llu, thrown at %.3f m/s\n", static_cast<unsigned long long>(near.world),
                exploration.sceneAt(near.world).bodies[2].velocity.x());

  // Any part of the table has the same bits, wherever it is computed; a store keeps parts that are done.
  const std::string folder = (std::filesystem::temp_directory_path() / "carom_many_worlds").string();
  WorldStore store(folder, questionOf(document, options));
  run.store = &store;
  std::printf("from a store the same: %s\n", explore(exploration, 1000, run) == table ? "yes" : "no");
  std::printf("as bytes the same:     %s\n", *tableOfBytes(tableBytes(table)) == table ? "yes" : "no");
  std::printf("columns of text: %.36s...\n", tableCsv(exploration, exploration.chunk(0, 1)).c_str());
  std::filesystem::remove_all(folder);
}

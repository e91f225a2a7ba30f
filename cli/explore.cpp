// SPDX-License-Identifier: MIT
// carom explore: many worlds of a scene, drawn from the distributions of its controls.
#include "explore/explore.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/explore_answers.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "explore/store/question.h"
#include "explore/store/table_bytes.h"
#include "explore/store/table_csv.h"
#include "formats/base/write_file.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr const char* kRandom = "random";
constexpr const char* kSobol = "sobol";

struct ExploreArguments {
  std::string scene, points = kRandom, table, store, start;
  std::uint64_t worlds = 1000, seed = 0, chunk = 0;
  int threads = 0, nearest = 0;
  bool gradients = false;
  MotionArguments motion;
};

WorldTable run(const ExploreArguments& arguments, const Loaded& loaded, const Exploration& exploration, Output& out) {
  std::optional<WorldStore> store;
  if (!arguments.store.empty()) store.emplace(arguments.store, questionOf(loaded.document, exploration.options()));
  Progress progress(out, "exploring");
  const Interruption::Stoppable stoppable(out.interruption());
  ExploreRun how{.threads = arguments.threads, .chunk = arguments.chunk};
  how.progress = [&](const ExploreProgress& at) {
    progress.show(std::to_string(at.done) + " of " + std::to_string(at.worlds) + " worlds");
  };
  how.stop = stoppable.token();
  how.store = store ? &*store : nullptr;
  return explore(exploration, arguments.worlds, how);
}

/// The nearest world as a scene document, from which an edit starts.
void saveStart(Output& out, const std::string& path, const Loaded& loaded, const Exploration& exploration,
               std::uint64_t world) {
  Document document = loaded.document;
  document.scene = exploration.sceneAt(world);
  saveSceneTo(out, path, document);
  sayWritten(out, path);
}

Exit explored(const ExploreArguments& arguments, Output& out) {
  for (const std::string& file : {arguments.table, arguments.start})
    if (!file.empty()) requireOutput(file);
  if (isStandard(arguments.table) && isStandard(arguments.start))
    throw UsageError("-o and --start cannot both be standard output");
  if (isStandard(arguments.table) || isStandard(arguments.start)) out.reserveForContent();
  Loaded loaded(out, arguments.scene, arguments.motion);
  return inFile(loaded.path, [&] {
    const Exploration exploration(loaded.document.scene, loaded.contacts, loaded.document.duration,
                                  loaded.document.controls, loaded.document.constraints,
                                  {.points = arguments.points == kSobol ? Points::sobol : Points::random,
                                   .seed = arguments.seed,
                                   .gradients = arguments.gradients,
                                   .step_limit = arguments.motion.step_limit});
    const WorldTable table = run(arguments, loaded, exploration, out);
    const bool stopped = table.size() < arguments.worlds;
    const bool wants_start = !arguments.start.empty();
    const auto most = static_cast<std::size_t>(std::max(arguments.nearest, wants_start ? 1 : 0));
    const ExploreAnswer answer{exploration, table, summarise(exploration, table),
                               nearestWorlds(exploration, table, most), arguments.worlds};
    if (out.json())
      out.document(exploreJson(answer));
    else
      printExploration(out, answer);
    if (!arguments.table.empty()) {
      const std::string bytes = arguments.table.ends_with(".worlds") ? tableBytes(table) : tableCsv(exploration, table);
      if (isStandard(arguments.table))
        out.content(bytes);
      else
        writeFile(arguments.table, bytes), sayWritten(out, arguments.table);
    }
    if (wants_start && answer.nearest.empty())
      out.fail("No world has all constraints, so that there is none to start from.");
    if (wants_start && !answer.nearest.empty())
      saveStart(out, arguments.start, loaded, exploration, answer.nearest[0].world);
    if (stopped) return exitOf(out.interruption());
    return wants_start && answer.nearest.empty() ? Exit::not_solved : Exit::done;
  });
}

Action declareExplore(CLI::App& app) {
  const auto arguments = std::make_shared<ExploreArguments>();
  addScene(app, arguments->scene);
  app.add_option("--worlds", arguments->worlds, "Number of worlds (default: 1000)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
      ->type_name("N");
  app.add_option("--points", arguments->points, "random: independent worlds; sobol: Sobol's points (default: random)")
      ->check(CLI::IsMember({kRandom, kSobol}))
      ->type_name("WORD");
  app.add_option("--seed", arguments->seed, "Seed of the worlds (default: 0)")->type_name("N");
  app.add_option("--threads", arguments->threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.add_flag("--gradients", arguments->gradients,
               "Derivatives of all rows with respect to the drawn numbers, in the table");
  addOutput(app, arguments->table,
            "Write the table here, a row a world: .worlds in binary, else CSV; - for standard output", "TABLE");
  app.add_option("--store", arguments->store, "Folder of finished chunks, from which a run that was ended goes on")
      ->type_name("DIR");
  app.add_option("--chunk", arguments->chunk,
                 "Number of worlds that a thread computes at a time (default: 256; with a store 1024)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32))
      ->type_name("N");
  app.add_option("--nearest", arguments->nearest, "List the worlds that come nearest to all constraints (default: 0)")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  app.add_option("--start", arguments->start, "Write the nearest world as a scene, a start for carom edit")
      ->type_name("OUT.json");
  addMotion(app, arguments->motion);
  return [arguments](Output& out) { return explored(*arguments, out); };
}

}  // namespace

const Command kExploreCommand{
    "explore", "Simulate many worlds of a scene: what can happen, and how likely",
    "Draws the values of controls from the distributions that the scene gives them (\"distribution\" in\n"
    "\"controls\"), simulates each world, and prints how likely each outcome is: impact sequence and status,\n"
    "constraints met, ranges kept to, faces of boxes that end up on top. Intervals are Wilson's, with 95 %\n"
    "confidence for independent worlds. Values outside of min, max and what is physically possible are cut\n"
    "off, and it says how much that is. A world that fails is a row with a status. The same scene, seed and\n"
    "number of worlds give the same table, bit by bit, on any number of threads.\n"
    "Ctrl-C ends with the worlds that are done (exit code 130); with --store the same call goes on later.\n"
    "\n"
    "Examples:\n"
    "  carom explore scene.json --worlds 100000\n"
    "  carom explore scene.json --worlds 100000 --points sobol -o table.csv\n"
    "  carom explore scene.json --worlds 1000000 --store chunks\n"
    "  carom explore scene.json --start near.json && carom edit near.json -o edited.json\n"
    "  carom explore scene.json --json | jq .met",
    declareExplore};

}  // namespace carom::cli

// SPDX-License-Identifier: MIT
#include "adjoint/simulate/simulate.h"

#include "python/src/interruptible.hpp"
#include "python/src/motion.hpp"

namespace carom::python {
namespace {

PyMotion simulated(const PyScene& scene, std::optional<double> duration, std::size_t impact_limit,
                   std::optional<std::size_t> step_limit, std::optional<double> lowest_bounce, bool groups,
                   bool refuse_overlaps, bool record_events, const nb::object& progress) {
  SimulateOptions options;
  options.impact_limit = impact_limit;
  if (step_limit) options.step_limit = *step_limit;
  options.lowest_bounce = lowest_bounce;
  options.groups = groups;
  options.refuse_overlaps = refuse_overlaps;
  options.record_events = record_events;
  requireFunction(progress, "progress");
  Watch watch(progress);
  options.stop = watch.stop();
  options.progress = watch.progress();
  PyMotion motion = [&] {
    const Computing free;
    SceneContent::Contacts contacts(*scene.content);
    return motionOf(scene, simulate(scene.scene(), *contacts, duration.value_or(scene.document().duration), options));
  }();
  watch.finish();
  return motion;
}

constexpr const char* kSimulateText =
    "Simulates a scene event by event up to `duration` seconds (default: that of the scene).\n\n"
    "The same scene gives the same motion, bit for bit. A motion that cannot be continued ends early: its status and "
    "message say why. Ctrl-C raises KeyboardInterrupt.\n\n"
    "impact_limit: limit on events of all kinds. step_limit: work limit in counted steps (a step takes roughly one to "
    "several microseconds). lowest_bounce: restitution is 0 for bounces lower than this, m, and the bodies stay in "
    "contact; 0: no persistent contact. groups: False ends a motion where bodies would move on each other. refuse_overlaps: raise InputError if bodies overlap at the start. "
    "record_events=False: paths alone, in less than half of the memory; they cannot be differentiated. progress: called "
    "every few thousand steps; if it returns False, the motion ends with the status 'stopped'.\n\n"
    "Raises InputError for invalid input.";

}  // namespace

PyMotion motionOf(const PyScene& scene, Motion motion) {
  return motionOf(scene, std::make_shared<const Motion>(std::move(motion)));
}

PyMotion motionOf(const PyScene& scene, std::shared_ptr<const Motion> motion) {
  const bool takes_long = takesLong(*motion);
  return {scene, sharedFreely(std::make_unique<const MotionContent>(std::move(motion)), takes_long)};
}

void bindSimulate(nb::module_& module) {
  nb::class_<SimulateProgress>(module, "SimulateProgress", "Progress of a simulation.")
      .def_ro("time", &SimulateProgress::time, "s, the motion is known up to here")
      .def_ro("impacts", &SimulateProgress::impacts, "So far.")
      .def_ro("steps", &SimulateProgress::steps, "Counted so far.");
  module.def("simulate", &simulated, nb::arg("scene"), nb::arg("duration") = nb::none(), nb::kw_only(),
             nb::arg("impact_limit") = SimulateOptions().impact_limit, nb::arg("step_limit") = nb::none(),
             nb::arg("lowest_bounce") = nb::none(), nb::arg("groups") = true, nb::arg("refuse_overlaps") = false, nb::arg("record_events") = true,
             nb::arg("progress") = nb::none(),
             nb::sig("def simulate(scene: Scene, duration: float | None = None, *, impact_limit: int = 20000, "
                     "step_limit: int | None = None, lowest_bounce: float | None = None, groups: bool = True, refuse_overlaps: bool = False, "
                     "record_events: bool = True, progress: collections.abc.Callable[[SimulateProgress], bool | None] | "
                     "None = None) -> Motion"),
             kSimulateText);
}

}  // namespace carom::python

// SPDX-License-Identifier: MIT
// What looks right and is not does not compile, or throws where it is written.
#include <gtest/gtest.h>

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulate_along.h"
#include "editing/check_motion_function.h"
#include "editing/edit.h"
#include "editing/session.h"
#include "editing/session_journal.h"
#include "formats/drawing/display.h"
#include "formats/gltf/write/export_gltf.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

// What functions are called on that take a time: never evaluated.
namespace testing_traps {
const Motion& motion();
const Scene& scene();
Arc& arc();
OdeContacts& source();
const MotionFunction& function();
const std::vector<Control>& varied();
const std::vector<Constraint>& nails();
const Constraint& nailed();
Nail& handle();
}

namespace {

using namespace testing_scenes;

// The second impact, or at 2 s? nthImpact(2) and 2.0 say which.
template <class Moment>
concept Nails = requires(Edit& edit, Moment moment) { edit.nail("ball", moment); };
static_assert(Nails<double> && Nails<float> && Nails<When>);
static_assert(!Nails<int> && !Nails<long> && !Nails<unsigned> && !Nails<bool> && !Nails<char> && !Nails<char8_t>);

template <class From, class To>
concept Between = requires(From from, To to) { between(from, to); };
static_assert(Between<double, double> && Between<int, int> && Between<int, double> && Between<unsigned, float>);
static_assert(!Between<bool, int> && !Between<double, bool> && !Between<char, double> && !Between<int, char16_t>);

template <class Number>
concept CountsImpacts = requires(Number n) { nthImpact(n); };
static_assert(CountsImpacts<int> && CountsImpacts<long>);
static_assert(!CountsImpacts<double> && !CountsImpacts<bool> && !CountsImpacts<char>);

// Whatever takes a time takes a number of seconds, be it an int, and neither a bool nor a character. One line for each
// function; F is the call with a time.
template <class F>
constexpr bool kTakesTimes = std::invocable<F, double> && std::invocable<F, float> && std::invocable<F, int> && std::invocable<F, long> &&
                             std::invocable<F, unsigned> && !std::invocable<F, bool> && !std::invocable<F, char> &&
                             !std::invocable<F, signed char> && !std::invocable<F, unsigned char> && !std::invocable<F, wchar_t> &&
                             !std::invocable<F, char8_t> && !std::invocable<F, char16_t> && !std::invocable<F, char32_t>;
#define TAKES_TIMES(...) static_assert(kTakesTimes<decltype([](auto t) requires requires { __VA_ARGS__; } {})>)
using namespace testing_traps;
TAKES_TIMES(motion().stateAt("ball", t));
TAKES_TIMES(motion().stateAt(0, t));
TAKES_TIMES(motion().stateAt(std::string(), t));
TAKES_TIMES(motion().arcAt(0, t));
TAKES_TIMES(arc().extendTo(t));
TAKES_TIMES(arc().stateAt(t));
TAKES_TIMES(arc().kinematicsAt(t));
TAKES_TIMES(arc().positionAt(t));
TAKES_TIMES(arc().velocityAt(t));
TAKES_TIMES(Instant::at(t));
TAKES_TIMES(simulate(scene(), source(), t));
TAKES_TIMES(simulate(scene(), source(), t, SimulateOptions{}));
TAKES_TIMES(simulateAlong(motion(), scene(), nullptr, t));
TAKES_TIMES(Edit(scene(), source(), t));
TAKES_TIMES(Edit(scene(), source(), t, varied(), nails()));
TAKES_TIMES(EditSession(scene(), source(), t));
TAKES_TIMES(EditSession(scene(), source(), t, varied(), nails()));
TAKES_TIMES(nailStateIn(motion(), nailed(), t, 1e-9));
TAKES_TIMES(checkMotionFunction(scene(), source(), t, function(), varied()));
TAKES_TIMES(between(t, 2.0));
TAKES_TIMES(between(0, t));
TAKES_TIMES(handle().time(t));
TAKES_TIMES(handle().time(atLeast(t)));
TAKES_TIMES(handle().time(atMost(t)));
TAKES_TIMES(handle().time(within(t, 2.0)));
TAKES_TIMES(handle().time(within(0, t)));
TAKES_TIMES(std::declval<DisplayTrack::ArcKey&>().positionAt(t));
TAKES_TIMES(std::declval<DisplayTrack::ArcKey&>().velocityAt(t));
TAKES_TIMES(lastFrame(t, 24));
// Members of structs, named and assigned.
TAKES_TIMES(Region{.during = {{t, 2.0}}});
TAKES_TIMES(Region{.during = {{0, t}}});
TAKES_TIMES(Region{.during = std::pair{t, t}});
TAKES_TIMES(std::declval<Region&>().during = {{t, 2.0}});
TAKES_TIMES(Hit{.with = "red", .during = {{t, 2.0}}});
TAKES_TIMES(Hit{.with = "red", .during = {{0.5, t}}});
TAKES_TIMES(Target{.quantity = "closest_approach", .value = {any}, .during = {{t, 2.0}}});
TAKES_TIMES(handle().closestApproach("floor", 1.0, {{t, 2.0}}));
TAKES_TIMES(handle().closestApproach("floor", 1.0, {{0, t}}));
TAKES_TIMES(std::declval<When&>().time = t);
TAKES_TIMES(std::declval<When&>().span = {{0, t}});
TAKES_TIMES(SimulateOptions{.least_duration = t});
TAKES_TIMES(EditOptions{.time_budget_seconds = t});
TAKES_TIMES(SessionOptions{.drag_seconds = t});
TAKES_TIMES(SessionOptions{.release_seconds = t});
TAKES_TIMES(NailTargets{.time = t});
TAKES_TIMES(SessionContent{.scene = scene(), .duration = t});
TAKES_TIMES(Document{.scene = scene(), .duration = t});
TAKES_TIMES(GltfOptions{.ghosts = t});
TAKES_TIMES(Instant{.time = t});
#undef TAKES_TIMES

// A tape keeps its motion, a tangent its tape, a nail its edit, by reference.
static_assert(std::is_constructible_v<DerivativeTape, const Motion&>);
static_assert(!std::is_constructible_v<DerivativeTape, Motion> && !std::is_constructible_v<DerivativeTape, const Motion>);
template <class Tape>
concept HasTangent = requires(Tape&& tape, const SceneTangent& d) { tangent(std::forward<Tape>(tape), d); };
static_assert(HasTangent<DerivativeTape&> && !HasTangent<DerivativeTape>);
template <class Edited>
concept TakesNails = requires(Edited&& edit) { std::forward<Edited>(edit).nail("ball", 1.0); };
template <class Edited>
concept TakesControls = requires(Edited&& edit, Control control) { std::forward<Edited>(edit).vary(control); };
static_assert(TakesNails<Edit&> && !TakesNails<Edit> && TakesControls<Edit&> && !TakesControls<Edit>);
static_assert(std::is_constructible_v<Edit, const Scene&, OdeContacts&, double>);
static_assert(!std::is_constructible_v<Edit, const Scene&, OdeContacts, double>);

// A time of a struct is a number everywhere else.
static_assert(std::is_convertible_v<Seconds, double> && std::is_convertible_v<TimeSpan, std::pair<double, double>>);
static_assert(Nails<Seconds> && Between<Seconds, double>);

// What is free has a type of its own.
static_assert(std::is_constructible_v<Wanted, Free> && !std::is_convertible_v<Free, double>);
static_assert(std::is_convertible_v<Vec3, WantedVector>);

TEST(ApiTraps, ImpactsAreCountedFromOne) {
  EXPECT_THROW(nthImpact(0), InputError);
  EXPECT_THROW(nthImpact(-1, "floor"), InputError);
  EXPECT_NO_THROW(nthImpact(1));
}

// A NaN that somebody computed frees nothing, whatever it is a target of.
TEST(ApiTraps, NotANumberIsNoFreeComponent) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const auto refuses = [&](const char* what, void (*add)(Edit&)) {
    Edit edit(scene, contacts, 0.6);
    edit.vary(velocity("box"));
    add(edit);
    try {
      edit.solve();
      ADD_FAILURE() << what;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("NaN"), std::string::npos) << what << ": " << error.what();
    }
  };
  refuses("a component", [](Edit& e) { e.nail("box", 0.5).position(kNaN, 0.5, any); });
  refuses("a vector", [](Edit& e) { e.nail("box", 0.5).velocity(Vec3(1, kNaN, 1)); });
  refuses("one in braces", [](Edit& e) { e.nail("box", 0.5).angularVelocity({1, any, kNaN}); });
  refuses("a point", [](Edit& e) { e.nail("box", 0.5).point(Vec3::Zero(), Vec3(0, 0, kNaN)); });
  refuses("a number", [](Edit& e) { e.nail("box", 0.5).speed(kNaN); });
  refuses("an orientation", [](Edit& e) { e.nail("box", 0.5).orientation(Quat(kNaN, 0, 0, 1)); });
  refuses("a lower bound", [](Edit& e) { e.nail("box", 0.5).position(any, any, within(kNaN, 1)); });
  refuses("an upper bound", [](Edit& e) { e.nail("box", 0.5).height(atMost(kNaN)); });
  refuses("a distance", [](Edit& e) { e.nail("box", 0.5).distance("floor", kNaN); });
  refuses("a closest approach", [](Edit& e) { e.nail("box", 0.5).closestApproach("floor", atLeast(kNaN)); });
  const Constraint nail = nailConstraint("box", 0.5, {.position = WantedVector(any, kNaN, 0.3)});
  Edit edit(scene, contacts, 0.6, {velocity("box")}, {nail});
  EXPECT_THROW(edit.solve(), InputError);
}

TEST(ApiTraps, VectorsTakeNumbersRangesAndWhatIsFree) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.nail("box", 0.5).position({1, any, within(0.2, 0.4)});
  const Target target = edit.constraints()[0].targets[0];
  EXPECT_EQ(target.value[0], 1);
  EXPECT_TRUE(target.value[1].isFree());
  EXPECT_TRUE(target.value[2].isFree());
  EXPECT_EQ(target.min[2], 0.2);
  EXPECT_EQ(target.max[2], 0.4);
  EXPECT_TRUE(target.min[1].isFree());
}

}  // namespace
}  // namespace carom

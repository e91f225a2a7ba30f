// SPDX-License-Identifier: MIT
// An edit with everything that it can be asked and told: ranges, spans of time, progress, other solutions, a certificate,
// and why another edit cannot be solved.
#include <cstdio>
#include <stop_token>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  scene.materials = {{.name = "court", .elasticity = 0.7, .friction = 0.4}};
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);

  Edit edit(scene, contacts, 2);
  Control throw_it = velocity("ball");
  throw_it.only({"x", "z"}).within(-6, 6).weighted(2);
  edit.vary(throw_it);
  const When early = between(0.9, 1.1);  // the edit chooses the moment
  const Wanted far = atLeast(3.5);
  constexpr Free sideways = any;
  edit.nail("ball", early).position(far, sideways, within(0.3, 0.5));
  for (const Constraint& held : edit.constraints()) {
    const Target& target = held.targets[0];
    int free = 0;
    for (const TargetNumber& number : target.value) free += number.isFree();  // left open, or in a range
    std::printf("%s of %s is held, %d of its components as numbers\n", target.quantity.c_str(), held.body.c_str(),
                static_cast<int>(target.value.size()) - free);
  }

  EditOptions options;
  options.second_derivatives = SecondDerivatives::exact;
  options.alternatives = 2;
  options.threads = 1;
  bool reported = false;
  options.progress = [&](const EditProgress& progress) { return reported = progress.iteration >= 0; };
  const EditResult result = edit.solve(options);
  if (result.status == EditStatus::cancelled) return 1;
  std::printf("%s; progress was reported: %s\n", result.solved() ? "solved" : "not solved", reported ? "yes" : "no");
  for (const EditAlternative& other : result.alternatives)
    std::printf("another solution is met as well: %s\n", other.scaled_residual <= options.tolerance ? "yes" : "no");
  for (const SequenceChange& change : result.sequence_changes) std::printf("%s\n", change.sentence.c_str());
  const Certificate& certificate = result.certificate;
  std::printf("energy drifts by less than 1e-12: %s\n", certificate.energy_drift < 1e-12 ? "yes" : "no");

  std::stop_source nobody_waits;  // a stop keeps the best so far; with `abandon` it ends sooner, without an answer
  options.stop = nobody_waits.get_token();
  options.abandon = true;
  nobody_waits.request_stop();
  try {
    edit.solve(options);
  } catch (const EditAbandoned& why) {
    std::printf("%s\n", why.what());
  }

  Edit beyond(scene, contacts, 2);
  beyond.vary(velocity("ball").only({"x"}));
  beyond.nail("ball", 0.2).position({any, any, 5});  // no speed along x takes the ball up there
  const EditResult failed = beyond.solve();
  const WhyNot& why = failed.why_not;
  std::printf("%s: %d constrained number, of rank %d\n", nameOf(failed.status), why.rows, why.rank);
}

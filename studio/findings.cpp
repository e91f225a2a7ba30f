// SPDX-License-Identifier: MIT
#include "studio/findings.h"

#include <exception>
#include <utility>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "studio/sketch.h"

namespace carom::studio {
namespace {

void put(Mailbox& mailbox, Findings findings, const std::stop_token& stop) {
  if (!stop.stop_requested()) mailbox.put({0, {0, Found{std::make_shared<const Findings>(std::move(findings))}}});
}

/// What goes wrong is an answer, too.
template <class Find>
void answering(Mailbox& mailbox, std::int64_t question, const std::stop_token& stop, const Find& find) {
  Findings findings;
  findings.question = question;
  try {
    find(findings);
  } catch (const std::exception& error) {
    findings = Findings();
    findings.question = question, findings.problem = error.what();
  }
  findings.more = false;
  put(mailbox, std::move(findings), stop);
}

}  // namespace

void findRemedies(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const std::stop_token& stop) {
  answering(mailbox, question, stop, [&](Findings& findings) {
    OdeContacts contacts(snapshot.content.scene);
    findings.more = true;
    const auto told = [&](const SessionWhyNot& why) {
      findings.why = why;
      put(mailbox, findings, stop);
    };
    findings.why = whyNot(snapshot, contacts, told, stop);
  });
}

void findAlternatives(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, int most,
                      const std::stop_token& stop) {
  answering(mailbox, question, stop, [&](Findings& findings) {
    OdeContacts contacts(snapshot.content.scene);
    findings.others = alternativesTo(snapshot, contacts, most, stop);
    for (const EditAlternative& other : findings.others.found) {
      if (stop.stop_requested()) return;
      Motion motion = simulate(other.scene, contacts, snapshot.content.duration);
      findings.motions.push_back(std::make_shared<const MotionView>(viewOf(motion)));
    }
  });
}

void findFaceUpFor(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const FaceUp& wanted,
                   const std::stop_token& stop) {
  answering(mailbox, question, stop, [&](Findings& findings) {
    OdeContacts contacts(snapshot.content.scene);
    findings.more = true;
    const auto tell = [&](int tried) {
      findings.face.tried = tried;
      put(mailbox, findings, stop);
    };
    findings.face = findFaceUp(snapshot, contacts, wanted, tell, stop);
  });
}

void findSketchFor(Mailbox& mailbox, std::int64_t question, const SessionSnapshot& snapshot, const Sketch& wanted,
                   const std::stop_token& stop) {
  answering(mailbox, question, stop, [&](Findings& findings) {
    OdeContacts contacts(snapshot.content.scene);
    findings.more = true;
    const auto tell = [&](const std::shared_ptr<const Motion>& motion) {
      findings.first = motion;
      put(mailbox, findings, stop);
    };
    findings.fitted = fitSketch(snapshot, contacts, wanted, tell, stop);
  });
}

}  // namespace carom::studio

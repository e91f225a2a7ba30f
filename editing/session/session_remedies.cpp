// SPDX-License-Identifier: MIT
// What would help a gesture that did not reach its target: found by first derivatives, tried by solving.
#include "editing/session_remedies.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "adjoint/base/errors.h"
#include "adjoint/base/names.hpp"
#include "editing/detail/messages.hpp"
#include "editing/edit.h"
#include "editing/session/session_words.hpp"
#include "editing/session_numbers.h"

namespace carom {
using namespace editing_detail;
using adjoint_detail::nameIn;

const char* nameOf(SessionRemedy::Kind kind) { return nameIn({"vary", "widen", "release"}, kind); }

namespace {

using RemedyKind = SessionRemedy::Kind;

/// What removes less of the error than this is not offered.
constexpr double kSomeRemedy = 0.02;
/// Tried at most, and how long each may take.
constexpr std::size_t kMostRemedies = 6;
constexpr double kTrySeconds = 0.5;
/// Iterations of a trial from where the gesture ended, within its impact sequence.
constexpr int kNearIterations = 60;
/// A bound that is moved goes to a value of so many digits.
constexpr int kBoundDigits = 3;

/// The same with more to vary; into a control of the same kind where that has no bounds of its own for each component.
void addControl(std::vector<Control>& controls, const Control& more) {
  for (Control& known : controls) {
    const bool same = known.vary == more.vary && known.body == more.body && known.material == more.material && known.vary != "tilt";
    if (!same || known.components.empty() || known.min.size() > 1 || known.max.size() > 1) continue;
    known.components.insert(known.components.end(), more.components.begin(), more.components.end());
    return;
  }
  controls.push_back(more);
}

/// One bound each, of a control that has one for all.
std::vector<double>& eachBound(Control& control, const Scene& scene, bool upper, const std::string& component, std::size_t& index) {
  std::vector<std::string> names;
  for (const SessionNumber& n : sessionNumbers(scene, {control}))
    if (n.varies) names.push_back(n.component);
  index = static_cast<std::size_t>(std::find(names.begin(), names.end(), component) - names.begin());
  std::vector<double>& bounds = upper ? control.max : control.min;
  if (bounds.size() == 1) bounds.assign(names.size(), bounds[0]);
  return bounds;
}

/// Without the bound of a component; false where it has none of its own.
bool setBound(std::vector<Control>& controls, const Scene& scene, const WhyNot::AtBound& at, double value) {
  Control& control = controls[static_cast<std::size_t>(at.control)];
  if (control.vary == "tilt") return false;  // a cone
  std::size_t index = 0;
  std::vector<double>& bounds = eachBound(control, scene, at.upper, at.component, index);
  if (index >= bounds.size()) return false;
  bounds[index] = value;
  return true;
}

/// The first value of few digits that is no nearer to the middle.
double outward(double value, bool upper) {
  char text[32];
  const auto rounded = [&](double x) {
    std::snprintf(text, sizeof text, "%.*e", kBoundDigits - 1, x);
    return std::strtod(text, nullptr);
  };
  const double near = rounded(value);
  if (upper ? near >= value : near <= value) return near;
  const std::string power = std::string(text).substr(std::string(text).find('e'));
  const double unit = std::strtod(("1" + power).c_str(), nullptr) / 100;  // of the last digit
  return rounded(near + (upper ? unit : -unit));
}

/// What is kept beside each remedy.
struct OfRemedy {
  std::vector<WhyNot::AtBound> widened;
  bool far = false;  ///< behind the others
};

class Remedies {
 public:
  Remedies(const SessionSnapshot& snapshot, ContactSource& contacts, const std::function<void(const SessionWhyNot&)>& told,
           std::stop_token stop)
      : snapshot_(snapshot), contacts_(contacts), told_(told), stop_(std::move(stop)) {}

  SessionWhyNot answer() {
    const EditResult nearest = diagnosed();
    const WhyNot& why = nearest.why_not;
    if (!why.inside.empty())
      out_.sentence = why.sentences.empty() ? nearest.message : why.sentences[0];
    else if (nearest.status == EditStatus::infeasible)
      out_.sentence = nearest.message;
    if (why.inside.empty()) {
      offerBounds(why);
      offerReleases(nearest);
      offerControls(why);
    }
    sort();
    if (out_.remedies.size() > kMostRemedies) out_.remedies.resize(kMostRemedies), more_.resize(kMostRemedies);
    tell();
    for (std::size_t i = 0; i < out_.remedies.size() && !stop_.stop_requested(); ++i) {
      attempt(i);
      tell();
    }
    sort();
    if (out_.remedies.empty() && out_.sentence.empty()) out_.sentence = "No other number of the scene would help, to first order.";
    return out_;
  }

 private:
  struct Asked {
    std::vector<Control> controls;
    std::vector<Constraint> wanted;
  };

  EditResult solved(const Scene& from, const Asked& asked, const EditOptions& options) const {
    const Edit edit(from, contacts_, snapshot_.content.duration, asked.controls, asked.wanted);
    return edit.solve(options);
  }
  EditOptions options() const {
    EditOptions options;
    options.tolerance = snapshot_.tolerance;
    options.threads = 1;
    options.certify = options.explain = false;
    options.time_budget_seconds = kTrySeconds;
    options.stop = stop_;
    return options;
  }
  /// Where the gesture ended, without a step.
  EditResult diagnosed() const {
    EditOptions none = options();
    none.max_iterations = 0, none.explain = true;
    none.time_budget_seconds = std::numeric_limits<double>::infinity();
    none.sequence = SequencePolicy::stay;
    return solved(snapshot_.content.scene, {snapshot_.content.controls, snapshot_.wanted}, none);
  }

  void offer(RemedyKind kind, const std::string& name, double removes, SessionContent content, OfRemedy more = {}) {
    out_.remedies.push_back({kind, name, removes, false, false, std::move(content)});
    more_.push_back(std::move(more));
  }

  void offerControls(const WhyNot& why) {
    for (const WhyNot::Help& help : why.would_help) {
      SessionContent content = snapshot_.content;
      addControl(content.controls, help.control);
      const std::string what = help.control.vary == "gravity" ? help.name : "the " + help.name;
      offer(RemedyKind::vary, "Let " + what + " change", help.removes, std::move(content), {{}, isFar(help.control)});
    }
  }

  void offerBounds(const WhyNot& why) {
    std::vector<WhyNot::AtBound> all;
    SessionContent without = snapshot_.content;
    for (const WhyNot::AtBound& at : why.at_bounds) {
      const double none = at.upper ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
      SessionContent content = snapshot_.content;
      if (!setBound(content.controls, content.scene, at, none)) continue;
      setBound(without.controls, without.scene, at, none);
      all.push_back(at);
      if (at.removes < kSomeRemedy) continue;
      offer(RemedyKind::widen, "Widen the bound of the " + at.name, at.removes, std::move(content), {{at}, false});
    }
    if (all.size() < 2) return;
    std::vector<std::string> names;
    double removes = 0;
    for (const WhyNot::AtBound& at : all) names.push_back(at.name), removes = std::max(removes, at.removes);
    offer(RemedyKind::widen, "Widen the bounds of the " + listOf(names), removes, std::move(without), {all, false});
  }

  void offerReleases(const EditResult& nearest) {
    std::set<int> against;
    for (const WhyNot::Conflict& conflict : nearest.why_not.conflicts)
      for (const int row : conflict.rows) against.insert(nearest.residuals[static_cast<std::size_t>(row)].constraint);
    for (const int constraint : against) {
      if (constraint < 0 || isGoal(constraint)) continue;
      const auto i = static_cast<std::size_t>(constraint);
      SessionContent content = snapshot_.content;
      std::erase_if(content.nails, [&](const auto& nail) { return nail.first == snapshot_.nails[i]; });
      offer(RemedyKind::release, "Release the nail of " + wordsOf(snapshot_.wanted[i]), 1, std::move(content));
    }
  }

  /// What is rarely meant: gravity, tilts, and what stands still.
  bool isFar(const Control& control) const {
    const auto& bodies = snapshot_.content.scene.bodies;
    const auto body = std::ranges::find(bodies, control.body, &Body::name);
    return control.vary == "gravity" || control.vary == "tilt" || (body != bodies.end() && body->fixed);
  }

  /// A target that alone is asked for is no nail to be released.
  bool isGoal(int constraint) const {
    const auto i = static_cast<std::size_t>(constraint);
    return i >= snapshot_.nails.size() || snapshot_.nails[i] == NailId() || snapshot_.wanted.size() == 1;
  }

  /// What remains wanted with a remedy.
  Asked askedWith(const SessionContent& content) const {
    Asked asked{content.controls, {}};
    for (std::size_t i = 0; i < snapshot_.wanted.size(); ++i) {
      const NailId id = snapshot_.nails[i];
      const bool there = std::ranges::any_of(content.nails, [&](const auto& nail) { return nail.first == id; });
      if (id == NailId() || there) asked.wanted.push_back(snapshot_.wanted[i]);
    }
    return asked;
  }

  /// Solves with a remedy: from where the gesture began, so that the change stays small, else on from where it ended.
  void attempt(std::size_t i) {
    SessionRemedy& remedy = out_.remedies[i];
    const Asked asked = askedWith(remedy.content);
    EditOptions search = options();
    search.effort = Effort::fast;
    search.sequence = snapshot_.sequence;
    EditOptions near = options();
    near.sequence = SequencePolicy::stay;
    near.max_iterations = kNearIterations;
    for (const bool from_end : {false, true}) {
      const Scene& from = from_end ? snapshot_.content.scene : snapshot_.began;
      std::optional<EditResult> result;
      try {
        result = solved(from, asked, from_end ? near : search);
      } catch (const InputError&) {  // such as a nail of a body that this scene does not have there
        continue;
      }
      remedy.tried = !stop_.stop_requested();
      if (!result->solved()) continue;
      remedy.solves = true;
      remedy.content.scene = result->scene;
      break;
    }
    if (remedy.solves) keepTargets(remedy.content);
    putBounds(i);
  }

  /// Nails that the gesture could not leave at its target are there now.
  void keepTargets(SessionContent& content) const {
    for (auto& [id, constraint] : content.nails)
      for (std::size_t i = 0; i < snapshot_.nails.size(); ++i)
        if (snapshot_.nails[i] == id) constraint = snapshot_.wanted[i];
  }

  /// Bounds as wide as the solution needs, or none where there is none.
  void putBounds(std::size_t i) {
    SessionRemedy& remedy = out_.remedies[i];
    if (more_[i].widened.empty() || !remedy.solves) return;
    const std::vector<SessionNumber> numbers = sessionNumbers(remedy.content.scene, remedy.content.controls);
    std::vector<std::string> values;
    for (const WhyNot::AtBound& at : more_[i].widened) {
      const auto is = [&](const SessionNumber& n) { return n.control == at.control && n.component == at.component; };
      const auto number_of = std::ranges::find_if(numbers, is);
      if (number_of == numbers.end()) continue;
      const double reached = outward(number_of->value, at.upper);
      const double bound = at.upper ? std::max(at.bound, reached) : std::min(at.bound, reached);
      setBound(remedy.content.controls, remedy.content.scene, at, bound);
      if (bound != at.bound) values.push_back(at.name + " go to " + brief(bound));
    }
    if (!values.empty()) remedy.name = "Let " + listOf(values);
  }

  void sort() {
    std::vector<std::size_t> order(out_.remedies.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const SessionRemedy &x = out_.remedies[a], &y = out_.remedies[b];
      const auto rank = [](const SessionRemedy& one, bool far) { return std::tuple(!one.solves, far, -std::lround(20 * one.removes)); };
      return rank(x, more_[a].far) < rank(y, more_[b].far);
    });
    std::vector<SessionRemedy> remedies;
    std::vector<OfRemedy> more;
    for (const std::size_t i : order) remedies.push_back(std::move(out_.remedies[i])), more.push_back(std::move(more_[i]));
    out_.remedies = std::move(remedies), more_ = std::move(more);
  }

  void tell() const {
    if (told_ && !stop_.stop_requested()) told_(out_);
  }

  const SessionSnapshot& snapshot_;
  ContactSource& contacts_;
  const std::function<void(const SessionWhyNot&)>& told_;
  const std::stop_token stop_;
  SessionWhyNot out_;
  std::vector<OfRemedy> more_;
};

}  // namespace

SessionWhyNot whyNot(const SessionSnapshot& snapshot, ContactSource& contacts,
                     const std::function<void(const SessionWhyNot&)>& told, std::stop_token stop) {
  if (snapshot.reached || snapshot.wanted.empty()) return {};
  return Remedies(snapshot, contacts, told, std::move(stop)).answer();
}

}  // namespace carom

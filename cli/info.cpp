// SPDX-License-Identifier: MIT
// carom info: how a scene is computed, and why; without a scene, the program itself.
#include <CLI/App.hpp>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <memory>

#include "adjoint/scene/body_model.h"
#include "carom/version.h"
#include "cli/build_facts.h"
#include "cli/command.h"
#include "cli/components.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/table.h"
#include "formats/answers/info_json.hpp"
#include "formats/answers/status_json.hpp"
#include "formats/export/export_motion.h"
#include "formats/json/json_writer.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr std::size_t kMostPairs = 6;    // named in a line of text; --json has all
constexpr std::size_t kMostBodies = 50;  // of a table; --json has all

const char* wordOf(Combine rule) {
  constexpr const char* kWords[] = {"average", "minimum", "maximum", "product"};
  return kWords[static_cast<int>(rule)];
}

/// "0.45, the average of 0.6 ('wood') and 0.3 ('felt')"
std::string explain(const Output& out, double value, Combine rule_a, double a, const std::string& name_a,
                    Combine rule_b, double b, const std::string& name_b) {
  if (name_a == name_b && rule_a != Combine::multiply) return out.number(value) + " of both";
  const auto quoted = [](const std::string& name) { return name.empty() ? "no material" : "'" + name + "'"; };
  return out.number(value) + ", the " + wordOf(std::min(rule_a, rule_b)) + " of " + out.number(a) + " (" +
         quoted(name_a) + ") and " + out.number(b) + " (" + quoted(name_b) + ")";
}

ScenePlan::Pair pairOf(const Output& out, const Scene& scene, int a, int b) {
  const Body &body_a = scene.bodies[static_cast<std::size_t>(a)], &body_b = scene.bodies[static_cast<std::size_t>(b)];
  const Material &m = materialOf(scene, body_a), &n = materialOf(scene, body_b);
  ScenePlan::Pair pair;
  pair.a = a, pair.b = b;
  pair.coefficients = combine(m, n);
  pair.law = lawOf(pair.coefficients);
  pair.why = pair.law == Law::friction ? "friction > 0: sticks or slides (equation 4.2)"
                                       : "friction 0: an impulse along the normal only (equation 4.1)";
  pair.elasticity_why = explain(out, pair.coefficients.elasticity, m.combine_elasticity, m.elasticity, m.name,
                                n.combine_elasticity, n.elasticity, n.name);
  pair.friction_why = explain(out, pair.coefficients.friction, m.combine_friction, m.friction, m.name,
                              n.combine_friction, n.friction, n.name);
  return pair;
}

std::vector<ScenePlan::Lasting> lastingOf(const Scene& scene) {
  std::vector<ScenePlan::Lasting> lasting(scene.bodies.size());
  const bool carries = std::ranges::any_of(scene.bodies, [](const Body& body) {
    return (body.kinematic && !(body.velocity.isZero(0) && body.angular_velocity.isZero(0))) || body.surfaceMoves();
  });
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.immovable()) continue;
    lasting[i] = {{ArcKind::rest, ArcKind::slide, ArcKind::roll, ArcKind::pivot}, "moves with more than 7 others at once, or at more than 36 contacts"};
    if (carries) lasting[i].kinds.push_back(ArcKind::ride);
  }
  return lasting;
}

ScenePlan planOf(const Output& out, Loaded& loaded) {
  const Document& document = loaded.document;
  const Scene& scene = document.scene;
  const EditProblem problem = inFile(loaded.path, [&] {
    return EditProblem(scene, loaded.contacts, document.duration, document.controls, document.constraints);
  });
  ScenePlan plan;
  plan.controls = problem.controls.size();
  plan.rows = problem.constraints.size();
  const bool edits = plan.controls > 0 && plan.rows > 0;
  plan.asked = edits ? "edit" : "simulate";
  plan.plan = makePlan(scene, edits ? problem.asked : std::vector<Asked>{});
  plan.lasting = lastingOf(scene);
  plan.components = componentsAtStart(scene, loaded.contacts);  // which looks for overlaps, too
  plan.overlaps = loaded.contacts.overlaps();
  const int count = static_cast<int>(scene.bodies.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if (mayCollide(scene.bodies[static_cast<std::size_t>(a)], scene.bodies[static_cast<std::size_t>(b)]))
        plan.pairs.push_back(pairOf(out, scene, a, b));
  return plan;
}

/// A text of a document as it can stand in a terminal, every line of it indented.
std::string indented(const std::string& text) {
  std::string lines = "  ";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < ' ' || c == 0x7f;
    lines += c == '\n' ? "\n  " : std::string(1, control ? ' ' : c);
  }
  return lines + '\n';
}

void printNotes(Output& out, const Document& document) {
  if (!document.notes.empty()) out.text() << indented(document.notes);
  for (const Body& body : document.scene.bodies)
    if (!body.notes.empty()) out.text() << indented("'" + body.name + "': " + body.notes);
}

void sayMoreBodies(Output& out, const Scene& scene) {
  if (scene.bodies.size() > kMostBodies)
    out.text() << "  and " << scene.bodies.size() - kMostBodies << " more; --json has all\n";
}

void printBodies(Output& out, const Scene& scene, const ScenePlan& plan) {
  out.text() << "\nBodies, with the flight model that is exact for what the " << plan.asked << " requires:\n";
  Table table({"body", "motion", "because", "derivatives", "because"});
  for (std::size_t i = 0; i < std::min(scene.bodies.size(), kMostBodies); ++i) {
    const BodyPlan& body = plan.plan.bodies[i];
    table.row({scene.bodies[i].name, nameOf(body.tier), body.why, nameOf(body.derivative_tier), body.derivative_why});
  }
  table.print(out);
  sayMoreBodies(out, scene);
}

void printShapes(Output& out, const Scene& scene) {
  out.text() << "\nShapes, and mass properties in their axes:\n";
  Table table({"body", "shape", ">mass [kg]", "centre of mass [m]", "principal moments [kg m^2]"});
  for (std::size_t i = 0; i < std::min(scene.bodies.size(), kMostBodies); ++i) {
    const Body& body = scene.bodies[i];
    const BodyModel model = body.fixed ? BodyModel() : modelOf(body);
    table.row({body.name, kindOf(body.shape).name, body.fixed ? "fixed" : body.kinematic ? "kinematic" : out.number(model.mass),
               body.fixed ? "" : out.vector(model.center), body.immovable() ? "" : out.vector(model.inertia)});
  }
  table.print(out);
  sayMoreBodies(out, scene);
}

void printSurfaces(Output& out, const Scene& scene) {
  const auto moving = std::ranges::count_if(scene.bodies, &Body::surfaceMoves);
  if (moving == 0) return;
  out.text() << "\nSurfaces that move, in the axes of their shapes:\n";
  Table table({"body", "velocity [m/s]", "angular velocity [rad/s]"});
  for (const Body& body : scene.bodies)
    if (body.surfaceMoves()) table.row({body.name, out.vector(body.surface_velocity), out.vector(body.surface_angular_velocity)});
  table.print(out);
}

/// Names with what is said of each, in the order in which it was first said.
class Sayings {
 public:
  void add(const std::string& name, const std::string& text) {
    auto& names = names_[text];
    if (names.empty()) order_.push_back(text);
    names.push_back(name);
  }
  bool empty() const { return order_.empty(); }
  void print(Output& out) const {
    for (const std::string& text : order_) {
      const auto& names = names_.at(text);
      out.text() << "  ";
      for (std::size_t i = 0; i < std::min(names.size(), kMostPairs); ++i)
        out.text() << (i > 0 ? ", " : "") << names[i];
      if (names.size() > kMostPairs) out.text() << " and " << names.size() - kMostPairs << " more";
      out.text() << '\n' << text;
    }
  }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::vector<std::string>> names_;
};

// Pairs of the same materials have the same law and coefficients.
void printPairs(Output& out, const Scene& scene, const ScenePlan& plan) {
  out.text() << "\nPairs that can touch, with their impact law:\n";
  Sayings laws;
  for (const ScenePlan::Pair& pair : plan.pairs)
    laws.add(scene.bodies[static_cast<std::size_t>(pair.a)].name + "-" +
                 scene.bodies[static_cast<std::size_t>(pair.b)].name,
             "    " + pair.why + "\n    elasticity " + pair.elasticity_why + "\n    friction " + pair.friction_why +
                 "\n    tangential elasticity " + out.number(pair.coefficients.tangential_elasticity) + "\n");
  laws.print(out);
  if (laws.empty()) out.text() << "  none\n";
  out.text() << "  Contacts of one instant are solved simultaneously (equation 4.4).\n";
}

void printLasting(Output& out, const Scene& scene, const ScenePlan& plan) {
  Sayings all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const ScenePlan::Lasting& lasting = plan.lasting[i];
    if (lasting.kinds.empty()) continue;
    std::vector<std::string> kinds;
    for (const ArcKind kind : lasting.kinds) kinds.push_back(nameOf(kind));
    all.add(scene.bodies[i].name, "    " + joined(kinds, ", ") + "; the motion ends where it " + lasting.ends + "\n");
  }
  if (all.empty()) return;
  out.text() << "\nPersistent contact with fixed bodies and with others (section 11 of the equations):\n";
  all.print(out);
}

void printComponents(Output& out, const Scene& scene, const ScenePlan& plan) {
  if (plan.components.empty()) return;
  out.text() << "\nBodies on each other at the start:\n";
  for (const ScenePlan::Component& component : plan.components) {
    std::vector<std::string> names;
    for (const int body : component.bodies) names.push_back(scene.bodies[static_cast<std::size_t>(body)].name);
    const std::size_t more = names.size() > kMostBodies ? names.size() - kMostBodies : 0;
    names.resize(names.size() - more);
    out.text() << "  " << joined(names, ", ") << (more > 0 ? " and " + std::to_string(more) + " more" : "") << "\n    "
               << (component.rests ? "rest: " : component.ends ? "end the motion: " : "move on each other: ") << component.why << "\n";
  }
}

void printOverlaps(Output& out, const Scene& scene, const ScenePlan& plan) {
  if (plan.overlaps.empty()) return;
  out.text() << "\nBodies that overlap at the start, and do not collide until they have separated:\n";
  for (const StartOverlap& o : plan.overlaps)
    out.text() << "  " << scene.bodies[static_cast<std::size_t>(o.a)].name << "-"
               << scene.bodies[static_cast<std::size_t>(o.b)].name << " by " << out.number(o.depth) << " m\n";
}

Exit describeScene(const std::string& path, Output& out) {
  Loaded loaded(out, path);
  const ScenePlan plan = planOf(out, loaded);
  if (out.json()) {
    out.document(infoJson(loaded.document, plan));
    return Exit::done;
  }
  const Document& document = loaded.document;
  out.text() << loaded.path << ": " << (document.name.empty() ? "" : quotedText(document.name) + ", ")
             << out.number(document.duration) << " s, " << counted(plan.controls, "control parameter") << ", "
             << counted(plan.rows, "constrained quantity", "constrained quantities") << '\n';
  printNotes(out, document);
  printShapes(out, document.scene);
  printSurfaces(out, document.scene);
  printBodies(out, document.scene, plan);
  printPairs(out, document.scene, plan);
  printLasting(out, document.scene, plan);
  printComponents(out, document.scene, plan);
  printOverlaps(out, document.scene, plan);
  return Exit::done;
}

ProgramInfo programInfo() {
  const BuildFacts facts = buildFacts();
  ProgramInfo info;
  info.version = kVersion;
  info.build = facts.type;
  info.compiler = facts.compiler;
  info.libraries = {{"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                                  std::to_string(EIGEN_MINOR_VERSION)},
                    {"Open Dynamics Engine", facts.ode},
                    {"Ipopt", facts.ipopt},
                    {"CLI11", CLI11_VERSION}};
  info.exports = exportExtensions();
  return info;
}

Exit describeProgram(Output& out) {
  const ProgramInfo info = programInfo();
  if (out.json()) {
    out.document(programJson(info));
    return Exit::done;
  }
  out.text() << "carom " << info.version << ", " << info.build << " build by " << info.compiler << "\nlibraries:";
  for (const ProgramInfo::Library& library : info.libraries)
    out.text() << (&library == &info.libraries.front() ? " " : ", ") << library.name << " " << library.version;
  out.text() << "\nreads:     scene documents (JSON), version " << info.scene_format << "\nwrites:   ";
  for (const std::string& extension : info.exports) out.text() << " " << extension;
  out.text() << " (carom export), scene documents (carom edit -o)\n";
  return Exit::done;
}

Action declareInfo(CLI::App& app) {
  const auto scene = std::make_shared<std::string>();
  addScene(app, *scene, false);
  return [scene](Output& out) { return scene->empty() ? describeProgram(out) : describeScene(*scene, out); };
}

}  // namespace

const Command kInfoCommand{
    "info", "How a scene is computed, and why; or version and build",
    "For a scene: the shape and mass properties of every body, its flight model, for motion and for\n"
    "derivatives, the impact law and the combined coefficients of every pair that can touch, each with its\n"
    "reason, the persistent contacts that each body supports, and the numbers of controls and constraints.\n"
    "Without a scene: version, build, libraries and formats.\n"
    "\n"
    "Examples:\n"
    "  carom info scene.json\n"
    "  carom info --json",
    declareInfo};

}  // namespace carom::cli

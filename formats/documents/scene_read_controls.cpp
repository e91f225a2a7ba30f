// SPDX-License-Identifier: MIT
#include <algorithm>

#include "editing/problem/controls/control_kinds.hpp"
#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

using namespace editing_detail;

namespace {

/// Which members beside vary, components, min, max and weight a control of this owner has.
struct OwnerMembers {
  bool body, material, impact;
};

OwnerMembers membersOf(OwnerKind owner) {
  return {owner == OwnerKind::body || owner == OwnerKind::moving_body || owner == OwnerKind::free_body ||
              owner == OwnerKind::immovable_body || owner == OwnerKind::impact,
          owner == OwnerKind::material, owner == OwnerKind::impact};
}

void requireMember(const Json& value, const char* member, bool wanted, const std::string& where) {
  const std::string control = "a control of " + value["vary"].get<std::string>();
  if (wanted && !value.contains(member))
    fail(where, "no member \"" + std::string(member) + "\"", "one, as for every " + control.substr(2));
  if (!wanted && value.contains(member))
    fail(pointerTo(where, member), describe(value[member]), control + " without \"" + member + "\"");
}

ControlOwner readOwner(const Json& value, OwnerKind kind, const Scene& scene, const std::string& where) {
  ControlOwner owner;
  if (value.contains("body")) {
    owner.body = readBodyName(value["body"], where + "/body", scene);
    const Body& body = scene.bodies[static_cast<std::size_t>(owner.body)];
    if (kind == OwnerKind::immovable_body && !body.immovable())
      fail(where + "/body", describe(value["body"]) + ", a body that impacts move", "a fixed or kinematic body");
    if (kind != OwnerKind::body && kind != OwnerKind::immovable_body && body.fixed)
      fail(where + "/body", "the fixed body " + describe(value["body"]), "a moving body");
    if (kind == OwnerKind::free_body && body.kinematic)
      fail(where + "/body", "the kinematic body " + describe(value["body"]), "a dynamic body");
  }
  if (value.contains("material")) {
    const auto name = value["material"].get<std::string>();
    const auto& all = scene.materials;
    const auto named = std::find_if(all.begin(), all.end(), [&](const Material& m) { return m.name == name; });
    if (named == all.end()) failUnknownMaterial(where + "/material", name, scene);
    owner.material = static_cast<int>(named - all.begin());
  }
  return owner;
}

std::vector<std::string> readComponents(const Json& value, const std::vector<std::string>& known,
                                        const std::string& where) {
  std::vector<std::string> names;
  const auto list = value.find("components");
  if (list == value.end()) return names;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto name = (*list)[i].get<std::string>();
    const std::string place = pointerTo(where + "/components", i);
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail(place, quotedText(name), "a component of " + value["vary"].get<std::string>() + ": " + expectedOf(name, known));
    if (std::find(names.begin(), names.end(), name) != names.end())
      fail(place, quotedText(name) + " a second time", "every component once");
    names.push_back(name);
  }
  return names;
}

std::vector<double> readBound(const Json& value, const char* member, std::size_t count, const std::string& where) {
  const auto bound = value.find(member);
  if (bound == value.end()) return {};
  if (bound->is_number()) return {bound->get<double>()};
  if (bound->size() != count)
    fail(pointerTo(where, member), describe(*bound),
         "a number, or an array of " + std::to_string(count) + ", one for each component that varies");
  return bound->get<std::vector<double>>();
}

void requireOrder(const Control& control, const std::string& where) {
  if (control.min.empty() || control.max.empty()) return;
  const std::size_t count = std::max(control.min.size(), control.max.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double lo = control.min[control.min.size() == 1 ? 0 : i];
    const double hi = control.max[control.max.size() == 1 ? 0 : i];
    if (!(lo <= hi)) fail(where + "/min", numberText(lo), "a number <= max, which is " + numberText(hi));
  }
}

void requireCone(const Json& value, const std::string& where) {
  requireMember(value, "min", false, where);
  const auto cone = value.find("max");
  if (cone != value.end() && !(cone->is_number() && cone->get<double>() >= 0))
    fail(where + "/max", describe(*cone), "the cone of a tilt, a number >= 0");
}

Control readControl(const Json& value, const Scene& scene, const std::string& where) {
  Control control;
  control.vary = value["vary"].get<std::string>();
  const ControlKind* kind = findControlKind(control.vary);
  if (kind == nullptr) fail(where + "/vary", describe(value["vary"]), "a kind of control of this version");
  const OwnerMembers members = membersOf(kind->owner);
  requireMember(value, "body", members.body, where);
  requireMember(value, "material", members.material, where);
  requireMember(value, "impact", members.impact, where);
  if (members.impact) requireCone(value, where);

  const ControlOwner owner = readOwner(value, kind->owner, scene, where);
  const std::vector<std::string> known = kind->components(scene, owner);
  if (known.empty()) fail(where + "/body", describe(value["body"]), "a body that has a " + control.vary);
  if (members.body) control.body = value["body"].get<std::string>();
  if (members.material) control.material = value["material"].get<std::string>();
  if (members.impact) control.impact = value["impact"].get<int>();
  control.components = readComponents(value, known, where);
  const std::size_t count = control.components.empty() ? known.size() : control.components.size();
  control.min = readBound(value, "min", count, where);
  control.max = readBound(value, "max", count, where);
  requireOrder(control, where);
  control.weight = value.value("weight", control.weight);
  if (value.contains("distribution")) control.distribution = readDistribution(value["distribution"], count, where + "/distribution");
  control.notes = textOr(value, "notes");
  return control;
}

}  // namespace

std::vector<Control> readControls(const Json& document, const Scene& scene) {
  std::vector<Control> controls;
  const auto list = document.find("controls");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i)
    controls.push_back(readControl((*list)[i], scene, pointerTo("/controls", i)));
  return controls;
}

}  // namespace carom::formats_detail

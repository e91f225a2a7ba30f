// SPDX-License-Identifier: MIT
#include "studio/motion_page.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "adjoint/base/errors.h"
#include "formats/base/base64.hpp"
#include "formats/base/short_text.hpp"
#include "formats/json/json.hpp"
#include "studio/answers.h"
#include "studio/deflate.h"
#include "studio/frames.h"
#include "studio/page_modules.h"
#include "studio/views.h"

namespace carom::studio {
namespace {

using namespace formats_detail;

constexpr const char* kFirstModule = "exported/main.js";

const std::string& fileText(const PageFiles& files, const std::string& address) {
  const PageFile* file = files.find(address);
  if (file == nullptr) throw InputError("found no " + address + " in the page of the studio, expected it");
  return file->content;
}

constexpr std::array<std::pair<char, const char*>, 4> kOfHtml = {
    {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}}};

std::string packed(std::string_view bytes) { return base64(deflated(bytes)); }

std::string modulesText(const PageFiles& files) {
  Json modules = Json::object();
  for (auto& [name, text] : modulesFrom(files, kFirstModule)) modules[name] = text;
  return compactText(modules);
}

/// Paths of the motion before are drawn by the number of their body.
void requireSameBodies(const Scene& now, const Scene& before) {
  if (std::ranges::equal(now.bodies, before.bodies, {}, &Body::name, &Body::name)) return;
  throw InputError("found other bodies in the motion before than in the one that is exported, expected the same, in the same order");
}

}  // namespace

std::string motionPage(const PageFiles& files, const std::string& title, const ShownMotion& now,
                       const ShownMotion* before) {
  if (before != nullptr) requireSameBodies(*now.motion.scene, *before->motion.scene);
  const Scene& first = before != nullptr ? *before->motion.scene : *now.motion.scene;
  const std::vector<std::pair<std::string, std::string>> places = {
      {"{{title}}", escaped(title, kOfHtml)},
      {"{{style}}", fileText(files, "/style.css") + fileText(files, "/panels.css")},
      {"{{modules}}", packed(modulesText(files))},
      {"{{state}}", packed(stateOfMotion(now.document, now.motion, first))},
      {"{{scene}}", packed(sceneFrame(sceneViewOf(now.motion)))},
      {"{{motion}}", packed(motionFrame(viewOf(now.motion)))},
      {"{{before}}", before != nullptr ? packed(motionFrame(viewOf(before->motion))) : ""}};
  const std::string& form = fileText(files, "/exported/index.html");
  std::string page;
  std::size_t done = 0;
  while (done < form.size()) {
    const std::size_t open = form.find("{{", done), end = std::min(open, form.size());
    page.append(form, done, end - done);
    done = end;
    if (open == std::string::npos) break;
    const auto place = std::ranges::find_if(places, [&](const auto& one) { return form.compare(open, one.first.size(), one.first) == 0; });
    page += place != places.end() ? place->second : "{{";
    done += place != places.end() ? place->first.size() : 2;
  }
  return page;
}

}  // namespace carom::studio

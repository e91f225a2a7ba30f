// SPDX-License-Identifier: MIT
#include "studio/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/documents/scene_json.h"
#include "tests/studio/test_scene.h"

namespace carom::studio {

using Json = nlohmann::json;

namespace {

/// One of each message, with all of its members.
const std::map<std::string, Json>& examples() {
  static const std::map<std::string, Json> all = [] {
    const Json constraint = {{"body", "hat"}, {"at", 0.5}, {"position", {0.8, nullptr, 1.7}}};
    const Json control = {{"vary", "velocity"}, {"body", "hat"}, {"weight", 0.2}};
    const Json list = {
        {{"type", "hello"}, {"protocol", 1}, {"token", "abc"}, {"tab", "t1"}},
        {{"type", "prove"}, {"nonce", std::string(64, 'a')}},
        {{"type", "grab"},
         {"gesture", 4},
         {"body", "hat"},
         {"at", {{"impact", 1}, {"with", "coatrack"}}},
         {"grip", {{"orientation", true}, {"point", {0, 0, 0.1}}, {"components", {"x", "z"}}}},
         {"also_vary", {control}}},
        {{"type", "grab_nail"}, {"gesture", 4}, {"nail", 2}},
        {{"type", "keep_sequence"}, {"on", true}},
        {{"type", "why"}, {"rev", 3}},
        {{"type", "alternatives"}, {"rev", 3}, {"count", 4}},
        {{"type", "remedy"}, {"rev", 3}, {"name", "Let gravity change"}},
        {{"type", "adopt"}, {"rev", 3}, {"index", 2}},
        {{"type", "drag"}, {"gesture", 4}, {"seq", 9}, {"place", {0.8, 0, 1.7}}, {"orientation", {1, 0, 0, 0}}, {"components", {"x", "y"}}},
        {{"type", "release"},
         {"gesture", 4},
         {"seq", 31},
         {"place", {0.81, 0, 1.71}},
         {"orientation", {0, 1, 0, 0}},
         {"components", {"y", "z"}},
         {"nail", true}},
        {{"type", "cancel"}, {"gesture", 4}},
        {{"type", "undo"}},
        {{"type", "redo"}},
        {{"type", "stop"}},
        {{"type", "meet_nails"}},
        {{"type", "nail"}, {"constraint", constraint}},
        {{"type", "set_nail"}, {"nail", 0}, {"constraint", constraint}},
        {{"type", "nail_on"}, {"nail", 1}, {"on", false}},
        {{"type", "unnail"}, {"nail", 1}},
        {{"type", "controls"}, {"rev", 3}, {"controls", {control}}},
        {{"type", "set"}, {"rev", 12}, {"edits", {{{"pointer", "/bodies/2/velocity/0"}, {"value", 2.4}}}}},
        {{"type", "try"}, {"gesture", 4}, {"seq", 2}, {"rev", 12}, {"edits", {{{"pointer", "/bodies/2/velocity/0"}, {"value", 2.4}}}}},
        {{"type", "add_body"}, {"rev", 12}, {"body", {{"name", "ball"}, {"mass", 1}, {"shape", {{"sphere", {{"radius", 0.1}}}}}}}, {"on", {{"point", {0, 0, 1}}, {"normal", {0, 0, 2}}}}},
        {{"type", "remove_body"}, {"rev", 12}, {"body", "hat"}},
        {{"type", "copy_body"}, {"rev", 12}, {"body", "hat"}},
        {{"type", "rename_body"}, {"rev", 12}, {"body", "hat"}, {"name", "cap"}},
        {{"type", "new"}, {"replace", true}},
        {{"type", "open"}, {"path", "a/b.json"}, {"gallery", true}, {"replace", true}},
        {{"type", "save"}, {"path", "b.json"}, {"replace", true}},
        {{"type", "export"}, {"format", "html"}, {"before", true}, {"keys", "cubic"}},
        {{"type", "face_up"}, {"rev", 3}, {"body", "hat"}, {"up", {0, 0, 1}}, {"place", {0.1, 0.2}}, {"nail", true}},
        {{"type", "sketch"}, {"rev", 3}, {"body", "hat"}, {"from", 0.1}, {"places", {{0, 0, 1}, {0.1, 0, 1}}}},
        {{"type", "upload"}, {"name", "a.obj"}, {"at", 0}, {"data", "YWJj"}},
        {{"type", "import"}, {"path", "a.glb"}, {"as", "hull"}, {"replace", true}},
        {{"type", "list"}, {"path", "a"}, {"meshes", true}},
        {{"type", "gallery"}},
    };
    std::map<std::string, Json> named;
    for (Json message : list) {
      message["id"] = 17;
      named[message["type"]] = message;
    }
    return named;
  }();
  return all;
}

template <class What>
What read(const Json& message) {
  const Command command = readCommand(message.dump());
  EXPECT_EQ(command.id, 17);
  return std::get<What>(command.what);
}
template <class What>
What example(const std::string& type) {
  return read<What>(examples().at(type));
}

std::string errorOf(const std::string& text) {
  try {
    readCommand(text);
  } catch (const MessageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Protocol, ReadsEveryMessage) {
  const auto hello = example<Hello>("hello");
  EXPECT_EQ(hello.protocol, 1);
  EXPECT_EQ(hello.token + hello.tab, "abct1");
  EXPECT_EQ(example<Prove>("prove").nonce.size(), 64u);
  const auto grab = example<Grab>("grab");
  EXPECT_EQ(grab.gesture, 4);
  EXPECT_EQ(grab.body, "hat");
  EXPECT_EQ(grab.at.impact, 1);
  EXPECT_FALSE(grab.at.rest);
  EXPECT_EQ(grab.at.with, "coatrack");
  EXPECT_TRUE(grab.grip.orientation);
  EXPECT_EQ(grab.grip.body_point.value(), Vec3(0, 0, 0.1));
  EXPECT_EQ(grab.grip.components, (std::vector<std::string>{"x", "z"}));
  EXPECT_FALSE(grab.also_vary.empty());
  EXPECT_EQ(example<GrabNail>("grab_nail").nail, 2);
  EXPECT_TRUE(example<KeepSequence>("keep_sequence").on);
  EXPECT_EQ(example<Why>("why").rev, 3);
  EXPECT_EQ(example<Alternatives>("alternatives").count, 4);
  EXPECT_EQ(example<TakeRemedy>("remedy").name, "Let gravity change");
  EXPECT_EQ(example<Adopt>("adopt").index, 2);
  const auto drag = example<Drag>("drag");
  EXPECT_EQ(drag.gesture, 4);
  EXPECT_EQ(drag.seq, 9);
  EXPECT_EQ(drag.place, Vec3(0.8, 0, 1.7));
  EXPECT_EQ(drag.orientation.value().w(), 1);
  EXPECT_EQ(drag.components, (std::vector<std::string>{"x", "y"}));
  const auto release = example<Release>("release");
  EXPECT_EQ(release.seq, 31);
  EXPECT_EQ(release.place.value(), Vec3(0.81, 0, 1.71));
  EXPECT_EQ(release.orientation.value().x(), 1);
  EXPECT_TRUE(release.nail);
  EXPECT_EQ(release.components, (std::vector<std::string>{"y", "z"}));
  EXPECT_EQ(example<Cancel>("cancel").gesture, 4);
  example<Undo>("undo"), example<Redo>("redo"), example<Stop>("stop"), example<MeetNails>("meet_nails");
  EXPECT_FALSE(example<MakeNail>("nail").constraint.empty());
  EXPECT_EQ(example<SetNail>("set_nail").nail, 0);
  EXPECT_FALSE(example<NailOn>("nail_on").on);
  EXPECT_EQ(example<Unnail>("unnail").nail, 1);
  EXPECT_EQ(example<SetControls>("controls").rev, 3);
  const auto set = example<SetNumbers>("set");
  EXPECT_EQ(set.edits, (std::vector<std::pair<std::string, std::string>>{{"/bodies/2/velocity/0", "2.4"}}));
  const auto open = example<Open>("open");
  EXPECT_EQ(open.path, "a/b.json");
  EXPECT_TRUE(open.gallery && open.replace);
  EXPECT_EQ(example<Save>("save").path.value(), "b.json");
  EXPECT_EQ(example<List>("list").path, "a");
  EXPECT_TRUE(example<List>("list").meshes);
  example<Gallery>("gallery");
}

TEST(Protocol, MembersThatMayBeMissing) {
  const auto without = [](const std::string& type, std::initializer_list<const char*> members) {
    Json message = examples().at(type);
    for (const char* member : members) message.erase(member);
    return message;
  };
  EXPECT_TRUE(read<Grab>(without("grab", {"grip", "also_vary"})).also_vary.empty());
  EXPECT_FALSE(read<Drag>(without("drag", {"orientation"})).orientation.has_value());
  const auto release = read<Release>(without("release", {"place", "orientation", "components", "nail"}));
  EXPECT_FALSE(release.place || release.orientation || release.nail);
  EXPECT_FALSE(read<Open>(without("open", {"gallery", "replace"})).gallery);
  EXPECT_FALSE(read<Save>(without("save", {"path", "replace"})).path.has_value());
  EXPECT_EQ(read<List>(without("list", {"path"})).path, "");
  const auto nail = read<MakeNail>({{"type", "nail"}, {"id", 17}, {"body", "hat"}, {"at", 0.5}});
  EXPECT_EQ(nail.body, "hat");
  EXPECT_EQ(nail.at.time, 0.5);
  EXPECT_TRUE(nail.constraint.empty());
}

TEST(Protocol, EveryWrongMemberIsNamed) {
  for (const auto& [type, good] : examples()) {
    for (const auto& member : good.items()) {
      for (const Json& wrong : {Json(nullptr), Json({{"no", "such"}}), Json(Json::array({Json::array()}))}) {
        if (member.key() == "type") continue;
        Json bad = good;
        bad[member.key()] = wrong;
        const std::string error = errorOf(bad.dump());
        EXPECT_NE(error.find("/" + member.key()), std::string::npos) << type << ": " << bad.dump() << "\n" << error;
        EXPECT_NE(error.find("expected"), std::string::npos) << error;
      }
    }
    Json more = good;
    more["unknown"] = 1;
    EXPECT_NE(errorOf(more.dump()).find("unknown"), std::string::npos) << type;
    Json nameless = good;
    nameless.erase("id");
    EXPECT_NE(errorOf(nameless.dump()).find("\"id\""), std::string::npos) << type;
  }
}

TEST(Protocol, AGrabIsAtATimeAnImpactOrAtRest) {
  Json message = examples().at("grab");
  message["at"] = {{"rest", true}};
  EXPECT_TRUE(std::get<Grab>(readCommand(message.dump()).what).at.rest);
  message["at"] = 0.5;
  EXPECT_TRUE(std::get<Grab>(readCommand(message.dump()).what).at.isTime());
}

TEST(Protocol, AGrabMayHoldATurnAloneOrAContact) {
  Json message = examples().at("grab");
  message.erase("also_vary");
  message["free"] = true;
  message["grip"] = {{"orientation", true}, {"place", false}};
  const Grab turn = std::get<Grab>(readCommand(message.dump()).what);
  EXPECT_TRUE(turn.free && turn.grip.orientation && !turn.grip.place && !turn.grip.contact);
  message["grip"] = {{"contact", true}};
  EXPECT_TRUE(std::get<Grab>(readCommand(message.dump()).what).grip.contact);
  const auto refused = [&](const Json& grip, const Json& at, const std::string& where) {
    Json bad = message;
    bad["grip"] = grip, bad["at"] = at;
    EXPECT_NE(errorOf(bad.dump()).find(where), std::string::npos) << errorOf(bad.dump());
  };
  refused({{"place", false}}, 0.5, "/grip/place");
  refused({{"contact", true}}, 0.5, "/grip/contact");
  refused({{"contact", true}, {"point", {0, 0, 0}}}, {{"impact", 1}}, "/grip/contact");
}

TEST(Protocol, EveryMemberThatIsNeededIsMissed) {
  const std::map<std::string, std::vector<const char*>> optional = {
      {"grab", {"grip", "also_vary"}},  {"drag", {"orientation", "components"}},     {"release", {"orientation", "components", "nail"}},
      {"open", {"gallery", "replace"}}, {"save", {"path", "replace"}}, {"list", {"path", "meshes"}}, {"add_body", {"on"}}, {"new", {"replace"}}, {"export", {"before", "keys"}}, {"alternatives", {"count"}},
      {"face_up", {"place", "nail"}}, {"import", {"path", "as", "replace"}}};
  for (const auto& [type, good] : examples()) {
    const auto known = optional.find(type);
    for (const auto& member : good.items()) {
      Json bad = good;
      bad.erase(member.key());
      const bool needed = known == optional.end() || std::ranges::count(known->second, member.key()) == 0;
      const std::string error = errorOf(bad.dump());
      EXPECT_EQ(error == "no error", !needed) << type << ": " << bad.dump();
      if (needed) {
        EXPECT_NE(error.find(member.key()), std::string::npos) << type << ": " << error;
      }
    }
  }
}

TEST(Protocol, WrongMembersWithinOthersAreNamed) {
  const auto expectNamed = [](const std::string& type, const std::string& pointer, const Json& wrong) {
    Json bad = examples().at(type);
    bad[Json::json_pointer(pointer)] = wrong;
    const std::string error = errorOf(bad.dump());
    EXPECT_NE(error.find(pointer), std::string::npos) << type << ": " << bad.dump() << "\n" << error;
  };
  expectNamed("grab", "/at/impact", 0);
  expectNamed("grab", "/at/impact", 1.5);
  expectNamed("grab", "/at", {{"rest", true}, {"impact", 1}});
  expectNamed("grab", "/at/rest", false);
  expectNamed("grab", "/at/with", 3);
  expectNamed("grab", "/at/other", 3);
  expectNamed("grab", "/grip/point", {0, 0});
  expectNamed("grab", "/grip/point/1", "x");
  expectNamed("grab", "/grip/orientation", 1);
  expectNamed("grab", "/grip/components", Json::array());
  expectNamed("grab", "/grip/components/0", "w");
  expectNamed("grab", "/grip/of", "place");
  expectNamed("grab", "/gesture", 0);
  expectNamed("drag", "/seq", -1);
  expectNamed("drag", "/place/2", nullptr);
  expectNamed("drag", "/orientation", {1, 0, 0});
  expectNamed("set", "/edits/0/pointer", 7);
  expectNamed("set", "/edits/0/other", 7);
  expectNamed("hello", "/tab", "");
  expectNamed("hello", "/tab", std::string(65, 't'));
  expectNamed("hello", "/token", std::string(201, 't'));
  expectNamed("nail_on", "/nail", -1);
  expectNamed("alternatives", "/count", 13);
  expectNamed("adopt", "/index", -1);
}

TEST(Protocol, ErrorsSayFoundAndExpected) {
  EXPECT_EQ(errorOf("[]"), "found an empty array, expected a message: an object");
  EXPECT_NE(errorOf("").find("expected"), std::string::npos);
  EXPECT_NE(errorOf("{\"type\": \"undo\"").find("line 1"), std::string::npos);
  EXPECT_NE(errorOf("{\"type\":\"grap\",\"id\":1}").find("did you mean \"grab\"?"), std::string::npos);
  EXPECT_NE(errorOf("{\"id\":1}").find("no member \"type\""), std::string::npos);
  EXPECT_NE(errorOf("{\"type\":{},\"id\":1}").find("/type"), std::string::npos);
  EXPECT_NE(errorOf("{\"type\":\"undo\",\"id\":1,\"id\":2}").find("id"), std::string::npos);
  EXPECT_NE(errorOf("{\"type\":\"drag\",\"id\":1,\"gesture\":1,\"seq\":0,\"place\":[0,0,1e400]}").find("expected"),
            std::string::npos);
  EXPECT_NE(errorOf("{\"type\":\"drag\",\"id\":1,\"gesture\":1,\"seq\":0,\"place\":[0,0,1],\"orientation\":[2,0,0,0]}")
                .find("/orientation"),
            std::string::npos);
  EXPECT_NE(errorOf("{\"type\":\"nail\",\"id\":1}").find("constraint"), std::string::npos);
  Json grip = examples().at("grab");
  grip["grip"]["components"] = {"x", "x"};
  EXPECT_NE(errorOf(grip.dump()).find("/grip/components"), std::string::npos);
  Json set = examples().at("set");
  set["edits"][0]["pointer"] = "bodies";
  EXPECT_NE(errorOf(set.dump()).find("/edits/0/pointer"), std::string::npos);
}

TEST(Protocol, ErrorsKnowTheNumberOfTheirMessage) {
  try {
    readCommand("{\"id\": 99, \"type\": \"undo\", \"x\": 1}");
    FAIL();
  } catch (const MessageError& error) {
    EXPECT_EQ(error.re, 99);
  }
  for (const char* text : {"{\"id\": \"99\", \"type\": \"undo\"}", "nonsense", "3"}) {
    try {
      readCommand(text);
      FAIL();
    } catch (const MessageError& error) {
      EXPECT_EQ(error.re, 0) << text;
    }
  }
}

TEST(Protocol, DeepAndHugeMessagesAreRefused) {
  EXPECT_NE(errorOf(std::string(100000, '[')).find("expected"), std::string::npos);
  std::string many = "{\"type\":\"list\",\"id\":1,\"path\":[";
  for (int i = 0; i < 500000; ++i) many += "0,";
  EXPECT_NE(errorOf(many + "0]}").find("expected"), std::string::npos);
}

TEST(Protocol, ControlsAndConstraintsAreReadWithTheirScene) {
  const Scene scene = parseDocument(kTestScene, "bounce").scene;
  const std::vector<Control> controls = readControlsText(
      R"([{"vary": "velocity", "body": "ball", "components": ["z"], "weight": 0.2}])", scene, "/also_vary");
  ASSERT_EQ(controls.size(), 1u);
  EXPECT_EQ(controls[0].weight, 0.2);
  const Constraint constraint = readConstraintText(
      R"({"body": "ball", "at": {"impact": 2}, "position": [1, null, 0.25]})", scene, 2, "/constraint");
  EXPECT_EQ(constraint.at.impact, 2);
  EXPECT_EQ(constraint.targets.at(0).value[2], 0.25);
  const auto whereOf = [&](const auto& call) {
    try {
      call();
    } catch (const InputError& error) {
      return error.where();
    }
    return std::string("no error");
  };
  EXPECT_EQ(whereOf([&] { readControlsText(R"([{"vary": "mass", "body": "bal"}])", scene, "/also_vary"); }),
            "/also_vary/0/body");
  EXPECT_EQ(whereOf([&] {
              readConstraintText(R"({"body": "ball", "at": 9, "position": [0,0,0]})", scene, 2, "/constraint");
            }),
            "/constraint/at");
}

}  // namespace
}  // namespace carom::studio

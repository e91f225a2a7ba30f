// SPDX-License-Identifier: MIT
#include "tests/formats/broken_documents.h"

namespace carom::formats_test {

std::vector<BrokenDocument> brokenShapes() {
  const std::string ball = "\"sphere\": { \"radius\": 0.1 }";
  const auto instead = [&](const char* name, const std::string& shape, const std::string& where,
                           const std::vector<std::string>& fragments) {
    return BrokenDocument{name, ball, shape, "/bodies/2/shape" + where, fragments};
  };
  const std::string tetrahedron = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]";
  // Each `levels` compounds in one another.
  const auto nested = [](int levels) {
    std::string text = "\"sphere\": { \"radius\": 1 }";
    for (int i = 0; i < levels; ++i) text = "\"compound\": [{ " + text + " }]";
    return text;
  };
  const auto inside = [](int levels) {
    std::string place;
    for (int i = 0; i < levels; ++i) place += "/compound/0";
    return place + "/compound";
  };
  return {
      instead("capsuleWithoutHeight", R"("capsule": { "radius": 0.2 })", "/capsule",
              {"no member \"height\"", "\"height\": a number > 0"}),
      instead("capsuleHeight", R"("capsule": { "radius": 0.2, "height": 0 })", "/capsule/height",
              {"found 0", "a number > 0"}),
      instead("capsuleRadius", R"("capsule": { "radius": "wide", "height": 1 })", "/capsule/radius",
              {"found \"wide\"", "a number > 0"}),
      instead("capsuleLength", R"("capsule": { "radius": 0.2, "length": 1 })", "/capsule/length",
              {"unknown member", "one of \"radius\", \"height\""}),
      instead("capsuleArray", R"("capsule": [0.2, 1])", "/capsule",
              {"found [0.2, 1]", "an object with \"radius\" and \"height\""}),
      instead("cylinderWithoutRadius", R"("cylinder": { "height": 0.2 })", "/cylinder", {"no member \"radius\""}),
      instead("cylinderHeight", R"("cylinder": { "radius": 0.2, "height": -1 })", "/cylinder/height", {"found -1"}),
      instead("cylinderHuge", R"("cylinder": { "radius": 1e10, "height": 1 })", "/cylinder/radius",
              {"of magnitude at most 1e9"}),

      instead("coneWithoutHeight", R"("cone": { "radius": 0.2 })", "/cone", {"no member \"height\""}),
      instead("coneRadius", R"("cone": { "radius": 0, "height": 1 })", "/cone/radius", {"found 0"}),
      instead("coneHuge", R"("cone": { "radius": 1, "height": 1e10 })", "/cone/height", {"of magnitude at most 1e9"}),
      instead("coneApex", R"("cone": { "radius": 0.2, "height": 1, "apex": 0 })", "/cone/apex",
              {"unknown member", "one of \"radius\", \"height\""}),
      instead("noSuchShape", R"("con": { "radius": 0.2, "height": 1 })", "/con", {"unknown member", "did you mean \"cone\"?"}),

      instead("hullOfNothing", R"("hull": {})", "/hull", {"found an empty object", "one of \"points\" and \"file\""}),
      instead("hullOfBoth", R"("hull": { "file": "a.obj", "points": )" + tetrahedron + "}", "/hull",
              {"both \"points\" and \"file\""}),
      instead("hullOfThree", R"("hull": { "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]] })", "/hull/points",
              {"found an array of 3", "4 to 10000 points"}),
      instead("hullInPlane", R"("hull": { "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] })", "/hull/points",
              {"plane"}),
      instead("hullOnLine", R"("hull": { "points": [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]] })", "/hull/points",
              {"line"}),
      instead("hullAtOnePlace", R"("hull": { "points": [[1, 1, 1], [1, 1, 1], [1, 1, 1], [1, 1, 1]] })", "/hull/points",
              {"place"}),
      instead("hullPoint", R"("hull": { "points": [[0, 0, 0], [1, 0], [0, 1, 0], [0, 0, 1]] })", "/hull/points/1",
              {"found [1, 0]", "3 numbers"}),
      instead("hullScale", R"("hull": { "scale": 0, "points": )" + tetrahedron + "}", "/hull/scale",
              {"found 0", "a number > 0"}),
      instead("hullTooLarge", R"("hull": { "scale": 1e9, "points": [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]] })",
              "/hull/scale", {"at most 1e9"}),
      instead("hullVertices", R"("hull": { "vertices": )" + tetrahedron + "}", "/hull/vertices",
              {"unknown member", "one of \"points\", \"file\", \"scale\""}),

      instead("meshWithoutFile", R"("mesh": { "scale": 2 })", "/mesh",
              {"no member \"file\"", "the name of a mesh file"}),
      instead("meshFileEmpty", R"("mesh": { "file": "" })", "/mesh/file", {"found \"\"", "1 to 1000 characters"}),
      instead("meshFileNumber", R"("mesh": { "file": 7 })", "/mesh/file", {"found 7", "the name of a mesh file"}),
      instead("meshWithoutFolder", R"("mesh": { "file": "mug.obj" })", "/mesh/file", {"no folder"}),
      instead("hullWithoutFolder", R"("hull": { "file": "mug.obj" })", "/hull/file", {"no folder"}),
      instead("meshScale", R"("mesh": { "file": "mug.obj", "scale": -1 })", "/mesh/scale", {"found -1"}),
      instead("meshPoints", R"("mesh": { "points": [] })", "/mesh/points",
              {"unknown member", "one of \"file\", \"scale\""}),

      instead("compoundOfNothing", R"("compound": [])", "/compound", {"found an empty array", "1 to 1000 parts"}),
      instead("compoundObject", R"("compound": { "sphere": { "radius": 1 } })", "/compound", {"an array of 1 to 1000"}),
      instead("partNumber", R"("compound": [1])", "/compound/0", {"found 1", "a part: an object"}),
      instead("partWithoutShape", R"("compound": [{ "position": [1, 2, 3] }])", "/compound/0",
              {"found an object with \"position\"", "a shape"}),
      instead("partOfTwo", R"("compound": [{ "sphere": { "radius": 1 }, "box": { "size": [1, 1, 1] } }])",
              "/compound/0", {"both \"sphere\" and \"box\"", "one shape"}),
      instead("partPlane", R"("compound": [{ "plane": { "normal": [0, 0, 1] } }])", "/compound/0/plane",
              {"unknown member", "sphere"}),
      instead("partPosition", R"("compound": [{ "sphere": { "radius": 1 }, "position": [1, 2] }])",
              "/compound/0/position", {"found [1, 2]", "3 numbers"}),
      instead("partOrientation", R"("compound": [{ "sphere": { "radius": 1 }, "orientation": [1, 1, 0, 0] }])",
              "/compound/0/orientation", {"of length 1.41", "a unit quaternion"}),
      instead("partVelocity", R"("compound": [{ "sphere": { "radius": 1 }, "velocity": [1, 1, 0] }])",
              "/compound/0/velocity", {"unknown member"}),
      instead("partRadius", R"("compound": [{ "sphere": { "radius": 1 } }, { "compound": [{ "sphere": {} }] }])",
              "/compound/1/compound/0/sphere", {"no member \"radius\""}),
      instead("compoundDepth", nested(17), inside(16), {"nested deeper than 16"}),
      // The document, its bodies, a body and its shape are four levels, every compound two more.
      instead("compoundBomb", nested(37), inside(22), {"more than 48 levels of nesting"}),

      {"centerOfMass", "[0.013, -0.002, 0.001]", "[0.013, -0.002]", "/bodies/7/center_of_mass", {"3 numbers"}},
      {"centerOfMassNull", "[0.013, -0.002, 0.001]", "null", "/bodies/7/center_of_mass", {"found null"}},
      {"centreOfMass",
       "\"center_of_mass\"",
       "\"centre_of_mass\"",
       "/bodies/7/centre_of_mass",
       {"unknown member", "did you mean \"center_of_mass\"?"}},
      {"sizeOfPart", "\"2.0.radius\"", "\"2.0.size\"", "/controls/13/components/2", {"2.0.radius", "1.height"}},
  };
}

}  // namespace carom::formats_test

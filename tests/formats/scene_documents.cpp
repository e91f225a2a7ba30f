// SPDX-License-Identifier: MIT
#include "tests/formats/scene_documents.h"
#include "examples/support/project_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace carom::formats_test {

std::string textOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> exampleScenes() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(projectFile("examples/scenes")))
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

const std::string& documentWithEverything() {
  static const std::string text = R"({
  "carom": 1,
  "gravity": [0.1, -0.2, -9.81], "$schema": "https://example.org/schemas/scene.schema.json", "name": "Everything \"quoted\" é", "notes": "one line\nand another",
  "duration": 2.5,
  "materials": {
    "wood": { "elasticity": 0.6, "friction": 0.3, "tangential_elasticity": -0.25, "notes": "old oak" },
    "felt": {
      "elasticity": 0.45, "friction": 0, "tangential_elasticity": 0.5,
      "combine": { "elasticity": "minimum", "friction": "multiply" }
    },
    "a/b~c \"quoted\" é": { "combine": { "friction": "maximum" } }
  },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "wood",
      "shape": { "plane": { "normal": [0, 0.6, 0.8], "offset": -0.125 } } },
    { "name": "wall", "fixed": true, "mass": 3, "position": [7, 0, 1], "orientation": [0.6, 0, 0.8, 0],
      "shape": { "box": { "size": [0.1, 2, 0.3] } }, "surface_velocity": [0.1, -2.5, 0] },
    { "name": "ball", "fixed": false, "gravity_factor": -0.1, "collision_filter": { "systems": ["balls", "é"], "collide_with": ["balls"] }, "density": 700.5, "material": "a/b~c \"quoted\" é",
      "shape": { "sphere": { "radius": 0.1 } }, "position": [0, 0, 3] },
    { "name": "book", "notes": "the one with the torn cover", "mass": 0.4, "inertia": [0.0011, 0.0012, 0.0019], "material": "felt",
      "shape": { "box": { "size": [0.21, 0.15, 0.03] } },
      "position": [1, 2, 3.3], "orientation": [0.5, -0.5, 0.5, -0.5],
      "velocity": [2.2, 1e-7, -2.5e8], "angular_velocity": [0.1, 0.2, 0.30000000000000004] },
    { "name": "crate", "mass": 2,
      "inertia": [[0.2, 0.01, 0.005], [0.01, 0.25, -0.02], [0.005, -0.02, 0.3]],
      "shape": { "box": { "size": [1, 1, 1] } }, "position": [-5, 0, 6] },
    { "name": "pill", "kinematic": true, "collision_filter": { "not_collide_with": ["é"] }, "density": 1100, "shape": { "capsule": { "radius": 0.11, "height": 0.7 } }, "position": [-8, 0, 6],
      "surface_velocity": [1, 2, 3], "surface_angular_velocity": [0, 0, 0.30000000000000004] },
    { "name": "can", "density": 1200, "shape": { "cylinder": { "radius": 0.12, "height": 0.9 } }, "position": [-9, 0, 6] },
    { "name": "die", "mass": 0.031, "center_of_mass": [0.013, -0.002, 0.001],
      "shape": { "hull": { "points": [
        [0, 0, 0], [0.3, 0, 0], [0, 0.3, 0], [0.05, 0.05, 0.05], [0, 0, 0.30000000000000004] ], "scale": 1.25 } },
      "position": [-10, 0, 6] },
    { "name": "hat", "density": 70,
      "shape": { "compound": [
        { "cylinder": { "radius": 0.16, "height": 0.01 } },
        { "cylinder": { "radius": 0.09, "height": 0.13 }, "position": [0, 0, 0.06], "orientation": [0.28, 0, 0, 0.96] },
        { "compound": [
          { "sphere": { "radius": 0.021 }, "position": [0, 0.5, 0] },
          { "hull": { "points": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]] } },
          { "box": { "size": [0.31, 0.32, 0.33] }, "orientation": [0, 0.6, 0, 0.8] } ], "position": [0, 0, 1.5] } ] },
      "position": [-20, 0, 6] },
    { "name": "top hat", "density": 300, "shape": { "compound": [ { "cone": { "radius": 0.17, "height": 0.4 } } ] },
      "position": [-30, 0, 6] },
    { "name": "pylon", "density": 310, "shape": { "cone": { "radius": 0.18, "height": 0.71 } }, "position": [-40, 0, 6] }
  ],
  "tilts": [
    { "body": "book", "impact": 1, "value": [0.01, -0.02] },
    { "body": "book", "impact": 2, "value": [0, 0.1] }
  ],
  "controls": [
    { "vary": "position", "body": "wall", "components": ["x", "z"], "min": [-1, -2], "max": 3, "weight": 0.5 },
    { "vary": "orientation", "body": "book", "distribution": { "uniform_on_so3": true } },
    { "vary": "velocity", "body": "book", "min": -4, "distribution": { "normal": { "mean": [1, -2, 0.5], "deviation": 0.125 } } },
    { "vary": "angular_velocity", "body": "book", "max": [1, 2, 3], "distribution": { "normal": { "mean": 0.5, "factor": [[1, 0], [0.25, 2], [0, -3]] } } },
    { "vary": "elasticity", "material": "felt", "min": 0.2, "max": 0.9, "distribution": { "uniform": { "from": 0.3, "to": 0.75 } } },
    { "vary": "friction", "material": "wood", "notes": "by wax" },
    { "vary": "tangential_elasticity", "material": "felt" },
    { "vary": "mass", "body": "ball" },
    { "vary": "inertia", "body": "book", "distribution": { "log_normal": { "median": [0.001, 0.002, 0.0025], "deviation": [0.1, 0.2, 0.3] } } },
    { "vary": "size", "body": "ball", "components": ["radius"] },
    { "vary": "size", "body": "book", "components": ["y"] },
    { "vary": "tilt", "body": "book", "impact": 2, "max": 0.15 },
    { "vary": "gravity", "components": ["z"] },
    { "vary": "size", "body": "hat", "components": ["0.radius", "1.height", "2.0.radius", "2.1.scale"] },
    { "vary": "size", "body": "die", "min": 0.5 },
    { "vary": "surface_velocity", "body": "wall", "components": ["y"], "max": 3 },
    { "vary": "surface_angular_velocity", "body": "pill" }
  ],
  "constraints": [
    { "body": "book", "at": 1.4, "position": [1.9, null, 1.7], "orientation": [0.8, 0, 0.6, 0] },
    { "body": "book", "at": { "impact": 3, "with": "floor" }, "position": [2.5, 0.1, null], "time": 1.25 },
    { "body": "ball", "notes": "spins", "at": { "impact": 1 }, "velocity": [null, null, 0], "angular_velocity": [0, 0, 1] },
    { "body": "crate", "at": 0, "point": { "body_point": [0.5, 0, 0], "world": [null, 1, 2] } },
    { "body": "hat", "at": { "between": [0.31, 1.9] }, "relative_to": "crate",
      "position": [{ "min": -0.3, "max": 0.75 }, { "max": 4.5 }, null], "velocity": [0.11, { "min": -7.5 }, null] },
    { "body": "pill", "at": { "impact": 2, "with": "can" }, "time": { "min": 0.4, "max": 2.25 },
      "point": { "body_point": [0.01, 0, 0.35], "world": [{ "min": -8.5 }, null, 6.25] },
      "inside": { "box": { "size": [40.5, 30, 20] }, "position": [-3, 0, 5] } },
    { "body": "can",
      "inside": [
        { "sphere": { "radius": 12.5 }, "position": [-9, 1, 5.5] },
        { "box": { "size": [20.5, 21, 22] }, "orientation": [0.96, 0.28, 0, 0], "keep": "shape", "margin": 0 } ],
      "avoid": { "sphere": { "radius": 0.26 }, "position": [-9, 3, -0.1], "during": [0.2, 1.7], "margin": 0.05 } },
    { "body": "die", "at": { "impact": 4 }, "speed": 3.25, "kinetic_energy": { "max": 41.5 },
      "impulse": { "min": 1.125, "max": 2.625 }, "contact": [{ "min": 0.7 }, null, 4.75], "height": -0.375 },
    { "body": "can", "at": 0.35, "distance": { "to": "pill", "min": 0.15, "max": 8.5 } },
    { "body": "pill", "closest_approach": { "to": "can", "value": 0.065, "during": [0.45, 1.95] } },
    { "body": "can", "hits": "pill", "during": [0.55, 1.85], "after": { "body": "die", "impact": 8, "with": "crate" },
      "before": { "body": "pill", "impact": 7 }, "notes": "from a miss" },
    { "sequence": ["can pill", "...", "d?e pil*"] },
    { "body": "hat", "at": { "rest": true }, "position": [null, 5.125, null], "time": { "max": 2.375 } }
  ]
})";
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " occurs twice";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace carom::formats_test

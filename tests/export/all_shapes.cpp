// SPDX-License-Identifier: MIT
#include "tests/export/all_shapes.h"

#include "examples/support/project_file.h"
#include "formats/mesh/mesh_file.h"

namespace carom::export_tests {

std::shared_ptr<const Surface> assetSurface(const std::string& file) {
  const TriangleSoup soup = readMeshFile(projectFile("examples/assets/") + file);
  return meshSurface(soup.vertices, soup.triangles);
}

namespace {

// A pyramid with four sides, its foot below the origin.
std::shared_ptr<const Surface> pyramid() {
  const double r = 0.12;
  return std::make_shared<const Surface>(
      assembleSurface({{r, r, -0.05}, {-r, r, -0.05}, {-r, -r, -0.05}, {r, -r, -0.05}, {0.02, 0, 0.25}},
                      {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
}

Compound hammer() {
  Compound compound;
  compound.parts.push_back({Cylinder{0.015, 0.3}, {0, 0, 0}, Quat::Identity()});
  compound.parts.push_back({Box{{0.12, 0.04, 0.05}}, {0, 0, 0.15}, Quat::Identity()});
  compound.parts.push_back({Sphere{0.03}, {0.06, 0, 0.15}, Quat::Identity()});
  compound.parts.push_back({Capsule{0.012, 0.06}, {0, 0.01, -0.12}, Quat(0.8, 0.6, 0, 0)});
  return compound;
}

}  // namespace

std::vector<NamedShape> solidShapes() {
  return {{"sphere", Sphere{0.1}},
          {"box", Box{{0.3, 0.2, 0.1}}},
          {"capsule", Capsule{0.06, 0.2}},
          {"cylinder", Cylinder{0.1, 0.15}},
          {"cone", Cone{0.1, 0.2}},
          {"hull", Hull{pyramid(), 0.8, ""}},
          {"mesh", Mesh{assetSurface("mug.obj"), 2.5, ""}},
          {"compound", hammer()}};
}

Document documentOfAllShapes(bool fixed) {
  Document document;
  document.duration = 0.3;
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.position.z() = 0.55;
  Body ball;
  ball.name = "ball", ball.shape = Sphere{0.1}, ball.density = 500;
  ball.position = {1, -1, 1}, ball.velocity = {3, 0, 1};
  document.scene.bodies = {floor, ball};
  double place = 0;
  for (const NamedShape& named : solidShapes()) {
    Body body;
    body.name = named.name, body.shape = named.shape, body.fixed = fixed;
    body.position = {0.6 * place, 0, 1};
    body.orientation = Quat(0.9, 0.3 - 0.1 * place, 0.05 * place - 0.2, 0.25).normalized();
    if (!fixed) {
      body.density = 700;
      body.velocity = {0.2, -0.1 * place, 1.5};
      body.angular_velocity = {4, 7 - place, -3};
    }
    document.scene.bodies.push_back(body);
    place += 1;
  }
  return document;
}

}  // namespace carom::export_tests

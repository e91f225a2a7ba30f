// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

// Vertex v has coordinate +half on axis k where bit k of v is set; faces are -x, +x, -y, +y, -z, +z; edges 4 k + s run
// along axis k, with s the sign bits of the two axes after k.

double sign(int bit) { return bit ? 1.0 : -1.0; }

// Bit `bit` on axis k.
int onAxis(int k, int bit) { return bit << k; }

Vec3 boxPoint(const Vec3& half, int v) { return {sign(v & 1) * half[0], sign(v & 2) * half[1], sign(v & 4) * half[2]}; }

// Corners of a face in the order of its two other axes, counter-clockwise about +k; the face -k sees them the other way
// round.
void addFace(PartMaker& part, const Vec3& half, int face) {
  const int k = face / 2, side = face % 2, first = part.part().first(Family::vertex);
  const Vec3 normal = sign(side) * Vec3::Unit(k);
  part.face(half[k] * normal, normal);
  constexpr int kBits[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    const auto& bits = kBits[side ? i : 3 - i];
    part.corner(first + (onAxis(k, side) | onAxis((k + 1) % 3, bits[0]) | onAxis((k + 2) % 3, bits[1])));
  }
}

void addEdge(PartMaker& part, const Vec3& half, int edge) {
  const int k = edge / 4, u = (k + 1) % 3, v = (k + 2) % 3, bit_u = edge & 1, bit_v = edge >> 1 & 1;
  Vec3 middle = Vec3::Zero();
  middle[u] = sign(bit_u) * half[u];
  middle[v] = sign(bit_v) * half[v];
  SolidEdge& e = part.edge(middle, Vec3::Unit(k), half[k]);
  e.from = part.part().first(Family::vertex) + (onAxis(u, bit_u) | onAxis(v, bit_v));
  e.to = e.from + onAxis(k, 1);
  // n x e_k points into a face with normal n on the left: for n = +-e_u that is -+e_v, into it where v has the same
  // sign
  e.left = part.part().first(Family::face) + (bit_u == bit_v ? 2 * u + bit_u : 2 * v + bit_v);
  e.right = part.part().first(Family::face) + (bit_u == bit_v ? 2 * v + bit_v : 2 * u + bit_u);
}

void addBox(PartMaker& part, const Box& s) {
  const Vec3 half = 0.5 * s.size;
  for (int k = 0; k < 3; ++k) part.dimension(Vec3::Unit(k) / s.size[k]);
  for (int v = 0; v < 8; ++v) part.vertex(boxPoint(half, v));
  for (int f = 0; f < 6; ++f) addFace(part, half, f);
  for (int e = 0; e < 12; ++e) addEdge(part, half, e);
  part.takeAll(part.piece(Piece::Core::polytope, Vec3::Zero()));
}

std::string boxName(Family family, int i) {
  if (family == Family::face) return "face " + signedAxis(i % 2, i / 2);
  std::string text = family == Family::edge ? "edge " : "vertex ";
  if (family == Family::edge)
    for (int j = 0; j < 2; ++j) text += signedAxis(i >> j & 1, (i / 4 + 1 + j) % 3);
  else
    for (int k = 0; k < 3; ++k) text += signedAxis(i >> k & 1, k);
  return text;
}

}  // namespace

SolidKind solidRow(KindOf<Box>) { return {.add = addPart<Box, addBox>, .name = boxName, .whole = &Solid::box}; }

}  // namespace carom::solids

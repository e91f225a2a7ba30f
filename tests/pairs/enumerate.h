// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tests/pairs/distance.h"

namespace carom::pairs {

/// Takes the candidates of an enumeration; those beyond `cutoff` are not wanted.
class Collector {
 public:
  virtual ~Collector() = default;
  Real cutoff = 0;
  virtual void add(const Candidate& candidate) = 0;
};

/// Tells all pairs of features of two placed pieces that are locally nearest to each other. The features name pieces i
/// and j.
void enumerate(const Piece& a, int i, const Piece& b, int j, Collector& out);

/// The part of it where a cylinder or a cone takes part, which are called round.
void enumerateRound(const Piece& other, int i, const Piece& round, int j, bool swapped, Collector& out);
void enumerateRounds(const Piece& a, int i, const Piece& b, int j, Collector& out);

/// Parameters in [0, 1] of the nearest points of two segments, which may be points.
struct SegmentPair {
  Real s, t;
};
SegmentPair nearestOnSegments(const Vector& p, const Vector& d, const Vector& q, const Vector& e);

/// Edges of a piece; a lone point is an edge of no length.
const std::vector<Piece::Edge>& segmentsOf(const Piece& piece);
/// The end of an edge, or the edge, at a parameter.
FeatureId onSegment(int piece, const Piece::Edge& edge, int index, Real parameter);
/// Whether a point lies over a face, seen along its normal.
bool isOver(const Piece& piece, const Piece::Face& face, const Vector& p);

}  // namespace carom::pairs

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/contact/contact_path.hpp"
#include "editing/problem/rows/region_way.hpp"

namespace carom::editing_detail {
namespace {

// A slide round a bend keeps near to the parabola that it follows at the start of a span: no further off than half of
// what its acceleration varies by, times the time squared. Spans that cannot hold the least are passed over, the
// others halved; at last the least is that of the parabola around it, again and again.
class CurvedWay {
 public:
  CurvedWay(const Arc& arc, const BoundRegion& bound, int component, double from, double to)
      : arc_(arc), bound_(bound), component_(component), from_(from), to_(to) {
    const Vec3 first = arc.positionAt(from) - bound.region.position, last = arc.positionAt(to) - bound.region.position;
    tolerance_ = 1e-13 * (first.norm() + last.norm() + arc.velocityAt(from).norm() * (to - from));
    if (rowsOf(bound.region) == 1) return;
    // A face of a box is approached by what goes along its normal alone.
    const Vec3 normal = bound.region.orientation.normalized() * Vec3::Unit(component / 2);
    share_ = adjoint_detail::alongFace<double>(arc.path()->inputs.normal, normal).norm();
  }

  PlaceOnWay find() {
    keep(at(to_));
    keep(at(from_));
    search();
    if (best_.time != from_ && best_.time != to_) refine();
    best_.first = best_.time == from_;
    best_.last = best_.time == to_;
    return best_;
  }

 private:
  struct Span {
    double from, to;
  };

  PlaceOnWay around(double time, double from, double to) const {
    const Stretch stretch = stretchAround(arc_, bound_.region, time, from, to);
    PlaceOnWay place = least(stretch, bound_, component_);
    place.time = place.s == stretch.lo ? from : place.s == stretch.hi ? to : std::clamp(time + place.s, from, to);
    return place;
  }
  PlaceOnWay at(double time) const { return around(time, time, time); }
  void keep(const PlaceOnWay& place) {
    if (place.value < best_.value) best_ = place;
  }
  double errorOf(const Span& span) const {
    const adjoint_detail::ContactPath& path = *arc_.path();
    const double from = path.elapsedAt(span.from), until = path.elapsedAt(span.to), time = until - from;
    return 0.5 * share_ * adjoint_detail::pathBounds(path.form, path.inputs, from, until).variation * time * time;
  }

  void search() {
    std::vector<Span> spans{{from_, to_}};
    while (!spans.empty()) {
      const Span span = spans.back();
      spans.pop_back();
      const PlaceOnWay lowest = around(span.from, span.from, span.to);
      const double error = errorOf(span);
      if (!(lowest.value - error < best_.value - tolerance_)) continue;
      keep(at(lowest.time));
      const double middle = span.from + 0.5 * (span.to - span.from);
      if (!(error > tolerance_) || !(middle > span.from && middle < span.to)) continue;
      // That with the lowest place comes first.
      spans.push_back({span.from, middle});
      spans.push_back({middle, span.to});
      if (lowest.time < middle) std::swap(spans[spans.size() - 1], spans[spans.size() - 2]);
    }
  }

  // Around the least, in spans that are not so short that rounding decides.
  void refine() {
    const double width = 1e-4 * (to_ - from_);
    for (int k = 0; k < 8; ++k) {
      const double time = best_.time;
      best_ = around(time, std::max(from_, time - width), std::min(to_, time + width));
      if (std::abs(best_.time - time) <= 1e-15 * std::abs(time)) return;
    }
  }

  const Arc& arc_;
  const BoundRegion& bound_;
  int component_;
  double from_, to_, tolerance_ = 0, share_ = 1;
  PlaceOnWay best_;
};

}  // namespace

PlaceOnWay leastOnArc(const Arc& arc, const BoundRegion& bound, int component, double from, double to) {
  if (arc.path() && !arc.path()->bounds.straight && to > from)
    return CurvedWay(arc, bound, component, from, to).find();
  const Stretch stretch = stretchAround(arc, bound.region, arc.start(), from, to);
  PlaceOnWay place = least(stretch, bound, component);
  place.time = stretch.start + place.s;
  place.first = place.s == stretch.lo;
  place.last = place.s == stretch.hi;
  return place;
}

}  // namespace carom::editing_detail

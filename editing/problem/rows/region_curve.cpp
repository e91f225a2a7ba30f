// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "adjoint/contact/contact_path.hpp"
#include "editing/problem/rows/region_way.hpp"

namespace carom::editing_detail {
namespace {

// A time that is counted from elsewhere is not exact: an end of the span is that end, and nothing lies beyond it.
void putTime(PlaceOnWay& place, const Stretch& stretch, double from, double to) {
  place.first = place.s == stretch.lo;
  place.last = place.s == stretch.hi;
  place.time = place.first ? from : place.last ? to : std::clamp(stretch.start + place.s, from, to);
}

// Of what is integrated no bound over a span is known but that of all its path, which is too wide to end the search where
// the clearance hardly changes. It is looked at in so many spans first, and how its acceleration varies in one is taken
// from the middle and the end of it, so many times over: chosen, not proved.
constexpr int kSpans = 32;
constexpr double kSafety = 4;

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
    normal_ = normal;
    if (arc.closedForm()) share_ = adjoint_detail::alongFace<double>(arc.closedForm()->inputs.normal, normal).norm();
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
    putTime(place, stretch, from, to);
    return place;
  }
  PlaceOnWay at(double time) const { return around(time, time, time); }
  void keep(const PlaceOnWay& place) {
    if (place.value < best_.value) best_ = place;
  }
  double errorOf(const Span& span) const {
    const double time = span.to - span.from;
    if (const adjoint_detail::ContactPath* path = arc_.closedForm()) {
      const double from = path->elapsedAt(span.from), until = path->elapsedAt(span.to);
      return 0.5 * share_ * adjoint_detail::pathBounds(path->form, path->inputs, from, until).variation * (until - from) * (until - from);
    }
    // how much the acceleration, or what of it goes along the normal, differs from that of the start
    const Vec3 first = accelerationAt(arc_, span.from);
    const auto change = [&](double t) {
      const Vec3 by = accelerationAt(arc_, t) - first;
      return normal_ ? std::abs(normal_->dot(by)) : by.norm();
    };
    return kSafety * 0.5 * std::max(change(span.from + 0.5 * time), change(span.to)) * time * time;
  }

  void search() {
    std::vector<Span> spans;
    const int count = arc_.closedForm() ? 1 : kSpans;
    for (int i = count; i-- > 0;)
      spans.push_back({from_ + (to_ - from_) * i / count, i + 1 == count ? to_ : from_ + (to_ - from_) * (i + 1) / count});
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
  std::optional<Vec3> normal_;  // of the face
  PlaceOnWay best_;
};

}  // namespace

PlaceOnWay leastOnArc(const Arc& arc, const BoundRegion& bound, int component, double from, double to) {
  if (!arc.isStraight() && to > from)
    return CurvedWay(arc, bound, component, from, to).find();
  const Stretch stretch = stretchAround(arc, bound.region, arc.start(), from, to);
  PlaceOnWay place = least(stretch, bound, component);
  putTime(place, stretch, from, to);
  return place;
}

}  // namespace carom::editing_detail

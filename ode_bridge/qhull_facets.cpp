// SPDX-License-Identifier: MIT
#include "ode_bridge/qhull_facets.hpp"

#include <cfloat>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>

// After the standard headers that it includes itself, which must not be seen inside extern "C".
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace carom::ode_bridge_detail {
namespace {

// What the library takes for its own rounding at a size of 1; it merges facets within a few times that.
constexpr double kOwnRounding = 3e-15;

// Pp: no warnings. En: rounding. Q0: no merging. QRn: turned, by a turn that follows from n.
constexpr const char* kOptions[kQhullAttempts] = {"qhull Pp", "qhull Pp Q0", "qhull Pp QR1", "qhull Pp QR2",
                                                  "qhull Pp QR3"};

// Takes the library's messages, which would go to stderr otherwise.
class Messages {
 public:
  Messages() : file_(open_memstream(&text_, &size_)) {}
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  ~Messages() {
    if (file_) std::fclose(file_);
    std::free(text_);
  }
  std::FILE* file() { return file_; }
  /// First line.
  std::string text() {
    std::fflush(file_);
    const std::string all(text_ ? text_ : "", text_ ? size_ : 0);
    return all.substr(0, all.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

// Frees what a run of the library holds, whether it ended well or not.
struct Run {
  Run() : qh(std::make_unique<qhT>()) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run() {
    int kept = 0, total = 0;
    qh_freeqhull(qh.get(), !qh_ALL);
    qh_memfreeshort(qh.get(), &kept, &total);
  }
  std::unique_ptr<qhT> qh;
};

// The sides of a polygon put in order around it; empty when they are not one ring.
std::vector<int> ringOf(const std::vector<std::pair<int, int>>& sides) {
  std::map<int, std::vector<int>> next;
  for (const auto& [a, b] : sides) next[a].push_back(b), next[b].push_back(a);
  for (const auto& [vertex, neighbours] : next)
    if (neighbours.size() != 2) return {};
  std::vector<int> ring{next.begin()->first};
  for (int from = -1, at = ring[0];;) {
    const std::vector<int>& ways = next[at];
    const int to = ways[0] == from ? ways[1] : ways[0];
    if (to == ring[0]) break;
    ring.push_back(to);
    from = at, at = to;
  }
  if (ring.size() != next.size()) return {};
  return ring;
}

// The library's own walk around a facet ends the process where it finds something wrong; ridges are read here instead.
std::vector<int> cornersOf(qhT* qh, facetT* facet) {
  std::vector<int> corners;
  vertexT *vertex, **vertexp;
  ridgeT *ridge, **ridgep;
  if (facet->simplicial) {
    FOREACHvertex_(facet->vertices) corners.push_back(qh_pointid(qh, vertex->point));
    return corners;
  }
  std::vector<std::pair<int, int>> sides;
  FOREACHridge_(facet->ridges) {
    std::vector<int> ends;
    FOREACHvertex_(ridge->vertices) ends.push_back(qh_pointid(qh, vertex->point));
    if (ends.size() != 2) return {};
    sides.emplace_back(ends[0], ends[1]);
  }
  return sides.empty() ? corners : ringOf(sides);
}

}  // namespace

QhullFacets qhullFacets(const std::vector<Vec3>& points, double rounding, int attempt) {
  static_assert(sizeof(Vec3) == 3 * sizeof(coordT), "points are handed over as they are");
  std::vector<Vec3> copy = points;  // the library's interface is not const
  std::string options = kOptions[attempt];
  char extra[40] = "";
  if (rounding > kOwnRounding) std::snprintf(extra, sizeof extra, " E%.3e", rounding);
  options += extra;
  QhullFacets facets;
  Messages messages;
  if (!messages.file()) return {{}, "no memory for its messages"};
  Run run;
  qhT* qh = run.qh.get();
  qh_zero(qh, messages.file());
  const int code = qh_new_qhull(qh, 3, static_cast<int>(copy.size()), copy.data()->data(), False, options.data(),
                                nullptr, messages.file());
  if (code != 0) return {{}, messages.text()};
  facetT* facet;
  FORALLfacets {
    facets.polygons.push_back(cornersOf(qh, facet));
    if (facets.polygons.back().size() < 3) return {{}, "a facet whose sides are not one ring"};
  }
  return facets;
}

}  // namespace carom::ode_bridge_detail

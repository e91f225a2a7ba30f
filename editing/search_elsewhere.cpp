#include <algorithm>
#include <cmath>

#include "editing/edit_solution.h"

namespace carom {
namespace {

constexpr int kProbes = 48;
constexpr int kCandidates = 8;
constexpr int kProjectionSteps = 25;
/// Half widths of the box around the start, in natural scales, where a number has no bounds; used in turn.
constexpr double kReach[] = {0.03, 0.1, 0.3, 1};

/// The ratio of the R_d sequence, x^(d+1) = x + 1: the golden ratio in more dimensions, which spreads points evenly.
double spreadingRatio(Eigen::Index dimensions) {
  double x = 1.5;
  for (int i = 0; i < 60; ++i) x = std::pow(1 + x, 1.0 / (static_cast<double>(dimensions) + 1));
  return x;
}

Eigen::VectorXd probe(const EditSearch& search, int index) {
  const ControlSet& controls = search.problem().controls;
  const double ratio = spreadingRatio(controls.size());
  Eigen::VectorXd changes(controls.size());
  for (Eigen::Index j = 0; j < changes.size(); ++j) {
    const double phase = 0.5 + (index + 1) / std::pow(ratio, static_cast<double>(j + 1));
    const double fraction = phase - std::floor(phase);
    double lower = search.lower()[j], upper = search.upper()[j];
    if (!std::isfinite(lower) || !std::isfinite(upper)) {
      const double weight = controls.controls()[controls.variables()[j].control].control.weight;
      const double reach = kReach[index % 4] * weight;
      lower = std::max(lower, -reach), upper = std::min(upper, reach);
    }
    changes[j] = lower + fraction * (upper - lower);
  }
  return changes;
}

}  // namespace

EditPointPtr searchElsewhere(EditSearch& search) {
  std::vector<EditPointPtr> found;
  for (int i = 0; i < kProbes && search.halt() == Halt::none; ++i) {
    if (EditPointPtr point = search.evaluate(probe(search, i))) found.push_back(std::move(point));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const EditPointPtr& a, const EditPointPtr& b) { return a->violation < b->violation; });

  EditPointPtr nearest;
  for (int i = 0; i < std::min<int>(kCandidates, static_cast<int>(found.size())) && search.goesOn(); ++i) {
    const EditPointPtr point = projectOntoConstraints(search, found[i], kProjectionSteps);
    if (search.reached(*point) && (!nearest || point->objective < nearest->objective)) nearest = point;
  }
  return nearest ? minimiseWithin(search, nearest) : nullptr;
}

}  // namespace carom

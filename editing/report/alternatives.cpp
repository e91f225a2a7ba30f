// SPDX-License-Identifier: MIT
#include "editing/report/alternatives.hpp"

#include <algorithm>

#include "editing/report/verify.hpp"
#include "editing/strategy/sequence_search.hpp"

namespace carom::editing_detail {

std::vector<EditAlternative> alternativesTo(const Scene& written, const EditEvaluator& evaluator,
                                            const EditSolution& solution) {
  std::vector<EditAlternative> alternatives;
  for (const EditPointPtr& point : solution.others) {
    if (static_cast<int>(alternatives.size()) + 1 >= evaluator.options().alternatives) break;
    if (evaluator.isCancelled()) break;
    if (!areDistinct(*point, *solution.point)) continue;
    EditSolution other = solution;
    other.point = point;
    other.others.clear();
    EditResult result = verify(written, evaluator, other);
    if (!result.solved()) continue;
    const double least = evaluator.problem().change(solution.point->changes);
    const bool dearer = evaluator.problem().change(point->changes) > kMuchDearer * least;
    alternatives.push_back({std::move(result.scene), std::move(result.changed), result.objective, dearer,
                            result.residual, result.scaled_residual, std::move(result.sequence_after),
                            std::move(result.sequence_changes)});
  }
  std::stable_partition(alternatives.begin(), alternatives.end(),
                        [](const EditAlternative& other) { return !other.much_dearer; });
  return alternatives;
}

}  // namespace carom::editing_detail

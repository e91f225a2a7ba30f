// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "editing/detail/parallel.hpp"
#include "editing/solve/edit_search.hpp"

/// Solutions in other impact sequences. Internal to editing/.
namespace carom::editing_detail {

/// A local discrete search, after Harada, Witkin and Baraff (1995), in rounds. Each simulates samples around the start
/// and the best point on all cores, groups them by impact sequence, goes from the most promising of each group onto the
/// constraints, whatever impacts that takes, and minimises the change within the sequences where that arrived.
/// Everything is done, or taken over, in a fixed order: the answer is the same on any number of cores. Clock and
/// callback are asked between batches.
class SequenceSearch {
 public:
  SequenceSearch(EditSearch& search, EditPointPtr start);

  /// What a round looks for once there is a solution: others, only such as change clearly less, or of those only such
  /// as stay in the sequence of the start.
  enum class Seek { anything, smaller, smaller_inside };
  /// False when there was nothing left to do.
  bool round(Seek seek = Seek::anything);
  /// Distinct solutions, the smallest change first.
  const std::vector<EditPointPtr>& solutions() const { return solutions_; }
  /// Takes a solution in, unless it is one of those that are known already.
  void add(const EditPointPtr& solution);

 private:
  std::vector<EditPointPtr> sample();
  std::vector<EditPointPtr> promising(const std::vector<EditPointPtr>& points, Seek seek);
  std::vector<EditPointPtr> land(const std::vector<EditPointPtr>& candidates, Seek seek);
  void minimise(const std::vector<EditPointPtr>& landed);
  bool reportBatch();
  template <class Work>
  void forAll(std::size_t count, const Work& work);

  EditSearch& search_;
  ContactPool pool_;
  EditPointPtr start_;
  std::map<std::string, int> tries_;  // landings from a sequence so far
  std::vector<EditPointPtr> solutions_;
  int round_ = 0;
};

/// Whether two solutions differ in their impact sequence, or else clearly in their numbers.
bool areDistinct(const EditPoint& a, const EditPoint& b);

}  // namespace carom::editing_detail

// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "editing/detail/parallel.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "editing/strategy/effort.hpp"
#include "editing/strategy/local_solve_score.hpp"
#include "editing/strategy/samples.hpp"

/// Solutions in other impact sequences. Internal to editing/.
namespace carom::editing_detail {

/// A local discrete search, after Harada, Witkin and Baraff (1995), in rounds. Each simulates samples around the start
/// and the best point on all cores, and points beyond the boundaries of their sequences, leads some of those that lack an
/// impact towards it, groups them by impact sequence and goes from the most promising of each group onto the
/// constraints, whatever impacts that takes. Where the smallest of those that arrived changes less than the best so
/// far, its change is minimised within its sequence. Once there is a solution, only smaller changes are looked for:
/// sequences that are seen to hold none, as their rows are linear, are left.
/// Everything is done, or taken over, in a fixed order: the answer is the same on any number of cores. Clock and
/// callback are asked between batches.
class SequenceSearch {
 public:
  SequenceSearch(EditEvaluator& evaluator, EditPointPtr start);

  /// What a round looks for.
  enum class Seek {
    smaller,  ///< a solution, or one of a smaller change than the best
    others    ///< solutions that differ from those that are known
  };
  /// False when there was nothing left to do.
  bool round(Seek seek = Seek::smaller);
  /// Distinct solutions, the smallest change first.
  const std::vector<EditPointPtr>& solutions() const { return solutions_; }
  /// Takes a solution in, unless it is one of those that are known already.
  void add(const EditPointPtr& solution);
  /// Takes one of the solutions out again.
  void drop(const EditPointPtr& solution);
  /// Brings so many of the smallest to where their changes are as small as they get within their sequences, along the
  /// boundaries of these where the minimum lies on one.
  void polish(std::size_t count);
  /// The same of the smallest and of the few next to it that may become the smallest by that.
  void polishSmallest();
  /// Whether the best is a small change within the sequence of the start, of few impacts: seldom is another one
  /// smaller, so rounds do a part of the work.
  bool hasSmallChangeInside() const;
  /// Whether motions take so many steps, as those of bodies that come to rest in contact, that rounds do a part of the work.
  bool isLong() const;
  /// Whether the best keeps the sequence of the start.
  bool isBestInside() const;
  /// Of the best, up to the last that a constraint holds; 0 without one.
  int impactsOfBest() const;
  /// Of the local solves since expectAnew(), with a solution to beat.
  const ExpectedImprovement& expected() const { return expected_; }
  void expectAnew() { expected_ = {}; }
  /// The point that lacks least of the impacts that are waited for; null where none lacked any.
  const EditPointPtr& nearestLacking() const { return nearest_lacking_; }

 private:
  bool isInPart() const;
  bool takesLong() const;
  int sampleCount() const;
  std::size_t localSolves() const;
  SampleReach reach() const;
  std::size_t wanted() const;
  double lengthToBeat(Seek seek) const;
  bool isAllowed(const EditPoint& point) const;
  void noteInfluence(const EditPoint& point);
  void eraseKnown(std::vector<Eigen::VectorXd>& places);
  std::vector<EditPointPtr> sample(Seek seek);
  std::vector<EditPointPtr> neighbours(Seek seek);
  std::vector<EditPointPtr> crossings(const std::vector<EditPointPtr>& points);
  std::vector<EditPointPtr> approachAll(const std::vector<EditPointPtr>& lacking);
  std::vector<EditPointPtr> nearestOfEachGroup(const std::vector<EditPointPtr>& points) const;
  struct Candidate {
    double score;
    LocalSolveEstimate estimate;
    EditPointPtr point;
  };
  std::vector<Candidate> promising(const std::vector<EditPointPtr>& points, double to_beat);
  std::vector<EditPointPtr> startsFrom(const std::vector<Candidate>& ranked, double to_beat);
  std::vector<EditPointPtr> solveAllLocally(const std::vector<EditPointPtr>& candidates, Seek seek);
  void minimise(const std::vector<EditPointPtr>& solved, Seek seek);
  EditPointPtr smallerWithin(const EditPointPtr& point);
  std::vector<EditPointPtr> smallestSolutions(std::size_t count) const;
  void polish(const EditPointPtr& solution);
  bool reportBatch();
  void letGo(std::vector<EditPointPtr> points);
  template <class Work>
  void forAll(std::size_t count, const Work& work);

  EditEvaluator& evaluator_;
  const SearchPlan& plan_;
  ContactPool pool_;
  ThreadPool threads_;
  EditPointPtr start_;
  std::map<std::string, int> tries_;  // local solves from a sequence so far
  std::vector<EditPointPtr> solutions_;
  std::vector<EditPointPtr> promising_;  // of the last round, the most promising
  std::vector<EditPointPtr> crossed_;    // points beyond whose boundaries was looked
  std::map<RoundedPoint, double> begun_;  // where local solves began, and what they had to beat
  std::set<RoundedPoint> known_;          // evaluated so far
  std::vector<char> has_influence_;      // numbers of the controls: on a row at any of the promising points so far
  EditPointPtr nearest_lacking_;
  ExpectedImprovement expected_;
  double least_lack_ = std::numeric_limits<double>::infinity();
  int round_ = 0, rounds_without_ = 0;
  int samples_;  // the next of the endless sequence of them
};

template <class Work>
void SequenceSearch::forAll(std::size_t count, const Work& work) {
  threads_.forAll(count, [&](std::size_t i) {
    const ContactPool::Loan loan(pool_);
    work(i, loan.source());
  });
}

/// Whether two solutions differ in their impact sequence, or else clearly in their numbers.
bool areDistinct(const EditPoint& a, const EditPoint& b);

}  // namespace carom::editing_detail

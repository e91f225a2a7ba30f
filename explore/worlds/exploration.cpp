// SPDX-License-Identifier: MIT
#include "explore/worlds/exploration.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/parallel.hpp"
#include "editing/problem/edit_problem.hpp"
#include "editing/problem/jacobian.hpp"
#include "explore/draws/draws.hpp"
#include "explore/numbers/fnv.hpp"
#include "explore/worlds/face_up.hpp"

namespace carom {

using namespace editing_detail;

namespace explore_detail {

/// What worlds have in common.
struct ExplorationState {
  ExplorationState(const Scene& scene, ContactSource& contacts, double length, const std::vector<Control>& controls,
                   std::vector<int> control_indices, const std::vector<Constraint>& constraints,
                   const ExploreOptions& given)
      : own_source(contacts.another()),
        problem(scene, own_source ? *own_source : contacts, length, controls, constraints),
        written_index(std::move(control_indices)),
        draws(problem.controls, written_index, given.points, given.seed),
        pool(*problem.contacts),
        options(given),
        duration(std::max(length, problem.horizon)) {}

  std::unique_ptr<ContactSource> own_source;  // null: the caller's
  EditProblem problem;                        // of the controls that are drawn alone
  std::vector<int> written_index;             // of these controls, among all of them
  Draws draws;
  ContactPool pool;
  std::mutex alone;
  ExploreOptions options;
  double duration;
  std::vector<DrawnNumber> numbers;
  std::vector<ExploredRow> rows;
  std::vector<bool> has_free_time;  // of each row: read at a time that is chosen in every world
  std::vector<int> box_bodies;
  std::vector<std::string> boxes, notes;
};

}  // namespace explore_detail

using namespace explore_detail;

namespace {

/// Soft constraints are read like the others.
std::vector<Constraint> hardened(std::vector<Constraint> constraints) {
  for (Constraint& constraint : constraints) constraint.soft.reset();
  return constraints;
}

/// The controls with a distribution, and which of all they are. Throws InputError for controls that make no sense.
std::pair<std::vector<Control>, std::vector<int>> drawnControls(const Scene& scene, std::vector<Control> controls) {
  const ControlSet checked(scene, controls);
  std::pair<std::vector<Control>, std::vector<int>> drawn;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    if (!controls[i].distribution) continue;
    drawn.first.push_back(std::move(controls[i]));
    drawn.second.push_back(static_cast<int>(i));
  }
  return drawn;
}

std::shared_ptr<ExplorationState> stateOf(const Scene& scene, ContactSource& contacts, double duration,
                                          const std::vector<Control>& controls,
                                          const std::vector<Constraint>& constraints, const ExploreOptions& options) {
  validate(scene);
  auto [drawn, indices] = drawnControls(scene, controls);
  return std::make_shared<ExplorationState>(scene, contacts, duration, drawn, std::move(indices), hardened(constraints),
                                            options);
}

void describeNumbers(ExplorationState& state) {
  const ControlSet& controls = state.problem.controls;
  for (const int i : state.draws.variables()) {
    const Variable& v = controls.variables()[static_cast<std::size_t>(i)];
    state.numbers.push_back(
        {controls.describeVariable(i), state.written_index[static_cast<std::size_t>(v.control)], v.component});
  }
  state.notes = state.draws.notes();
}

void describeRows(ExplorationState& state) {
  const ConstraintSet& set = state.problem.constraints;
  for (int i = 0; i < set.size(); ++i) {
    const Row& row = set.rows()[static_cast<std::size_t>(i)];
    state.rows.push_back({set.describeRow(i), unitOf(row), row.constraint, row.lower, row.upper, row.scale});
    const bool free = std::any_of(set.freeTimes().begin(), set.freeTimes().end(),
                                  [&](const FreeTime& time) { return time.constraint == row.constraint; });
    state.has_free_time.push_back(free && !row.overSpan());
  }
}

void describeBoxes(ExplorationState& state) {
  const std::vector<Body>& bodies = state.problem.controls.startScene().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].immovable() || !std::holds_alternative<Box>(bodies[i].shape)) continue;
    state.box_bodies.push_back(static_cast<int>(i));
    state.boxes.push_back(bodies[i].name);
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One world, into the end of the table.
class WorldRow {
 public:
  WorldRow(const ExplorationState& state, std::uint64_t world, ContactSource& contacts, std::stop_token stop)
      : state_(state), problem_(state.problem), contacts_(contacts), stop_(std::move(stop)) {
    inside_ = state.draws.draw(world, values_);
    rows_ = Eigen::VectorXd::Constant(problem_.constraints.size(), kNaN);
    if (state.options.gradients)
      jacobian_ = Eigen::MatrixXd::Constant(rows_.size(), static_cast<Eigen::Index>(state.numbers.size()), kNaN);
    face_.assign(state.box_bodies.size(), 0);
    world_ = world;
  }

  /// False: it was stopped.
  bool simulate() {
    if (!inside_) return status_ = world_status::kOutside, true;
    try {
      SimulateOptions options;
      options.step_limit = state_.options.step_limit;
      options.stop = stop_;
      const Motion motion = carom::simulate(problem_.controls.sceneAt(values_), contacts_, state_.duration, options);
      if (motion.status == MotionStatus::stopped) return false;
      read(motion);
    } catch (const InputError&) {
      status_ = world_status::kInvalidScene;
    } catch (const NotComputable&) {
      status_ = world_status::kNotComputable;
    }
    return true;
  }

  void append(WorldTable& table) const {
    table.world.push_back(world_);
    for (const int i : state_.draws.variables()) table.drawn.push_back(values_[i]);
    const bool has_motion = hasMotion(status_);
    for (const double value : rows_) table.values.push_back(has_motion ? value : kNaN);
    table.signature.push_back(has_motion ? signature_ : 0);
    table.status.push_back(status_);
    table.impacts.push_back(has_motion ? impacts_ : 0);
    table.end.push_back(has_motion ? end_ : kNaN);
    for (const std::uint8_t face : face_) table.face.push_back(has_motion ? face : 0);
    for (Eigen::Index i = 0; i < jacobian_.rows(); ++i)
      for (Eigen::Index j = 0; j < jacobian_.cols(); ++j) table.jacobian.push_back(has_motion ? jacobian_(i, j) : kNaN);
  }

 private:
  void read(const Motion& motion) {
    impacts_ = static_cast<std::uint32_t>(motion.impacts);
    end_ = motion.end;
    signature_ = fnv(motion.signature());
    status_ = static_cast<std::uint8_t>(motion.status);
    if (motion.status == MotionStatus::complete)
      for (std::size_t k = 0; k < face_.size(); ++k) face_[k] = faceUp(motion, state_.box_bodies[k]);
    const RowValues rows = problem_.constraints.evaluate(motion);
    rows_ = rows.values;
    if (!rows.available || !rows_.allFinite()) status_ |= world_status::kMissingRow;
    if (state_.options.gradients && rows_.size() > 0) differentiate(motion, rows);
  }

  void differentiate(const Motion& motion, const RowValues& rows) {
    std::vector<Reliability> reliability;
    Eigen::MatrixXd all;
    try {
      all = jacobianByAdjoint(problem_, values_, motion, rows, &reliability);
    } catch (const NotComputable&) {
      status_ |= world_status::kNoDerivative;
      return;
    }
    const std::vector<int>& drawn = state_.draws.variables();
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      if (rows.seeds[row].empty()) continue;  // there is no such row here
      for (Eigen::Index j = 0; j < jacobian_.cols(); ++j) jacobian_(i, j) = all(i, drawn[static_cast<std::size_t>(j)]);
      // How the time itself moves is not in it.
      const bool exists = !state_.has_free_time[row] && jacobian_.row(i).allFinite();
      if (!exists) jacobian_.row(i).setConstant(kNaN), status_ |= world_status::kNoDerivative;
      if (exists && !reliability[row].reliable) status_ |= world_status::kUnreliable;
    }
  }

  const ExplorationState& state_;
  const EditProblem& problem_;
  ContactSource& contacts_;
  std::stop_token stop_;
  std::uint64_t world_ = 0;
  bool inside_ = true;
  Eigen::VectorXd values_, rows_;
  Eigen::MatrixXd jacobian_;
  std::uint64_t signature_ = 0;
  std::uint8_t status_ = 0;
  std::uint32_t impacts_ = 0;
  double end_ = 0;
  std::vector<std::uint8_t> face_;
};

void checkWorlds(const ExploreOptions& options, std::uint64_t first, std::uint64_t count) {
  const std::uint64_t most =
      options.points == Points::sobol ? kSobolWorlds : std::numeric_limits<std::uint64_t>::max() / 2;
  if (first <= most && count <= most - first) return;
  throw InputError("worlds", "found the world " + std::to_string(first) + " and " + std::to_string(count) +
                                 " of them, expected at most " + std::to_string(most) + " in all");
}

}  // namespace

Exploration::Exploration(const Scene& scene, ContactSource& contacts, double duration,
                         const std::vector<Control>& controls, const std::vector<Constraint>& constraints,
                         const ExploreOptions& options)
    : state_(stateOf(scene, contacts, duration, controls, constraints, options)) {
  describeNumbers(*state_);
  describeRows(*state_);
  describeBoxes(*state_);
}

const std::vector<DrawnNumber>& Exploration::numbers() const { return state_->numbers; }
const std::vector<ExploredRow>& Exploration::rows() const { return state_->rows; }
const std::vector<std::string>& Exploration::boxes() const { return state_->boxes; }
const std::vector<std::string>& Exploration::notes() const { return state_->notes; }
const ExploreOptions& Exploration::options() const { return state_->options; }

WorldTable Exploration::chunk(std::uint64_t first, std::uint64_t count, std::stop_token stop) const {
  checkWorlds(state_->options, first, count);
  WorldTable table;
  table.numbers = state_->numbers.size(), table.rows = state_->rows.size(), table.boxes = state_->boxes.size();
  table.has_jacobian = state_->options.gradients;
  std::unique_lock<std::mutex> lock(state_->alone, std::defer_lock);
  if (!state_->own_source) lock.lock();  // there is no second one
  const ContactPool::Loan loan(state_->pool);
  for (std::uint64_t i = 0; i < count && !stop.stop_requested(); ++i) {
    WorldRow row(*state_, first + i, loan.source(), stop);
    if (!row.simulate()) break;
    row.append(table);
  }
  return table;
}

Scene Exploration::sceneAt(std::uint64_t world) const {
  checkWorlds(state_->options, world, 1);
  Eigen::VectorXd values;
  if (!state_->draws.draw(world, values))
    throw InputError("world " + std::to_string(world),
                     "found values outside of the bounds of their controls, expected a world that is simulated");
  Scene scene = state_->problem.controls.sceneAt(values);
  validate(scene);
  return scene;
}

Motion Exploration::motionOf(std::uint64_t world) const {
  const Scene scene = sceneAt(world);
  std::unique_lock<std::mutex> lock(state_->alone, std::defer_lock);
  if (!state_->own_source) lock.lock();
  const ContactPool::Loan loan(state_->pool);
  SimulateOptions options;
  options.step_limit = state_->options.step_limit;
  return carom::simulate(scene, loan.source(), state_->duration, options);
}

}  // namespace carom

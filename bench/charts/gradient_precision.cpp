// SPDX-License-Identifier: MIT
// Error of derivatives against the time that they take: all states at the end by every number of the scene, by adjoint
// and tangent passes, by central differences of carom and of engines of fixed steps, and by MuJoCo's own differences of
// single steps; against differences in 50-digit arithmetic.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "bench/charts/chart.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/error.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/replayed.h"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

using reference::Knob;
using reference::Row;

const std::vector<double> kNudges = logSpaced(1e-1, 1e-14, 14);

// Entries much smaller than the largest one of their column, of the same kind of state, are compared on its scale.
constexpr double kSmall = 1e-2, kSmallInColumn = 1e-3;

struct Setup {
  std::string name;
  double duration;
  bool for_engines;
  Scene scene;
};

// Moments written and a tilted normal, so that these are numbers of the scene; no tilt where engines take part, which
// know none.
Setup setup(const std::string& name, bool for_engines) {
  for (const ChartScene& row : speedScenes()) {
    if (row.name != name) continue;
    Setup s{for_engines ? name : name + " with friction", row.duration, for_engines, row.make()};
    for (Body& body : s.scene.bodies)
      if (!body.fixed) body.inertia = Inertia::fromMoments(modelOf(body).inertia);
    if (for_engines) return s;
    s.scene.materials[0].friction = 0.2;
    s.scene.tilts = {{.body = s.scene.bodies.back().name, .impact = 1, .value = Vec2(0.02, -0.01)}};
    return s;
  }
  throw std::logic_error("there is no scene " + name);
}

// What the chart calls the kind of a knob; empty: a number that the chart leaves out.
std::string quantityOf(const Scene& scene, const Knob& knob, bool for_engines) {
  const std::string kind = knob.name.substr(0, knob.name.find_first_of(".["));
  const bool of_body = kind != "elasticity" && kind != "friction" && kind != "tilt" && kind != "gravity";
  if (of_body && (knob.index < 0 || scene.bodies[static_cast<std::size_t>(knob.index)].fixed)) return {};
  if (kind == "tilt") return for_engines ? "" : "normal";
  if (kind == "friction") return for_engines ? "" : kind;
  if (kind == "angular_velocity") return "spin";
  for (const char* wanted : {"position", "orientation", "velocity", "mass", "inertia", "elasticity"})
    if (kind == wanted) return kind;
  return {};
}

struct Unknown {
  Knob knob;
  std::string quantity;
  double scale;  // a nudge of 1 is this much
};

Scene moved(Scene scene, const Unknown& u, double change) {
  SceneDerivative d(scene);
  reference::entryOf(d, u.knob) = change;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    scene.materials[i].elasticity += d.materials[i].elasticity;
    scene.materials[i].friction += d.materials[i].friction;
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    Body& body = scene.bodies[i];
    const BodyDerivative& db = d.bodies[i];
    body.position += db.position, body.velocity += db.velocity, body.angular_velocity += db.angular_velocity;
    if (const double angle = db.orientation.norm(); angle > 0)
      body.orientation = (Quat(Eigen::AngleAxisd(angle, db.orientation / angle)) * body.orientation).normalized();
    if (body.mass) *body.mass += db.mass;
    body.inertia.moments += db.inertia;
  }
  for (std::size_t i = 0; i < scene.tilts.size(); ++i) scene.tilts[i].value += d.tilts[i];
  return scene;
}

class Comparison {
 public:
  Comparison(Csv& csv, Progress& progress, Setup setup)
      : csv_(csv), progress_(progress), setup_(std::move(setup)), scene_(setup_.scene), contacts_(scene_) {
    progress_.next(setup_.name + ", 50 digits");
    motion_ = simulate(scene_, contacts_, setup_.duration);
    if (motion_.status != MotionStatus::complete) throw std::runtime_error(setup_.name + ": " + motion_.message);
    for (std::size_t body = 0; body < scene_.bodies.size(); ++body)
      if (!scene_.bodies[body].fixed) {
        moving_.push_back(static_cast<int>(body));
        for (int i = 0; i < reference::kTimeComponent; ++i) rows_.push_back({moving_.back(), -1, setup_.duration, i});
      }
    const reference::Reference exact(scene_, reference::sequenceOf(motion_));
    for (const Knob& knob : reference::knobsOf(scene_)) {
      const std::string quantity = quantityOf(scene_, knob, setup_.for_engines);
      if (quantity.empty()) continue;
      double scale = 1;
      if (quantity == "inertia") scale = scene_.bodies[static_cast<std::size_t>(knob.index)].inertia.moments.mean();
      unknowns_.push_back({knob, quantity, scale});
      const std::vector<double> column = exact.derivative(knob, rows_);
      exact_.conservativeResize(static_cast<Eigen::Index>(rows_.size()), static_cast<Eigen::Index>(unknowns_.size()));
      exact_.rightCols(1) = Eigen::Map<const Eigen::VectorXd>(column.data(), exact_.rows());
    }
  }

  void passes() {
    Eigen::MatrixXd found = exact_;
    progress_.next(setup_.name + ", adjoint");
    double seconds = bestSeconds(
        [&] {
          DerivativeTape tape(motion_);
          for (Eigen::Index r = 0; r < found.rows(); ++r) {
            const StateSeed seed = reference::seedOf(rows_[static_cast<std::size_t>(r)]);
            SceneGradient gradient = adjoint(tape, {&seed, 1});
            for (Eigen::Index k = 0; k < found.cols(); ++k) found(r, k) = entryOf(gradient, unknown(k).knob);
          }
        },
        0.1);
    write("adjoint", 0, seconds, found);
    progress_.next(setup_.name + ", tangent");
    seconds = bestSeconds(
        [&] {
          DerivativeTape tape(motion_);
          for (Eigen::Index k = 0; k < found.cols(); ++k) {
            SceneTangent direction(scene_);
            entryOf(direction, unknown(k).knob) = 1;
            const MotionTangent rates = tangent(tape, direction);
            for (std::size_t b = 0; b < moving_.size(); ++b) {
              const BodyStateRate rate = rates.at(moving_[b], Instant::at(setup_.duration));
              found.block<12, 1>(12 * static_cast<Eigen::Index>(b), k) << rate.position, rate.orientation,
                  rate.velocity, rate.angular_velocity;
            }
          }
        },
        0.1);
    write("tangent", 0, seconds, found);
  }

  void differences() {
    for (const double nudge : kNudges) {
      progress_.next(setup_.name + ", differences");
      const double budget = 0.05;
      Eigen::MatrixXd found;
      const double seconds = bestSeconds(
          [&] {
            found = differencesOf(nudge, [&](const Scene& scene) {
              return statesAt(simulate(scene, contacts_, setup_.duration), setup_.duration);
            });
          },
          budget, 20);
      write("differences", nudge, seconds, found);
    }
  }

  void engineDifferences(const EngineKind& kind, double dt, const std::vector<double>& nudges) {
    for (const double nudge : nudges) {
      progress_.next(setup_.name + ", differences of " + kind.name);
      const double from = now();
      const Eigen::MatrixXd found = differencesOf(nudge, [&](const Scene& scene) {
        const auto engine = kind.make(scene, dt);
        for (long i = std::lround(setup_.duration / dt); i > 0; --i) engine->step();
        States states;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) states.push_back(engine->state(static_cast<int>(i)));
        return states;
      });
      write(kind.name + " at " + Cell(dt).text, nudge, now() - from, found);
    }
  }

  // The product of the derivatives of single steps, which know of places, velocities and turns alone.
  void engineChain(const EngineKind& kind, double dt, double nudge) {
    progress_.next(setup_.name + ", steps of " + kind.name);
    const double from = now();
    const auto engine = kind.make(scene_, dt);
    const auto state = [&](std::size_t b) { return engine->state(moving_[b]); };
    const Eigen::Index n = 6 * static_cast<Eigen::Index>(moving_.size());
    // from the engine's numbers to those of a scene: world axes
    const auto toWorld = [&] {
      Eigen::MatrixXd T = Eigen::MatrixXd::Zero(2 * n, 2 * n);
      for (std::size_t b = 0; b < moving_.size(); ++b) {
        const Eigen::Index x = 6 * static_cast<Eigen::Index>(b), row = 2 * x;
        const Mat3 R = state(b).orientation.toRotationMatrix();
        T.block<3, 3>(row, x).setIdentity();
        T.block<3, 3>(row + 3, x + 3) = R;
        T.block<3, 3>(row + 6, n + x).setIdentity();
        T.block<3, 3>(row + 9, n + x + 3) = R;
        T.block<3, 3>(row + 9, x + 3) = -skew(state(b).angular_velocity) * R;
      }
      return T;
    };
    const Eigen::MatrixXd start = toWorld().inverse();
    Eigen::MatrixXd product = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    for (long i = std::lround(setup_.duration / dt); i > 0; --i) {
      const Eigen::MatrixXd step = engine->stepDerivative(nudge);
      if (step.size() == 0) return;
      product = step * product;
    }
    const Eigen::MatrixXd by_states = toWorld() * product * start;
    const double seconds = now() - from;
    Eigen::MatrixXd found = Eigen::MatrixXd::Constant(exact_.rows(), exact_.cols(), NAN);
    const char* const kinds[] = {"position", "orientation", "velocity", "spin"};
    for (Eigen::Index k = 0; k < found.cols(); ++k)
      for (std::size_t kind_of = 0; kind_of < 4; ++kind_of)
        for (std::size_t b = 0; b < moving_.size(); ++b)
          if (unknown(k).quantity == kinds[kind_of] && unknown(k).knob.index == moving_[b])
            found.col(k) = by_states.col(static_cast<Eigen::Index>(12 * b + 3 * kind_of) + unknown(k).knob.component);
    write(kind.name + " steps at " + Cell(dt).text, nudge, seconds, found);
  }

 private:
  const Unknown& unknown(Eigen::Index k) const { return unknowns_[static_cast<std::size_t>(k)]; }

  template <class Play>
  Eigen::MatrixXd differencesOf(double nudge, const Play& play) const {
    Eigen::MatrixXd found(exact_.rows(), exact_.cols());
    for (Eigen::Index k = 0; k < found.cols(); ++k) {
      const double h = nudge * unknown(k).scale;
      try {
        const States up = play(moved(scene_, unknown(k), h)), down = play(moved(scene_, unknown(k), -h));
        for (std::size_t b = 0; b < moving_.size(); ++b) {
          const BodyState &s = up[static_cast<std::size_t>(moving_[b])],
                          &t = down[static_cast<std::size_t>(moving_[b])];
          const Eigen::AngleAxisd turn(s.orientation.normalized() * t.orientation.normalized().conjugate());
          const double angle = turn.angle() > M_PI ? turn.angle() - 2 * M_PI : turn.angle();
          found.block<12, 1>(12 * static_cast<Eigen::Index>(b), k) << s.position - t.position, angle * turn.axis(),
              s.velocity - t.velocity, s.angular_velocity - t.angular_velocity;
        }
        found.col(k) /= 2 * h;
      } catch (const std::exception&) {  // a nudge that leaves what a scene may be: e > 1, moments no body has
        found.col(k).setConstant(NAN);
      }
    }
    return found;
  }

  // Worst relative error of the entries of each quantity, and of all of them. NaN where a number is none.
  void write(const std::string& method, double nudge, double seconds, const Eigen::MatrixXd& found) {
    std::vector<std::string> quantities;
    for (const Unknown& u : unknowns_)
      if (std::find(quantities.begin(), quantities.end(), u.quantity) == quantities.end())
        quantities.push_back(u.quantity);
    double worst_of_all = 0;
    for (const std::string& quantity : quantities) {
      double worst = 0;
      for (Eigen::Index k = 0; k < found.cols(); ++k) {
        if (unknown(k).quantity != quantity) continue;
        for (Eigen::Index r = 0; r < found.rows(); ++r) {
          const double largest = exact_.block<3, 1>(r - r % 3, k).cwiseAbs().maxCoeff();
          const double whole = exact_.col(k).cwiseAbs().maxCoeff();
          const double scale = std::max({std::abs(exact_(r, k)), kSmall * largest, kSmallInColumn * whole});
          const double error = std::abs(found(r, k) - exact_(r, k)) / scale;
          if (!(error <= worst)) worst = error;
          if (std::isnan(worst)) break;
        }
        if (std::isnan(worst)) break;
      }
      csv_.row({setup_.name, method, nudge, seconds, quantity, std::max(worst, 1e-17)});
      if (!(worst <= worst_of_all)) worst_of_all = worst;
    }
    csv_.row({setup_.name, method, nudge, seconds, "all", worst_of_all});
  }

  Csv& csv_;
  Progress& progress_;
  Setup setup_;
  const Scene& scene_;
  OdeContacts contacts_;
  Motion motion_;
  std::vector<int> moving_;
  std::vector<Row> rows_;
  std::vector<Unknown> unknowns_;
  Eigen::MatrixXd exact_;
};

}  // namespace

void measure(Csv& csv) {
  csv.note(
      "d(places; rotation vectors; velocities; spins of all bodies at the end)/d(numbers of the scene), all together");
  csv.note(
      "error: the worst of all entries by one quantity: over the entry; at least 1e-2 of its vector's largest and");
  csv.note("1e-3 of its column's; against differences in 50 digits. nan: a number that the method does not give");
  csv.note(
      "step: of the differences, SI units, of moments their mean; seconds: for all entries, without the nominal "
      "motion");
  csv.note("'MuJoCo steps': the product of mjd_transitionFD of all steps, with Euler's integrator");
  csv.columns({"scene", "method", "step", "seconds", "quantity", "error"});
  std::vector<Setup> setups = {setup("box", true), setup("box", false), setup("two boxes", true)};
  Progress progress(static_cast<int>(setups.size() * 17 + engines().size() * 17));
  for (const Setup& s : setups) {
    Comparison comparison(csv, progress, s);
    comparison.passes();
    comparison.differences();
    if (!s.for_engines) continue;
    for (const EngineKind& kind : engines()) {
      if (kind.name == "ODE quick") continue;
      const bool slow = kind.name == "MuJoCo";  // by twenty times
      comparison.engineDifferences(kind, 1e-3, logSpaced(1e-1, slow ? 1e-5 : 1e-13, slow ? 3 : 7));
      comparison.engineChain(kind, 1e-3, 1e-6);
      if (&s != setups.data() || slow) continue;  // the same again would take a minute
      comparison.engineDifferences(kind, 1e-4, {1e-3});
    }
  }
}

}  // namespace carom::charts

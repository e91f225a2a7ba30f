// SPDX-License-Identifier: MIT
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "adjoint/scene/body_model.h"
#include "bench/charts/engines/engine.h"

// MuJoCo has no restitution: contacts are damped springs. Their damping is chosen so that a lone impact has the
// scene's restitution, their stiffness so that it lasts a number of steps that grows slowly as the steps shrink: then
// both the length of the contact and its error of stepping go to zero.

namespace carom::charts {
namespace {

// Restitution of a damped spring that does not pull (Schwager and Poeschel, Granular Matter 9, 2007).
double restitutionOf(double damping_ratio) {
  const double root = std::sqrt(1 - damping_ratio * damping_ratio);
  return std::exp(-2 * damping_ratio / root * std::atan2(root, damping_ratio));
}

double dampingRatioFor(double elasticity) {
  double low = 0, high = 1 - 1e-9;
  if (restitutionOf(high) >= elasticity) return high;  // the least that a spring without overdamping gives: 0.135
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (restitutionOf(middle) > elasticity ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Half a period of the spring, in steps.
double contactSteps(double dt) { return 5 * std::pow(0.01 / dt, 0.35); }

void write(std::ostream& out, const Vec3& v) { out << '"' << v.x() << ' ' << v.y() << ' ' << v.z() << '"'; }

void writeGeom(std::ostream& out, const Body& body) {
  out << "<geom type=";
  if (const auto* s = std::get_if<Sphere>(&body.shape)) {
    out << "\"sphere\" size=\"" << s->radius << '"';
  } else if (const auto* b = std::get_if<Box>(&body.shape)) {
    out << "\"box\" size=";
    write(out, 0.5 * b->size);
  } else if (const auto* p = std::get_if<Plane>(&body.shape)) {
    out << "\"plane\" size=\"0 0 1\" zaxis=";
    write(out, p->normal);
    out << " pos=";
    write(out, p->offset * p->normal);
  } else {
    throw std::invalid_argument("'" + body.name + "' is no sphere, box or plane");
  }
}

std::string documentOf(const Scene& scene, double dt) {
  const PairCoefficients pair = commonPair(scene);
  const double ratio = dampingRatioFor(pair.elasticity);
  const double frequency = M_PI / (contactSteps(dt) * dt) / std::sqrt(1 - std::min(0.5, ratio * ratio));
  std::ostringstream out;
  out.precision(17);
  out << "<mujoco><option timestep=\"" << dt
      << "\" integrator=\"RK4\" cone=\"elliptic\" iterations=\"100\" tolerance=\"0\" gravity=";
  write(out, scene.gravity);
  out << "/><default><geom condim=\"" << (pair.friction > 0 ? 3 : 1) << "\" friction=\"" << pair.friction
      << " 0 0\" margin=\"0\" solimp=\"0.9999 0.9999 0.001\" solref=\"" << -frequency * frequency << ' '
      << -std::max(2 * ratio * frequency, 1e-12) << "\"/></default><worldbody>";
  for (const Body& body : scene.bodies) {
    const bool inside = !body.fixed || !std::holds_alternative<Plane>(body.shape);
    if (inside) {
      const Quat& q = body.orientation;
      out << "<body pos=";
      write(out, body.position);
      out << " quat=\"" << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << "\">";
    }
    if (!body.fixed) {
      const BodyModel model = modelOf(body);
      out << "<freejoint/><inertial pos=\"0 0 0\" mass=\"" << model.mass << "\" diaginertia=";
      write(out, model.inertia);
      out << "/>";
    }
    writeGeom(out, body);
    out << "/>" << (inside ? "</body>" : "");
  }
  out << "</worldbody><size njmax=\"500\" nconmax=\"100\"/></mujoco>";
  return out.str();
}

class MujocoEngine final : public Engine {
 public:
  MujocoEngine(const Scene& scene, double dt) {
    static const bool silent = [] {
      mju_user_warning = [](const char*) {};
      return true;
    }();
    (void)silent;
    load(documentOf(scene, dt));
    int joint = 0;
    for (const Body& body : scene.bodies) {
      joints_.push_back(body.fixed ? -1 : joint++);
      if (body.fixed) continue;
      mjtNum* v = data_->qvel + 6 * joints_.back();
      const Vec3 w = body.orientation.conjugate() * body.angular_velocity;
      for (int i = 0; i < 3; ++i) v[i] = body.velocity[i], v[3 + i] = w[i];
    }
  }
  ~MujocoEngine() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoEngine(const MujocoEngine&) = delete;

  void step() override { mj_step(model_, data_); }
  // mjd_transitionFD knows Euler's integrators only.
  Eigen::MatrixXd stepDerivative(double nudge) override {
    model_->opt.integrator = mjINT_EULER;
    Eigen::Matrix<mjtNum, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> A(2 * model_->nv, 2 * model_->nv);
    mjd_transitionFD(model_, data_, nudge, 1, A.data(), nullptr, nullptr, nullptr);
    step();
    return A;
  }

  BodyState state(int body) const override {
    const int joint = joints_.at(static_cast<std::size_t>(body));
    BodyState s;
    if (joint < 0) return s;
    const mjtNum *x = data_->qpos + 7 * joint, *v = data_->qvel + 6 * joint;
    s.position = {x[0], x[1], x[2]};
    s.orientation = Quat(x[3], x[4], x[5], x[6]);
    s.velocity = {v[0], v[1], v[2]};
    s.angular_velocity = s.orientation * Vec3(v[3], v[4], v[5]);
    return s;
  }

 private:
  void load(const std::string& text) {
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    if (mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size())) != 0)
      throw std::runtime_error("MuJoCo does not take a document of " + std::to_string(text.size()) + " bytes");
    std::memcpy(files->filedata[files->nfile - 1], text.data(), text.size());
    char error[512] = "";
    model_ = mj_loadXML("scene.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo refuses a scene: ") + error);
    data_ = mj_makeData(model_);
  }

  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> joints_;
};

}  // namespace

EngineKind mujoco() {
  return {"MuJoCo", std::string("MuJoCo ") + mj_versionString() + ", RK4, contacts are damped springs",
          [](const Scene& scene, double dt) -> std::unique_ptr<Engine> {
            return std::make_unique<MujocoEngine>(scene, dt);
          }};
}

}  // namespace carom::charts

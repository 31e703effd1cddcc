#include "mujoco_peer.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

namespace whirl_twin::comparison {
namespace {

constexpr const char* kFile = "double_pendulum.xml";
// Constraints are disabled: there are none, and contact detection would take time.
constexpr const char* kPendulum = R"(<mujoco>
  <compiler angle="radian"/>
  <option gravity="0 0 -9.81" integrator="RK4"><flag constraint="disable"/></option>
  <worldbody>
    <body>
      <joint type="hinge" axis="0 1 0"/>
      <inertial pos="0 0 -1" mass="1" diaginertia="1e-12 1e-12 1e-12"/>
      <body pos="0 0 -1">
        <joint type="hinge" axis="0 1 0"/>
        <inertial pos="0 0 -1" mass="1" diaginertia="1e-12 1e-12 1e-12"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";

using ModelPointer = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using DataPointer = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

ModelPointer load() {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const std::string text = kPendulum;
  mj_makeEmptyFileVFS(files.get(), kFile, static_cast<int>(text.size()));
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
  char message[256] = "";
  ModelPointer model(mj_loadXML(kFile, files.get(), message, sizeof message), &mj_deleteModel);
  mj_deleteVFS(files.get());
  if (!model) {
    throw std::runtime_error(std::string("MuJoCo does not take the double pendulum: ") + message);
  }
  return model;
}

class MujocoRun final : public Run {
 public:
  MujocoRun(double upper, double lower, const Output& output, std::size_t steps)
      : upper_(upper),
        lower_(lower),
        output_(output),
        steps_(steps),
        model_(load()),
        data_(mj_makeData(model_.get()), &mj_deleteData) {
    model_->opt.timestep = output.interval / static_cast<double>(steps);
  }

  bool integrate(double* out) override {
    mj_resetData(model_.get(), data_.get());
    data_->qpos[0] = upper_;
    data_->qpos[1] = lower_ - upper_;
    for (std::size_t sample = 0; sample < output_.samples; ++sample) {
      for (std::size_t i = 0; i < steps_; ++i) {
        mj_step(model_.get(), data_.get());
      }
      *out++ = data_->qpos[0];
      *out++ = data_->qpos[0] + data_->qpos[1];
    }
    // A state that is not finite makes it start again, with a warning.
    return data_->warning[mjWARN_BADQPOS].number == 0 && data_->warning[mjWARN_BADQACC].number == 0;
  }

 private:
  double upper_, lower_;
  Output output_;
  std::size_t steps_;
  ModelPointer model_;
  DataPointer data_;
};

}  // namespace

void addMujoco(double upper_angle, double lower_angle, const Output& output,
               std::vector<Contender>& contenders) {
  mju_user_warning = [](const char*) {};  // else it writes them to a file
  contenders.push_back({"MuJoCo RK4", false, Ladder::kSteps, stepCounts(),
                        [upper_angle, lower_angle, output](double steps) {
                          return std::make_unique<MujocoRun>(upper_angle, lower_angle, output,
                                                             static_cast<std::size_t>(steps));
                        }});
}

}  // namespace whirl_twin::comparison

#include "emulator/control_compensation.h"

#include "setup/control_axes.h"

namespace trunnion::emulator {

namespace {

class ControlCompensation final : public EffectModel {
  public:
    explicit ControlCompensation(std::vector<offsets::AxisCompensation> axes)
        : axes_(std::move(axes)) {}

    void perturb(const AxisSample& sample, const Contact& contact,
                 kinematics::Perturbation& out) const override {
        // The encoder of the motor is what the control compensates: its own display counts without.
        if (contact.device == records::Device::axis && !contact.scale_encoder) return;
        for (const offsets::AxisCompensation& one : axes_)
            out.axis[one.axis] +=
                one.at_position(sample.position[one.axis], sample.travel[index_of(one.axis)]);
    }

  private:
    std::vector<offsets::AxisCompensation> axes_;
};

}  // namespace

std::shared_ptr<const EffectModel> control_compensation(const setup::Setup& setup) {
    auto axes = setup::compensated_axes(setup);
    return axes.empty() ? nullptr : std::make_shared<ControlCompensation>(std::move(axes));
}

}  // namespace trunnion::emulator

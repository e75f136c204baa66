#include "effects/effect.h"

#include <utility>

namespace trunnion::effects {
namespace {

class FunctionModel final : public emulator::EffectModel {
  public:
    FunctionModel(EffectFunction add, std::vector<double> values)
        : add_(std::move(add)), values_(std::move(values)) {}
    void perturb(const AxisSample& sample, const emulator::Contact& contact,
                 kinematics::Perturbation& out) const override {
        add_(sample, contact, values_, out);
    }

  private:
    EffectFunction add_;
    std::vector<double> values_;
};

}  // namespace

std::vector<double> Effect::zeros() const {
    std::vector<double> values;
    for (const EffectParameter& p : parameters) values.push_back(p.is_key() ? p.typical : 0.0);
    return values;
}

std::shared_ptr<const emulator::EffectModel> make_model(const Effect& effect,
                                                        std::vector<double> values) {
    return std::make_shared<FunctionModel>(effect.add, std::move(values));
}

}  // namespace trunnion::effects

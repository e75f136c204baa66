#include "controller/block_trial.h"

#include "controller/block_execution.h"
#include "controller/system_variables.h"

namespace trunnion::controller {

namespace {

class NoAxes : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove&) override { return {}; }
};

template <typename Work>
std::optional<Alarm> alarm_of(Work work) {
    try {
        work();
    } catch (const Alarm& alarm) {
        return alarm;
    }
    return std::nullopt;
}

}  // namespace

struct BlockTrial::State {
    State(ControlConfig config, offsets::Stores stores_)
        : stores(std::move(stores_)),
          control(std::move(config), stores, sink),
          variables(control) {}
    offsets::Stores stores;
    NoAxes sink;
    Control control;
    ControlVariables variables;
};

BlockTrial::BlockTrial(ControlConfig config, offsets::Stores stores)
    : state_(std::make_unique<State>(std::move(config), std::move(stores))) {}
BlockTrial::~BlockTrial() = default;

std::optional<Alarm> BlockTrial::run(const interpreter::BlockWords& block) {
    return alarm_of([&] { execute_block(state_->control, block); });
}

std::optional<Alarm> BlockTrial::read(const interpreter::BlockWords& block) {
    return alarm_of([&] { read_block(state_->control, block); });
}

std::optional<Alarm> BlockTrial::end() {
    return alarm_of([&] { state_->control.mover.cutter.flush(); });
}

std::optional<Alarm> BlockTrial::assign(int number, double value, const std::string& comment) {
    return alarm_of([&] { state_->variables.set(number, value, comment.c_str()); });
}

std::vector<ToldCaution> BlockTrial::cautions() {
    std::vector<ToldCaution> out;
    for (const Caution& caution : state_->control.mover.record().cautions.take())
        out.push_back(told(caution));
    return out;
}

interpreter::EvaluationRules BlockTrial::rules() const {
    interpreter::EvaluationRules rules;
    rules.signed_angles = state_->control.stores.parameters.bit(6004, 0);
    rules.increments_per_unit = state_->control.modal.units.inch() ? 1e4 : 1e3;
    return rules;
}

int variable_alarm(int number, bool writes, const ControlConfig& config,
                   const offsets::Stores& stores) {
    if (number == 3000 || number == 3006) return writes ? 0 : 115;
    offsets::Stores own = stores;
    NoAxes sink;
    Control control(config, own, sink);
    ControlVariables variables(control);
    const auto alarm = alarm_of([&] {
        if (writes)
            variables.set(number, 0.0, "");
        else
            variables.get(number);
    });
    return alarm ? alarm->number : 0;
}

}  // namespace trunnion::controller

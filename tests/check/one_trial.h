// The control's trial of blocks as check asks for it, for tests.
#pragma once

#include "check/check.h"
#include "controller/block_trial.h"

namespace trunnion::testing {

class OneTrial : public check::Trial {
  public:
    OneTrial(const controller::ControlConfig& config, const offsets::Stores& stores)
        : trial_(config, stores) {}
    std::optional<Alarm> run(const interpreter::BlockWords& block) override {
        return trial_.run(block);
    }
    std::optional<Alarm> read(const interpreter::BlockWords& block) override {
        return trial_.read(block);
    }
    std::optional<Alarm> end() override { return trial_.end(); }

  private:
    controller::BlockTrial trial_;
};

}  // namespace trunnion::testing

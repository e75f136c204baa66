#include "controller/control.h"

#include "offsets/whole_parameter.h"

namespace trunnion::controller {

namespace {

ControlConfig in_order(ControlConfig config, const offsets::Parameters& parameters) {
    sort_axes(config.axes, parameters);
    take_strokes(config.axes, parameters);
    return config;
}

}  // namespace

Control::Control(ControlConfig config_, offsets::Stores& stores_, motion::MotionSink& sink)
    : config(in_order(std::move(config_), stores_.parameters)),
      stores(stores_),
      frames(stores_),
      mover(words, modal, frames, sink),
      m_codes(config),
      clock(config.clock_s) {
    modal.codes = initial_modal_codes(offsets::bits_of_parameter(stores.parameters.get(3402)));
    if (stores.parameters.bit(0, 2)) modal.codes.set(ModalGroup::units, 200);
    mover.axes.configure(config);
    parameters_changed();
    frames.stages.local = stores.work.local;
    frames.stages.preset = stores.work.preset;
    frames.take_work_offset(modal);
    frames.stand_at({});
}

void Control::parameters_changed() {
    modal.settings = decode_settings(stores.parameters, config);
    frames.parameters_changed(modal.settings);
    mover.axes.parameters_changed();
    mover.cutter.set(modal.settings.cutter);
    modal.units_changed();
}

}  // namespace trunnion::controller

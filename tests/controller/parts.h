// The owners that a subject of the control works on, without a control.
#pragma once

#include <initializer_list>
#include <utility>

#include "block_bench.h"

namespace trunnion::bench {

/// Words, modal state, frames and a mover on a recorder: X Y Z B C, all at zero, G1 F600.
struct Parts {
    Parts() : frames(stores), mover(words, modal, frames, sink) {
        const controller::ControlConfig config = five_axes();
        modal.codes = controller::initial_modal_codes(1);
        modal.settings = controller::decode_settings(stores.parameters, config);
        mover.axes.configure(config);
        mover.axes.parameters_changed();
        mover.cutter.set(modal.settings.cutter);
        modal.block.feed.programmed = 600.0;
        modal.units_changed();
        frames.take_work_offset(modal);
        frames.stand_at({});
    }
    /// The words of the next block, with decimal points.
    void say(std::initializer_list<std::pair<char, double>> block) {
        words.clear();
        words.units = modal.units;
        for (const auto& [letter, value] : block) {
            words.present |= controller::SortedWords::bit(letter);
            words.value[static_cast<std::size_t>(letter - 'A')] = value;
        }
    }
    offsets::ControlPosition at(double x, double y, double z) const {
        offsets::ControlPosition p;
        offsets::set_xyz(p, {x, y, z});
        return p;
    }

    offsets::Stores stores;
    Recorder sink;
    controller::SortedWords words;
    controller::Modal modal;
    controller::Frames frames;
    controller::Mover mover;
};

}  // namespace trunnion::bench

// A control on the bench: blocks typed as text, moves recorded. No language, no machine.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "controller/block_execution.h"
#include "controller/system_variables.h"

namespace trunnion::bench {

inline controller::ControlConfig five_axes() {
    controller::ControlConfig config;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        config.axes.push_back(entry);
    }
    return config;
}

class Recorder : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove& m) override {
        moves.push_back(m);
        if (m.until_skip && trigger_at >= 0.0) return {true, m.at(trigger_at), trigger_at};
        return {};
    }
    void dwell(double duration_s) override { dwells.push_back(duration_s); }
    void m_code(int code) override { m_codes.push_back(code); }

    std::vector<motion::AxisMove> moves;
    std::vector<double> dwells;
    std::vector<int> m_codes;
    double trigger_at = -1.0;  ///< s of G31 moves at which the skip signal comes
};

/// "G1 X10. Y#" as words: letters and numbers only, `,R1.` as 'r'.
inline interpreter::BlockWords words_of(const std::string& text) {
    interpreter::BlockWords block;
    bool comma = false;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == ' ' || text[i] == ',') {
            comma = comma || text[i] == ',';
            ++i;
            continue;
        }
        interpreter::WordValue word;
        word.letter = static_cast<char>(comma ? text[i] - 'A' + 'a' : text[i]);
        word.column = static_cast<std::uint16_t>(i + 1);
        char* end = nullptr;
        word.value = std::strtod(text.c_str() + i + 1, &end);
        const auto next = static_cast<std::size_t>(end - text.c_str());
        word.decimal_point = text.substr(i, next - i).find('.') != std::string::npos;
        i = next;
        comma = false;
        if (word.letter == 'N') {
            block.sequence_number = static_cast<int>(word.value);
            continue;
        }
        block.words[block.count++] = word;
    }
    return block;
}

struct Bench {
    explicit Bench(controller::ControlConfig config = five_axes())
        : control(std::move(config), stores, sink) {}

    /// Runs blocks separated by ';'.
    void operator()(const std::string& program) {
        std::size_t from = 0;
        while (from <= program.size()) {
            const std::size_t to = std::min(program.find(';', from), program.size());
            interpreter::BlockWords block = words_of(program.substr(from, to - from));
            block.line = ++line;
            if (block.count) controller::execute_block(control, block);
            from = to + 1;
        }
    }
    /// Number of the alarm that the blocks raise, 0 for none.
    int alarm(const std::string& program) {
        try {
            (*this)(program);
        } catch (const Alarm& alarm) {
            return alarm.number;
        }
        return 0;
    }
    double variable(int number) { return controller::ControlVariables(control).get(number); }
    void set(int number, double value) {
        controller::ControlVariables(control).set(number, value, "");
    }
    const motion::AxisMove& last() const { return sink.moves.back(); }

    offsets::Stores stores;
    Recorder sink;
    controller::Control control;
    int line = 0;
};

}  // namespace trunnion::bench

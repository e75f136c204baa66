// Runs a program text with nothing behind it and keeps what came out.
#pragma once

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/alarms.h"
#include "interpreter/interpreter.h"

namespace trunnion::test {

struct PlainSystem : interpreter::SystemVariables {
    double get(int number) override {
        const auto it = values.find(number);
        if (it == values.end()) interpreter::raise_language_alarm(115);
        return it->second;
    }
    void set(int number, double value, const char* comment) override {
        if (number == 3000) throw Alarm(3000 + static_cast<int>(value), comment);
        values[number] = value;
        comments[number] = comment;
    }
    double parameter(int number, int bit, int axis) override {
        return number + 0.1 * bit + 0.01 * axis;
    }
    std::map<int, double> values;
    std::map<int, std::string> comments;
};

struct Run {
    std::vector<std::string> blocks;  ///< "G1 X10 Y-2.5": words as given out, vacant ones dropped
    std::string printed;
    std::optional<Alarm> alarm;
    std::map<int, double> common;
    PlainSystem system;
    bool limit = false;
    std::uint64_t executed = 0;

    double operator[](int number) const {
        const auto it = common.find(number);
        return it == common.end() ? interpreter::vacant : it->second;
    }
};

inline std::string text_of(const interpreter::BlockWords& words) {
    std::string out;
    for (const interpreter::WordValue& w : words) {
        if (w.vacant) continue;
        if (!out.empty()) out += ' ';
        out += fmt::format("{}{:.10g}", w.letter, w.value);
    }
    return out;
}

inline bool moves(const interpreter::BlockWords& words) {
    for (const interpreter::WordValue& w : words)
        if (std::string("XYZABC").find(w.letter) != std::string::npos && !w.vacant) return true;
    return false;
}

inline Run run_on(interpreter::ProgramSource& source, const std::string& text,
                  interpreter::InterpreterOptions options = {}, Run run = {}) {
    if (options.max_blocks == 0) options.max_blocks = 100000;
    interpreter::Interpreter nc(source, options, run.system,
                                [&](std::string_view line) { run.printed += line; });
    try {
        nc.open(interpreter::ProgramText{"main.nc", text, nullptr});
        while (const interpreter::BlockWords* words = nc.next()) {
            run.blocks.push_back(text_of(*words));
            if (moves(*words)) nc.block_moved();
            for (const interpreter::WordValue& w : *words)
                if (w.letter == 'M' && (w.value == 30 || w.value == 2)) nc.end_program();
        }
    } catch (const Alarm& alarm) {
        run.alarm = alarm;
    }
    for (const int number : nc.used_common_variables()) run.common[number] = nc.variable(number);
    run.limit = nc.limit_reached();
    run.executed = nc.blocks_executed();
    return run;
}

inline Run run(const std::string& text, interpreter::InterpreterOptions options = {}) {
    interpreter::ProgramsInMemory none;
    return run_on(none, text, options);
}

/// Number of the alarm, 0 when there was none.
inline int alarm_of(const std::string& text, interpreter::InterpreterOptions options = {}) {
    const Run r = run(text, options);
    return r.alarm ? r.alarm->number : 0;
}

/// Value of #100 after the program.
inline double value_of(const std::string& expression,
                       interpreter::InterpreterOptions options = {}) {
    const Run r = run("#100=" + expression + "\n", options);
    if (r.alarm) throw *r.alarm;
    return r[100];
}

using Blocks = std::vector<std::string>;

}  // namespace trunnion::test

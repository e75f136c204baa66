#include "choices/control_path.h"

#include <algorithm>
#include <cmath>

#include "base/waiting.h"
#include "controller/controller.h"
#include "emulator/run.h"
#include "setup/hurco_keys.h"

namespace trunnion::choices {

namespace {

using offsets::ControlPosition;

constexpr int most_chords = 512;
/// A curve is 4 parts, halved up to 7 times to 512 chords, where it has a corner up to 16 times:
/// corners of a way of 1 m are told to 0.004 mm along it.
constexpr int parts_of_curve = 4, most_halved = 7, most_halved_at_corner = 16;
constexpr double straight_half =
    0.1;  ///< bend of a half beside a corner; of half an arc it is 0.25

double distance(const ControlPosition& a, const ControlPosition& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
    return std::sqrt(sum);
}

ControlPosition place(const motion::AxisMove& m, double s) {
    return offsets::control_position_of(m.at(s));
}

/// Distance of the middle of a chord from the curve, maximum over `n` chords.
double sag(const motion::AxisMove& m, int n) {
    double most = 0.0;
    for (int k = 0; k < n; ++k) {
        const ControlPosition from = place(m, static_cast<double>(k) / n),
                              to = place(m, (k + 1.0) / n), middle = place(m, (k + 0.5) / n);
        ControlPosition chord;
        for (std::size_t i = 0; i < axis_count; ++i)
            chord.value[i] = 0.5 * (from.value[i] + to.value[i]);
        most = std::max(most, distance(chord, middle));
    }
    return most;
}

/// A part of a move: from 0 at its start to 1 at its end.
struct CurvePart {
    double begin, end;
};

/// Distance of the chord of a part of a curve from it, at its quarters.
double bend_of(const motion::AxisMove& m, const CurvePart& of) {
    const ControlPosition from = place(m, of.begin), to = place(m, of.end);
    double most = 0.0;
    for (const double part : {0.25, 0.5, 0.75}) {
        ControlPosition chord;
        for (std::size_t i = 0; i < axis_count; ++i)
            chord.value[i] = from.value[i] + part * (to.value[i] - from.value[i]);
        most = std::max(most, distance(chord, place(m, of.begin + part * (of.end - of.begin))));
    }
    return most;
}

class PathSink : public motion::MotionSink {
  public:
    PathSink(ControlPath& path, const PathOptions& options, const std::string& main)
        : path_(path), options_(options), main_(main) {}

    motion::MoveResult move(const motion::AxisMove& m) override {
        if (options_.moves_only) return {};
        const std::uint32_t block = block_of(m);
        const int parts = parts_of(m);
        for (int k = 1; k <= parts; ++k)
            add(m, block, {(k - 1.0) / parts, static_cast<double>(k) / parts}, 0);
        return {};
    }

  private:
    /// The end of the part, and the parts of it that its chord leaves: a curve with a corner (a
    /// rapid without interpolation) is halved where the corner is, however fine the others are.
    void add(const motion::AxisMove& m, std::uint32_t block, const CurvePart& part, int halved) {
        if (m.curve != nullptr && !options_.ends_only && is_halved(m, part, halved)) {
            const double middle = 0.5 * (part.begin + part.end);
            add(m, block, {part.begin, middle}, halved + 1);
            add(m, block, {middle, part.end}, halved + 1);
            return;
        }
        const double feed = m.kind == motion::MotionKind::rapid ? 0.0 : m.feed_mm_min;
        path_.nodes.push_back({place(m, part.end), block, part.end == 1.0, feed});
    }

    bool is_halved(const motion::AxisMove& m, const CurvePart& part, int halved) const {
        if (halved >= most_halved_at_corner) return false;
        const double all = bend_of(m, part);
        if (all <= options_.chord_mm || halved < most_halved) return all > options_.chord_mm;
        const double middle = 0.5 * (part.begin + part.end);
        return std::min(bend_of(m, {part.begin, middle}), bend_of(m, {middle, part.end})) <
               straight_half * all;
    }

    int parts_of(const motion::AxisMove& m) const {
        if (options_.ends_only) return options_.arc_points && m.arc ? arc_parts : 1;
        if (m.curve != nullptr) return parts_of_curve;
        if (!m.arc) return 1;
        int n = 4;
        while (n < most_chords && sag(m, n) > options_.chord_mm) n *= 2;
        return n;
    }
    std::uint32_t block_of(const motion::AxisMove& m) {
        const std::string program = m.program == nullptr || *m.program == main_ ? "" : *m.program;
        const auto [known, fresh] =
            index_.try_emplace({program, m.line}, static_cast<std::uint32_t>(path_.blocks.size()));
        if (fresh) path_.blocks.push_back({program, m.line});
        return known->second;
    }

    ControlPath& path_;
    const PathOptions& options_;
    const std::string& main_;
    std::map<std::pair<std::string, int>, std::uint32_t> index_;
};

}  // namespace

ControlPath path_of(const setup::Setup& setup, const interpreter::ProgramText& program,
                    interpreter::ProgramSource& programs, const PathOptions& options) {
    ControlPath path;
    path.nodes.push_back({offsets::control_position_of(options.start), 0, true});
    path.blocks.emplace_back();
    PathSink sink(path, options, program.name);
    offsets::Stores stores = setup.stores;
    // Read from a file they are in the parameters already; a change of the search is not.
    setup::believe_centrelines(setup, stores.parameters);
    controller::ControlConfig config = emulator::control_config(setup);
    config.max_blocks = options.max_blocks;
    config.go_on = [](std::uint64_t) { return !work_must_end(); };
    controller::Controller control(std::move(config), stores, programs, sink,
                                   [](std::string_view) {});
    control.place(options.start);
    for (const auto& [number, value] : setup.stores.variables) control.set_variable(number, value);
    const controller::RunResult result = control.run(program);
    path.alarm = result.alarm;
    path.limited = result.status == controller::RunStatus::limit;
    if (work_must_end()) throw PathEnded();
    return path;
}

}  // namespace trunnion::choices

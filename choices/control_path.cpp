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

class PathSink : public motion::MotionSink {
  public:
    PathSink(ControlPath& path, const PathOptions& options, const std::string& main)
        : path_(path), options_(options), main_(main) {}

    motion::MoveResult move(const motion::AxisMove& m) override {
        if (options_.moves_only) return {};
        const std::uint32_t block = block_of(m);
        const int parts = parts_of(m);
        for (int k = 1; k <= parts; ++k)
            path_.nodes.push_back({place(m, static_cast<double>(k) / parts), block, k == parts});
        return {};
    }

  private:
    int parts_of(const motion::AxisMove& m) const {
        if (options_.ends_only) return options_.arc_points && m.arc ? arc_parts : 1;
        if (!m.arc && m.curve == nullptr) return 1;
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

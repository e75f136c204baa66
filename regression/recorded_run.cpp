#include "regression/recorded_run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/units.h"
#include "emulator/machine_sink.h"
#include "emulator/run.h"
#include "emulator/tool_tip.h"
#include "interpreter/program_folders.h"
#include "positioning/rotary_transform.h"
#include "regression/hash_mix.h"

namespace trunnion::regression {

namespace {

/// Targets, modal state and M codes of each move as one number. Targets are rounded to 0.0001 mm
/// and deg: finer than the increment of a control, coarser than rounding errors.
class BlockKeys {
  public:
    explicit BlockKeys(KeyedLines& lines) : lines_(lines) {}

    void move(const motion::AxisMove& m) {
        std::uint64_t h = mix(1, static_cast<std::uint64_t>(m.kind) | (m.until_skip ? 8U : 0U) |
                                     (m.gap_free ? 16U : 0U) | (m.coolant ? 32U : 0U) |
                                     (m.curve != nullptr ? 64U : 0U) |
                                     (static_cast<std::uint64_t>(m.mode) << 8U));
        for (const Axis axis : all_axes)
            h = mix(h, grid(is_rotary(axis) ? deg_from_rad(m.to[axis]) : m.to[axis]));
        h = mix(h, grid(m.feed_mm_min));
        h = mix(h, grid(m.spindle_rpm));
        h = mix(h, static_cast<std::uint64_t>(m.tool) * 1000U +
                       static_cast<std::uint64_t>(m.tool_offset));
        for (int k = 0; k < 3; ++k) h = mix(h, grid(m.tool_vector_mm[k]));
        if (m.arc) {
            for (int k = 0; k < 3; ++k) h = mix(h, grid(m.arc->centre_mm[k]));
            h = mix(h, grid(deg_from_rad(m.arc->sweep_rad)));
        }
        lines_.append({h, static_cast<std::uint32_t>(m.line)});
    }

  private:
    static std::uint64_t grid(double value) {
        return static_cast<std::uint64_t>(std::llround(value * 1e4));
    }

    KeyedLines& lines_;
};

/// Records path, block keys, functions and states of one run at the same time.
class RecordingSink : public motion::MotionSink {
  public:
    RecordingSink(RecordedRun& run, const setup::Setup& setup, const RecordOptions& options)
        : run_(run),
          path_(run.path, options.space, options.tolerances),
          keys_(run.blocks),
          functions_(run.functions, run.path, run.blocks) {
        if (options.devices)
            machine_.emplace(setup, emulator::EffectModels{}, emulator::SinkOptions{});
    }
    motion::MoveResult move(const motion::AxisMove& move) override {
        const motion::MoveResult made = machine_ ? machine_->move(move) : motion::MoveResult{};
        run_.skips = run_.skips || move.until_skip;
        motion::AxisMove seen = move;
        if (made.skipped) seen.to = made.stopped;
        path_.feeds_by_time(feeds_by_inverse_time(*control_));
        functions_.before_move(seen, unset_offsets(*control_),
                               path_.length_of_tool_mm(seen.tool) != 0.0);
        keys_.move(seen);
        path_.move(seen);
        return made;
    }
    /// The tools of this setup are in the magazine; it must outlive the run.
    void tools_of(const setup::Setup& setup) {
        path_.tools_are([&setup](int tool) { return emulator::tool_length_mm(setup, tool); });
    }
    void see_through(const positioning::RotaryTransform& transform, const offsets::Stores& stores) {
        std::vector<double> lengths_mm;
        for (const offsets::ToolOffset& tool : stores.tools.tool)
            lengths_mm.push_back(tool.length_mm());
        path_.see_through(&transform, std::move(lengths_mm));
    }
    void dwell(double duration_s) override {
        if (machine_) machine_->dwell(duration_s);
        functions_.dwell(duration_s);
    }
    void m_code(int code) override {
        functions_.m_code(code, tool_in_spindle(*control_), running_line(*control_));
    }
    void printed(std::string_view text) {
        run_.printed += text;
        if (machine_) machine_->printed(text);
    }
    void watch(const controller::Control& control) {
        control_ = &control;
        const BlockLook look = look_at(control, state_);
        run_.reads_bare_words = run_.reads_bare_words || look.bare_words_meet_no_parameter;
        functions_.block(state_, look);
        keep_state(look);
        segments_before_ = run_.path.segments().size();
    }
    void finish() {
        run_.last_state = state_;
        functions_.finish();
        path_.finish();
    }

  private:
    void keep_state(const BlockLook& look) {
        if (run_.states.size() == 0 || !(state_ == kept_)) {
            const bool known = look.program != nullptr;
            const auto program = known ? run_.path.program_index(*look.program) : std::uint16_t{0};
            run_.states.append(
                {segments_before_, static_cast<std::uint32_t>(look.line), program, state_});
            kept_ = state_;
        }
        if (run_.rotaries.size() == 0 || look.rotary_deg != rotary_deg_)
            run_.rotaries.append({segments_before_, look.rotary_deg});
        rotary_deg_ = look.rotary_deg;
    }

    RecordedRun& run_;
    PathRecorder path_;
    BlockKeys keys_;
    FunctionRecorder functions_;
    std::optional<emulator::MachineSink> machine_;
    const controller::Control* control_ = nullptr;  ///< seen before the first block
    ControlSnapshot state_, kept_;
    std::array<double, 3> rotary_deg_{};
    std::uint64_t segments_before_ = 0;
};

std::vector<std::string> folders_of(const interpreter::ProgramText& program,
                                    const RecordOptions& options) {
    std::vector<std::string> folders = options.program_folders;
    const auto own = std::filesystem::path(program.name).parent_path();
    const std::string folder = own.empty() ? "." : own.string();
    if (std::filesystem::is_directory(folder)) folders.push_back(folder);
    return folders;
}

/// A main program in memory that calls the program to compare.
interpreter::ProgramText caller_of(const std::string& call) {
    const auto text = std::make_shared<const std::string>(call + "\nM30\n");
    return {"--call", *text, text};
}

}  // namespace

std::optional<positioning::RotaryTransform> believed_transform(const setup::Setup& setup) {
    std::vector<Axis> order;
    for (const controller::ControlAxis& axis : emulator::control_config(setup).axes)
        order.push_back(axis.axis);
    const auto pivot = offsets::decode_pivot(setup.stores.parameters, order);
    if (!pivot) return std::nullopt;
    return positioning::RotaryTransform(*pivot);
}

bool same_machine(const setup::Setup& a, const setup::Setup& b) {
    const auto &p = a.machine.chain.axes(), &q = b.machine.chain.axes();
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), [](const auto& x, const auto& y) {
        return x.axis == y.axis && x.direction == y.direction && x.point_mm == y.point_mm;
    });
}

constexpr std::size_t most_printed_bytes = 100'000'000;  ///< limit for an endless DPRNT

RecordedRun record_run(const setup::Setup& setup, const interpreter::ProgramText& program,
                       const RecordOptions& options, const setup::Setup* seen_through) {
    RecordedRun run;
    run.stores = setup.stores;
    RecordingSink sink(run, setup, options);
    const auto seen = seen_through != nullptr ? believed_transform(*seen_through) : std::nullopt;
    if (seen) sink.see_through(*seen, seen_through->stores);
    sink.tools_of(seen_through != nullptr ? *seen_through : setup);
    interpreter::ProgramFolders folders(folders_of(program, options));
    folders.add_file(program);
    RememberingSource programs(folders, run.opened);
    controller::ControlConfig config = emulator::control_config(setup);
    config.max_blocks = options.max_blocks;
    config.go_on = [&](std::uint64_t) {
        return run.printed.size() < most_printed_bytes && (!options.go_on || options.go_on());
    };
    controller::Controller controller(std::move(config), run.stores, programs, sink,
                                      [&sink](std::string_view text) { sink.printed(text); });
    for (const auto& [number, value] : setup.stores.variables)
        controller.set_variable(number, value);
    controller.watch([&sink](const controller::Control& control) { sink.watch(control); });
    run.result = controller.run(options.call.empty() ? program : caller_of(options.call));
    for (const int number : controller.used_common_variables())
        run.variables[number] = controller.variable(number);
    sink.finish();
    return run;
}

}  // namespace trunnion::regression

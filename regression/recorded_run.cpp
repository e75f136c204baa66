#include "regression/recorded_run.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include "interpreter/program_folders.h"
#include "emulator/run.h"
#include "base/units.h"
#include "positioning/rotary_transform.h"

namespace trunnion {

namespace {

/// Targets, modal state and M codes of each move as one number. Targets count to 0.0001 mm and deg:
/// finer than a control's increment, coarser than rounding.
class BlockKeys {
  public:
    explicit BlockKeys(KeyedLines& lines) : lines_(lines) {}

    void move(const AxisMove& m) {
        std::uint64_t h = mix(1, static_cast<std::uint64_t>(m.kind) | (m.until_skip ? 8U : 0U) |
                                     (m.gap_free ? 16U : 0U) | (m.coolant ? 32U : 0U) |
                                     (static_cast<std::uint64_t>(m.mode) << 8U));
        for (const Axis axis : all_axes)
            h = mix(h, grid(is_rotary(axis) ? deg_from_rad(m.to[axis]) : m.to[axis]));
        h = mix(h, grid(m.feed_mm_min));
        h = mix(h, grid(m.spindle_rpm));
        h = mix(h, static_cast<std::uint64_t>(m.tool) * 1000U +
                       static_cast<std::uint64_t>(m.tool_offset));
        if (m.arc) {
            for (int k = 0; k < 3; ++k) h = mix(h, grid(m.arc->centre_mm[k]));
            h = mix(h, grid(deg_from_rad(m.arc->sweep_rad)));
        }
        line_ = m.line;
        add(h);
    }
    void event(std::uint64_t kind, double value) { add(mix(kind, grid(value))); }

  private:
    void add(std::uint64_t key) { lines_.append({key, static_cast<std::uint32_t>(line_)}); }
    static std::uint64_t grid(double value) {
        return static_cast<std::uint64_t>(std::llround(value * 1e4));
    }
    static std::uint64_t mix(std::uint64_t h, std::uint64_t n) {
        h = (h ^ n) * 0xBF58476D1CE4E5B9ULL;
        return h ^ (h >> 29);
    }

    KeyedLines& lines_;
    int line_ = 0;
};

/// Writes the path and the block keys of one run at the same time.
class RecordingSink : public MotionSink {
  public:
    RecordingSink(RecordedRun& run, const RecordOptions& options)
        : path_(run.path, options.space, options.tolerances), keys_(run.blocks) {}
    MoveResult move(const AxisMove& move) override {
        keys_.move(move);
        return path_.move(move);
    }
    void see_through(const RotaryTransform& transform, const Stores& stores) {
        std::vector<double> lengths_mm;
        for (const ToolOffset& tool : stores.tools.tool) lengths_mm.push_back(tool.length_mm());
        path_.see_through(&transform, std::move(lengths_mm));
    }
    void dwell(double duration_s) override { keys_.event(2, duration_s); }
    void m_code(int code) override { keys_.event(3, code); }

  private:
    PathRecorder path_;
    BlockKeys keys_;
};

std::optional<RotaryTransform> transform_of(const Setup& setup) {
    std::vector<Axis> order;
    for (const ControlAxis& axis : control_config(setup).axes) order.push_back(axis.axis);
    const auto pivot = decode_pivot(setup.stores.parameters, order);
    if (!pivot) return std::nullopt;
    return RotaryTransform(*pivot);
}

std::vector<std::string> folders_of(const ProgramText& program, const RecordOptions& options) {
    std::vector<std::string> folders = options.program_folders;
    const auto own = std::filesystem::path(program.name).parent_path();
    const std::string folder = own.empty() ? "." : own.string();
    if (std::filesystem::is_directory(folder)) folders.push_back(folder);
    return folders;
}

}  // namespace

RecordedRun record_run(const Setup& setup, const ProgramText& program, const RecordOptions& options,
                       const Setup* seen_through) {
    RecordedRun run;
    run.stores = setup.stores;
    RecordingSink sink(run, options);
    const auto seen = seen_through != nullptr ? transform_of(*seen_through) : std::nullopt;
    if (seen) sink.see_through(*seen, seen_through->stores);
    ProgramFolders programs(folders_of(program, options));
    programs.add_file(program);
    ControlConfig config = control_config(setup);
    config.max_blocks = options.max_blocks;
    Controller controller(std::move(config), run.stores, programs, sink,
                          [&run](std::string_view text) { run.printed += text; });
    for (const auto& [number, value] : setup.stores.variables)
        controller.set_variable(number, value);
    run.result = controller.run(program);
    for (const int number : controller.used_common_variables())
        run.variables[number] = controller.variable(number);
    run.path.finish();
    return run;
}

}  // namespace trunnion

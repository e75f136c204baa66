#include "regression/compare_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "interpreter/program_folders.h"
#include "regression/describe.h"
#include "regression/effects_layer.h"

namespace trunnion {

namespace {

class ProgramComparer {
  public:
    ProgramComparer(const ProgramText& a, const Setup& setup_a, const ProgramText& b,
                    const Setup& setup_b, const CompareOptions& options)
        : a_(a),
          b_(b),
          setup_a_(setup_a),
          setup_b_(setup_b),
          options_(options),
          lines_a_(a),
          lines_b_(b) {
        result_.a = a.name;
        result_.b = b.name;
        result_.setup = setup_a.path;
        result_.setup_b = setup_b.path;
    }

    Comparison run() {
        if (options_.by)
            by_layer(*options_.by);
        else if (&setup_a_ == &setup_b_)
            by_layer(Layer::text) || by_layer(Layer::words) || by_what_runs();
        else
            by_layer(Layer::path);
        finish();
        return std::move(result_);
    }

    /// A golden in the place of A: only its path is known.
    Comparison run_against(const PathRecord& golden) {
        result_.by = Layer::path;
        run_b_.emplace(record_run(
            setup_b_, b_,
            {PathSpace::tip, options_.tolerances, options_.program_folders, options_.max_blocks}));
        describe(golden, run_b_->path, PathSpace::tip);
        result_.layers.push_back({Layer::path, result_.differences.empty()});
        finish();
        return std::move(result_);
    }

  private:
    /// Compares by one layer, which replaces what an earlier one found; true when it decides.
    bool by_layer(Layer layer) {
        result_.by = layer;
        equal_so_far_ = true;
        result_.differences.clear();
        result_.differences_left_out = 0;
        result_.compared = 0;
        result_.notes.clear();
        switch (layer) {
            case Layer::text:
                written(*text_keys(a_.text), *text_keys(b_.text));
                break;
            case Layer::words:
                written(*word_keys(a_.text, setup_a_.dialect),
                        *word_keys(b_.text, setup_b_.dialect));
                break;
            case Layer::blocks:
                record(PathSpace::tip);
                gaps(run_a_->blocks, run_b_->blocks);
                break;
            case Layer::path:
                paths(PathSpace::tip);
                break;
            case Layer::axes:
                paths(PathSpace::joints);
                compare_times(*run_a_, *run_b_, options_.tolerances, result_);
                break;
            case Layer::effects:
                record(PathSpace::tip);
                compare_effects(*run_a_, *run_b_, options_.tolerances, result_);
                break;
        }
        const bool equal = equal_so_far_ && result_.differences.empty();
        result_.layers.push_back({layer, equal});
        return equal || stopped();
    }

    /// A deeper layer will say what differs, so these only have to say that something does.
    bool only_verdict() const { return !options_.by; }

    void written(LineKeys& a, LineKeys& b) {
        if (only_verdict())
            equal_so_far_ = same_keys(a, b, result_.compared);
        else
            gaps(all_keys(a), all_keys(b));
    }

    void gaps(const KeyedLines& a, const KeyedLines& b) {
        if (only_verdict())
            equal_so_far_ = same_keys(a, b, result_.compared);
        else
            describe_gaps(a, b, lines_a_, lines_b_, options_.most_differences, result_);
    }

    void paths(PathSpace space) {
        record(space);
        describe(run_a_->path, run_b_->path, space);
    }

    void describe(const PathRecord& a, const PathRecord& b, PathSpace space) {
        WalkOptions walk;
        walk.tolerances = options_.tolerances;
        walk.other_machine = &setup_a_ != &setup_b_ && !one_machine();
        const PathComparison found = compare_paths(a, b, walk, options_.most_differences);
        describe_paths(found, a, b, space, lines_a_, lines_b_, options_.tolerances, result_);
    }

    void record(PathSpace space) {
        if (run_a_ && space == space_) return;
        space_ = space;
        const RecordOptions record{space, options_.tolerances, options_.program_folders,
                                   options_.max_blocks};
        run_a_.reset();
        run_b_.reset();
        run_a_.emplace(record_run(setup_a_, a_, record));
        run_b_.emplace(record_run(setup_b_, b_, record, one_machine() ? &setup_a_ : nullptr));
    }

    /// Two states of the stores of one machine: both are seen through A's.
    bool one_machine() const {
        const auto &p = setup_a_.machine.chain.axes(), &q = setup_b_.machine.chain.axes();
        if (&setup_a_ == &setup_b_ || p.size() != q.size()) return false;
        return std::equal(p.begin(), p.end(), q.begin(), [](const auto& a, const auto& b) {
            return a.axis == b.axis && a.direction == b.direction && a.point_mm == b.point_mm;
        });
    }

    /// An alarm or a limit: no deeper layer can say more.
    bool stopped() const {
        return run_a_ &&
               (run_a_->result.status != RunStatus::ok || run_b_->result.status != RunStatus::ok) &&
               result_.by == Layer::path;
    }

    /// Programs that move nothing are what they leave behind.
    bool by_what_runs() {
        record(PathSpace::tip);
        if (run_a_->path.size() == 0 && run_b_->path.size() == 0) return by_layer(Layer::effects);
        return by_layer(Layer::blocks) || by_layer(Layer::path);
    }

    void finish() {
        result_.status =
            result_.differences.empty() ? CompareStatus::equal : CompareStatus::differs;
        if (run_b_) {
            result_.time_b_s = run_b_->result.time_s;
            take_end(run_b_->result, result_.alarm_b, "B", lines_b_);
        }
        if (run_a_) {
            result_.time_a_s = run_a_->result.time_s;
            take_end(run_a_->result, result_.alarm_a, "A", lines_a_);
        }
        result_.equal = result_.status == CompareStatus::equal;
        result_.verdict = verdict();
        add_fingerprints(result_);
    }

    void take_end(const RunResult& run, std::string& alarm, const char* side, SourceLines& lines) {
        if (run.status == RunStatus::limit && result_.status != CompareStatus::alarm)
            result_.status = CompareStatus::limit;
        if (run.status != RunStatus::alarm || !run.alarm) return;
        result_.status = CompareStatus::alarm;
        alarm = fmt::format("{} {}", run.alarm->number, run.alarm->text);
        Difference d;
        d.kind = DifferenceKind::alarm;
        d.what =
            fmt::format("{} stops with alarm {} at line {}", side, alarm, run.alarm->where.line);
        ComparePlace& place = side[0] == 'A' ? d.a : d.b;
        place.program =
            run.alarm->where.program.empty() ? lines.main_name() : run.alarm->where.program;
        place.line = place.last_line = run.alarm->where.line;
        (side[0] == 'A' ? d.b : d.a).program = side[0] == 'A' ? result_.b : result_.a;
        lines.show(place);
        if (place.block.empty()) place.block = run.alarm->block;
        result_.differences.insert(result_.differences.begin(), std::move(d));
    }

    std::string verdict() const {
        if (result_.status == CompareStatus::alarm) return "alarm: " + result_.differences[0].what;
        if (result_.status == CompareStatus::limit)
            return "limit: a program was not run to its end";
        if (result_.equal) return equal_verdict();
        const std::uint64_t count = result_.differences.size() + result_.differences_left_out;
        const std::size_t gravest = gravest_difference(result_);
        std::string text = fmt::format("differs by {}: ", name_of(result_.by));
        if (count > 1) text += fmt::format("{} differences, the gravest: ", count);
        text += with_place(result_.differences[gravest]);
        if (gravest > 0) text += ", the first: " + with_place(result_.differences.front());
        return text + longer_cut();
    }

    static std::string with_place(const Difference& d) {
        if (d.b.line == 0) return d.what;
        return fmt::format("{} at A line {}, B line {}", d.what, d.a.line, d.b.line);
    }

    /// How much more or less is cut, when that is more than rounding.
    std::string longer_cut() const {
        double cut_a = 0.0, cut_b = 0.0;
        for (const ToolRow& row : result_.tools) {
            cut_a += row.cut_a_mm;
            cut_b += row.cut_b_mm;
        }
        if (std::abs(cut_b - cut_a) < std::max(0.1, 1e-4 * cut_a)) return {};
        return fmt::format("; cut {:.3f} -> {:.3f} mm", cut_a, cut_b);
    }

    std::string equal_verdict() const {
        static constexpr std::array<const char*, 6> same{
            "the same text",      "the same words",       "the same blocks",
            "the same machining", "the same axis motion", "the same effects"};
        std::string text = fmt::format("equal by {}: {}", name_of(result_.by),
                                       same[static_cast<std::size_t>(result_.by)]);
        if (result_.by == Layer::path || result_.by == Layer::axes)
            text += fmt::format(" within {:g} mm and {:g} deg", options_.tolerances.position_mm,
                                deg_from_rad(options_.tolerances.direction_rad));
        if (result_.layers.size() > 1)
            text += fmt::format("; first to differ: {}", name_of(result_.layers.front().layer));
        return text;
    }

    const ProgramText &a_, &b_;
    const Setup &setup_a_, &setup_b_;
    CompareOptions options_;
    SourceLines lines_a_, lines_b_;
    PathSpace space_ = PathSpace::tip;
    std::optional<RecordedRun> run_a_, run_b_;
    bool equal_so_far_ = true;  ///< of the layer at hand, where it keeps no differences
    Comparison result_;
};

}  // namespace

Comparison compare_with_golden(const PathRecord& golden, const std::string& golden_path,
                               const ProgramText& program, const Setup& setup,
                               const CompareOptions& options) {
    ProgramText golden_text = read_program(golden_path);
    return ProgramComparer(golden_text, setup, program, setup, options).run_against(golden);
}

Comparison compare_programs(const ProgramText& a, const Setup& setup_a, const ProgramText& b,
                            const Setup& setup_b, const CompareOptions& options) {
    return ProgramComparer(a, setup_a, b, setup_b, options).run();
}

}  // namespace trunnion

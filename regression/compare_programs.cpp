#include "regression/compare_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "regression/causes.h"
#include "regression/describe.h"
#include "regression/effects_layer.h"
#include "regression/function_compare.h"
#include "regression/left_aside.h"
#include "regression/run_notes.h"
#include "regression/verdict.h"
#include "regression/written_layers.h"

namespace trunnion::regression {
namespace {

class ProgramComparer {
  public:
    ProgramComparer(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                    const interpreter::ProgramText& b, const setup::Setup& setup_b,
                    const CompareOptions& options)
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
            by_path();
        finish();
        return std::move(result_);
    }

    /// A golden in place of A: only its path is known.
    Comparison run_against(const PathRecord& golden) {
        result_.by = Layer::path;
        run_b_.emplace(record_run(setup_b_, b_,
                                  {PathSpace::tip, options_.tolerances, options_.program_folders,
                                   options_.max_blocks, "", options_.devices, options_.go_on}));
        describe(golden, run_b_->path, PathSpace::tip);
        result_.layers.push_back({Layer::path, result_.differences.empty()});
        finish();
        return std::move(result_);
    }

  private:
    /// Replaces the result of an earlier layer; true when this layer decides.
    bool by_layer(Layer layer) {
        result_.by = layer;
        equal_so_far_ = true;
        result_.differences.clear();
        result_.differences_left_out = 0;
        result_.compared = 0;
        result_.notes.clear();
        left_.clear();
        switch (layer) {
            case Layer::text:
            case Layer::words: written(layer); break;
            case Layer::blocks:
                record(PathSpace::tip);
                moves(run_a_->blocks, run_b_->blocks);
                break;
            case Layer::path: paths(PathSpace::tip); break;
            case Layer::functions: functions(false); break;
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

    /// A deeper layer describes the differences, so these layers only have to detect one.
    bool only_verdict() const { return !options_.by; }
    void written(Layer layer) {
        const WrittenSide a = written_side(a_, setup_a_, run_a_),
                          b = written_side(b_, setup_b_, run_b_);
        if (only_verdict())
            equal_so_far_ = written_alike(layer, a, b, result_.compared);
        else
            describe_written(layer, a, b, options_.most_differences, result_);
    }

    /// A program that may call others must be compared together with them; only a run shows which.
    WrittenSide written_side(const interpreter::ProgramText& program, const setup::Setup& setup,
                             const std::optional<RecordedRun>& run) {
        const bool calls =
            !options_.call.empty() || may_call(a_.text, setup_a_) || may_call(b_.text, setup_b_);
        if (!calls) return {&program, nullptr, &setup};
        record(PathSpace::tip);
        return {&program, &run->opened, &setup};
    }

    void moves(const KeyedLines& a, const KeyedLines& b) {
        if (only_verdict()) return void(equal_so_far_ = same_keys(a, b, result_.compared));
        describe_gaps({a, lines_a_}, {b, lines_b_}, options_.most_differences, result_);
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
        describe_paths(found, explained(found, space),
                       {{a, lines_a_}, {b, lines_b_}, space, options_.tolerances}, result_);
        if (result_.differences.empty() || !run_a_ || !one_control()) return;
        add_hint(frame_hint(*run_a_, "A"));
        add_hint(frame_hint(*run_b_, "B"));
    }

    void add_hint(std::string hint) {
        if (!hint.empty()) result_.notes.push_back(std::move(hint));
    }

    /// States of different machines differ anyway, and a golden has none.
    std::vector<ExplainedCluster> explained(const PathComparison& found, PathSpace space) {
        if (run_a_ && one_control() && space == PathSpace::tip)
            return explain(found.clusters,
                           {*run_a_, *run_b_, written_gaps(), transform(), options_.tolerances});
        std::vector<ExplainedCluster> plain;
        for (const PathCluster& cluster : found.clusters) plain.push_back({cluster});
        return plain;
    }

    WrittenGaps& written_gaps() {
        if (!gaps_) gaps_.emplace(a_, setup_a_, b_, setup_b_);
        return *gaps_;
    }
    const std::optional<positioning::RotaryTransform>& transform() {
        // With two stores of one machine the shifts are known to come from them.
        if (!transform_ && &setup_a_ == &setup_b_) transform_ = believed_transform(setup_a_);
        return transform_;
    }

    void record(PathSpace space) {
        if (run_a_ && space == space_) return;
        space_ = space;
        RecordOptions record{
            space,         options_.tolerances, options_.program_folders, options_.max_blocks,
            options_.call, options_.devices};
        record.go_on = options_.go_on;
        run_a_.reset();
        run_b_.reset();
        run_a_.emplace(record_run(setup_a_, a_, record));
        run_b_.emplace(record_run(setup_b_, b_, record, one_machine() ? &setup_a_ : nullptr));
    }

    /// Two states of the stores of one machine: both are seen through A's.
    bool one_machine() const { return &setup_a_ != &setup_b_ && same_machine(setup_a_, setup_b_); }

    /// An alarm or a limit: no deeper layer adds information.
    bool stopped() const { return run_a_ && !ran_to_the_end() && result_.by == Layer::path; }
    bool ran_to_the_end() const {
        return run_a_->result.status == controller::RunStatus::ok &&
               run_b_->result.status == controller::RunStatus::ok;
    }

    bool by_what_runs() {
        record(PathSpace::tip);
        if (same_alarm()) return by_words_before_alarm();
        const bool moves = run_a_->path.size() > 0 || run_b_->path.size() > 0;
        const bool equal = !moves                    ? by_layer(Layer::effects) && by_functions()
                           : by_layer(Layer::blocks) ? by_functions()
                                                     : by_path();
        if (equal) as_increments();
        return equal;
    }

    /// Path and functions together are the machining.
    bool by_path() {
        const bool equal = by_layer(Layer::path);
        if (ran_to_the_end() && equal) return by_functions();
        if (ran_to_the_end() && one_control()) functions(false);
        if (!ran_to_the_end() || !one_control())
            left_.emplace_back("M codes, dwells and modes (another machine, or a program stopped)");
        return false;
    }

    bool one_control() const { return &setup_a_ == &setup_b_ || one_machine(); }

    /// Appends the layer `functions` to an equal layer before it.
    bool by_functions() {
        if (!one_control()) {
            left_.emplace_back("M codes, dwells and modes (another machine)");
            return true;
        }
        functions(true);
        const bool equal = result_.differences.empty();
        // The layer that found both equal remains the last one.
        const auto place = equal && !result_.layers.empty() ? std::prev(result_.layers.end())
                                                            : result_.layers.end();
        result_.layers.insert(place, {Layer::functions, equal});
        if (!equal) result_.by = Layer::functions;
        return equal;
    }

    void functions(bool places) {
        record(PathSpace::tip);
        const bool stores = &setup_a_ == &setup_b_ && run_a_->path.modes() == run_b_->path.modes();
        const bool same_writes = compare_functions(
            {*run_a_, lines_a_}, {*run_b_, lines_b_},
            {options_.tolerances, places, stores, options_.most_differences}, result_);
        const std::size_t before = result_.differences.size();
        compare_leftovers(*run_a_, *run_b_, stores && same_writes, options_.tolerances, result_);
        for (std::size_t k = before; k < result_.differences.size(); ++k)
            place_value(result_.differences[k]);
        if (!stores)
            left_.emplace_back(
                "stores that G10 writes (the sides position by other functions, or start from "
                "other stores)");
    }

    /// The first differently written block that writes stores or variables.
    void place_value(Difference& d) {
        const auto written = written_gaps().first_that_writes();
        if (!written || d.a.line > 0) return;
        d.cause = written->what;
        d.a.line = d.a.last_line = written->line_a;
        d.b.line = d.b.last_line = written->line_b;
        lines_a_.show(d.a);
        lines_b_.show(d.b);
    }

    /// Both stop with the same alarm: the part before it does not represent the rest.
    bool same_alarm() const {
        const auto &p = run_a_->result, &q = run_b_->result;
        return p.alarm && q.alarm && p.alarm->number == q.alarm->number;
    }

    bool by_words_before_alarm() {
        result_.by = Layer::words;
        describe_written(Layer::words, written_side(a_, setup_a_, run_a_),
                         written_side(b_, setup_b_, run_b_), options_.most_differences, result_);
        result_.notes.push_back(fmt::format(
            "both stop with alarm {} (A line {}, B line {}): a program that needs arguments is "
            "compared with --call \"G65 P.. ..\"",
            emulator::title_of(*run_a_->result.alarm), run_a_->result.alarm->where.line,
            run_b_->result.alarm->where.line));
        return true;
    }

    /// Parameter 3401 is not given, so numbers without point were taken as whole units. The
    /// programs are equal only if they are also equal with least increments.
    void as_increments() {
        if (!run_a_->reads_bare_words && !run_b_->reads_bare_words) return;
        setup::Setup setup = setup_a_;
        setup.stores.parameters.entry[3401] = {};
        for (RecordedRun* run : {&*run_a_, &*run_b_}) {  // their content was compared
            run->path = {};
            run->blocks = {};
        }
        const Comparison other =
            ProgramComparer(a_, setup, b_, setup, options_).run_as_increments();
        if (other.equal) return;
        Difference d = other.differences.front();
        d.kind = DifferenceKind::value;
        d.what =
            "numbers without a decimal point: equal only while they are whole units "
            "(parameter 3401 is not given); where they are least increments: " +
            d.what;
        result_.by = Layer::functions;
        result_.layers.push_back({Layer::functions, false});
        result_.differences.push_back(std::move(d));
    }

    Comparison run_as_increments() {
        record(PathSpace::tip);
        if (same_alarm()) return {};  // nobody runs them with this setting
        by_layer(Layer::path);
        finish();
        return std::move(result_);
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
        result_.verdict = verdict_of(result_, options_.tolerances);
        if (result_.by != Layer::text && result_.by != Layer::words)
            add_notes();
        else if (options_.by)
            result_.notes.emplace_back("not compared: what the programs do (--by)");
        add_fingerprints(result_);
    }

    void add_notes() {
        const RecordedRun* const a = run_a_ ? &*run_a_ : nullptr;
        for (std::string& note : notes_of(a, *run_b_)) result_.notes.push_back(std::move(note));
        if (a == nullptr) left_.emplace_back("M codes, dwells and modes (a golden has none)");
        const auto& first = a == nullptr ? b_ : a_;
        const std::string left = left_aside(a, *run_b_, {first, b_}, options_, left_);
        if (!left.empty()) result_.notes.push_back(left);
    }

    void take_end(const controller::RunResult& run, std::string& alarm, const char* side,
                  SourceLines& lines) {
        if (run.status == controller::RunStatus::limit && result_.status != CompareStatus::alarm)
            result_.status = CompareStatus::limit;
        if (run.status != controller::RunStatus::alarm) return;
        alarm = emulator::title_of(*run.alarm);
        if (result_.by == Layer::text || result_.by == Layer::words) return;
        result_.status = CompareStatus::alarm;
        Difference d;
        d.kind = DifferenceKind::alarm;
        d.what =
            fmt::format("{} stops with alarm {} at line {}", side, alarm, run.alarm->where.line);
        ComparePlace& place = side[0] == 'A' ? d.a : d.b;
        place.program =
            run.alarm->where.program.empty() ? lines.main_name() : run.alarm->where.program;
        place.line = place.last_line = run.alarm->where.line;
        (side[0] == 'A' ? d.b : d.a).program = side[0] == 'A' ? result_.b : result_.a;
        place_alarm(d, run, side[0] == 'A');
        lines.show(place);
        if (place.block.empty()) place.block = run.alarm->block;
        result_.differences.insert(result_.differences.begin(), std::move(d));
    }

    /// The block that caused an alarm of one side, as far as the words show it.
    void place_alarm(Difference& d, const controller::RunResult& run, bool side_is_a) {
        if (!run_a_ || (run_a_->result.alarm && run_b_->result.alarm)) return;
        const int line = run.alarm->where.line;
        const auto cause = written_gaps().before(side_is_a ? line : 0, side_is_a ? 0 : line);
        if (!cause || cause->what.empty()) return;
        d.cause = cause->what;
        d.what += "; " + cause->what;
        if ((side_is_a ? cause->line_a : cause->line_b) == line) return;
        d.a.line = d.a.last_line = cause->line_a;
        d.b.line = d.b.last_line = cause->line_b;
        d.a.program = lines_a_.main_name();
        d.b.program = lines_b_.main_name();
        (side_is_a ? lines_b_ : lines_a_).show(side_is_a ? d.b : d.a);
    }

    const interpreter::ProgramText &a_, &b_;
    const setup::Setup &setup_a_, &setup_b_;
    CompareOptions options_;
    SourceLines lines_a_, lines_b_;
    PathSpace space_ = PathSpace::tip;
    std::optional<RecordedRun> run_a_, run_b_;
    std::optional<WrittenGaps> gaps_;
    std::optional<positioning::RotaryTransform> transform_;
    std::vector<std::string> left_;  ///< what was not compared
    bool equal_so_far_ = true;       ///< of the current layer, if it keeps no differences
    Comparison result_;
};

}  // namespace

Comparison compare_with_golden(const PathRecord& golden, const std::string& golden_path,
                               const interpreter::ProgramText& program, const setup::Setup& setup,
                               const CompareOptions& options) {
    interpreter::ProgramText golden_text = interpreter::read_program(golden_path);
    return ProgramComparer(golden_text, setup, program, setup, options).run_against(golden);
}

Comparison compare_programs(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                            const interpreter::ProgramText& b, const setup::Setup& setup_b,
                            const CompareOptions& options) {
    return ProgramComparer(a, setup_a, b, setup_b, options).run();
}

}  // namespace trunnion::regression

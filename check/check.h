// Static findings on a program, without running it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "interpreter/block_words.h"
#include "interpreter/dialect.h"
#include "interpreter/evaluate.h"
#include "interpreter/program_source.h"

namespace trunnion::check {

/// A note is no fault of the program.
enum class Severity : unsigned char { error, warning, note };
const char* name_of(Severity severity);

struct Finding {
    std::string rule;  ///< one of check_rules()
    Severity severity = Severity::error;
    std::string path;
    int line = 0, column = 0;  ///< from 1
    std::string text;          ///< one line
    std::string remedy;
};

/// Errors and warnings.
std::size_t count_faults(const std::vector<Finding>& findings);

struct CheckRule {
    const char* name;
    const char* description;
};
const std::vector<CheckRule>& check_rules();

/// What a block does without an alarm and what is seldom meant.
struct Caution {
    std::string rule, text, remedy;
};

/// Executes the words of blocks in order, like a run.
class Trial {
  public:
    virtual ~Trial() = default;
    /// The alarm that stops the run at this block; empty if none.
    virtual std::optional<Alarm> run(const interpreter::BlockWords& block) = 0;
    /// The alarm found from the words alone, independent of earlier blocks; empty if none.
    virtual std::optional<Alarm> read(const interpreter::BlockWords& block) = 0;
    /// End of the program: executes what is still pending.
    virtual std::optional<Alarm> end() = 0;
    /// Sets a system variable like a run.
    virtual std::optional<Alarm> assign(int number, double value, const std::string& comment) = 0;
    /// Of the blocks since the last call.
    virtual std::vector<Caution> cautions() = 0;
    /// How expressions are evaluated in the present state.
    virtual interpreter::EvaluationRules rules() const = 0;
};

/// A trial by a class with the same functions that does not know this room: the control's
/// BlockTrial.
template <class Blocks>
class TrialBy final : public Trial {
  public:
    template <class... Parts>
    explicit TrialBy(const Parts&... parts) : blocks_(parts...) {}
    std::optional<Alarm> run(const interpreter::BlockWords& block) override {
        return blocks_.run(block);
    }
    std::optional<Alarm> read(const interpreter::BlockWords& block) override {
        return blocks_.read(block);
    }
    std::optional<Alarm> end() override { return blocks_.end(); }
    std::optional<Alarm> assign(int number, double value, const std::string& comment) override {
        return blocks_.assign(number, value, comment);
    }
    std::vector<Caution> cautions() override {
        std::vector<Caution> out;
        for (auto& told : blocks_.cautions())
            out.push_back({told.rule, std::move(told.text), told.remedy});
        return out;
    }
    interpreter::EvaluationRules rules() const override { return blocks_.rules(); }

  private:
    Blocks blocks_;
};

/// `open`: the end is not on the circle, and the control does not compare.
enum class ArcFit : unsigned char { good, open, refused };

struct CheckOptions {
    interpreter::Dialect dialect;
    /// True when the control has this G code (434 is G43.4). Empty: not checked.
    std::function<bool(int code10)> knows_g;
    /// True when the control has this M code. Empty: not checked.
    std::function<bool(int code)> knows_m;
    /// #4012 reads the work offset, not G66 and G67.
    bool work_offset_is_group_12 = false;
    /// Name of an option with this code that other controls have; empty: none.
    std::function<std::string(int code10)> missing_option;
    /// True for a G or M code (434 is G43.4) of the builder's profile. Empty: none is.
    std::function<bool(char letter, int code10)> builders_code;
    bool has_u_axis = true;  ///< false: U is no axis word of this machine
    /// True when program O`number` exists outside the file. Empty: not checked.
    std::function<bool(int o_number)> finds_program;
    /// True when the program `<name>` exists outside the file. Empty: unknown.
    std::function<bool(const std::string& name)> finds_named;
    /// True when this G or M code (434 is G43.4), or T with 0, calls a program. Empty: none does.
    std::function<bool(char letter, int code10)> calls_program;
    /// "PS0007 ILLEGAL USE OF DECIMAL POINT". Empty: only the number is shown.
    std::function<std::string(int alarm)> alarm_text;
    /// Alarm number for reading or writing variable #number from #1000 on; 0: none. Empty: not
    /// checked.
    std::function<int(int number, bool writes)> variable_alarm;
    /// Block skip: [1] is also the switch of '/'.
    std::vector<bool> skip_switches;
    /// A control that executes blocks one after another. Empty: not checked.
    std::function<std::unique_ptr<Trial>()> start_trial;
    bool arc_centres_are_places = false;  ///< BNC: I J K are positions, not distances from the
                                          ///< start
    bool bare_is_unit = true;             ///< X10 is 10 mm; false: ten least increments (3401#0)
    /// How an arc with these radii at start and end fits. Empty: not checked.
    std::function<ArcFit(double start_mm, double end_mm)> arc_fit;
    /// True when the control refuses an R arc with this chord. Empty: not checked.
    std::function<bool(double chord_mm, double radius_mm)> chord_exceeds;
};

/// All findings on one file, by line. Reports only what is certain: values that the program does
/// not set, positions after jumps and machine data are left to a run.
std::vector<Finding> check_program(const interpreter::ProgramText& program,
                                   const CheckOptions& options);

/// True when the first program of the text is for a lathe or a Haas by these findings.
bool begins_foreign(std::string_view text, const std::vector<Finding>& findings);

}  // namespace trunnion::check

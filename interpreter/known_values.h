// Evaluates expressions of a program that is read without being run: as far as they are known.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <span>

#include "interpreter/evaluate.h"

namespace trunnion::interpreter {

/// The local and common variables that are known at a place of a program, and what follows from
/// them. It has the same evaluator as a run, so the same alarms; those that a run raises whatever
/// the unknown variables hold are raised here, too.
class KnownValues {
  public:
    /// Alarm number of reading system variable #number; 0: none.
    using SystemAlarm = std::function<int(int number)>;

    explicit KnownValues(bool has_98000, SystemAlarm system_alarm = {});
    KnownValues(const KnownValues&) = delete;
    KnownValues& operator=(const KnownValues&) = delete;

    /// The value; empty when it depends on something unknown. Throws Alarm with the column.
    std::optional<double> value(std::span<const Op> code) const;
    /// Number of the variable that an assignment sets; empty when unknown. Throws Alarm.
    std::optional<int> target(std::span<const Op> code, int column) const;
    /// Sets a local or common variable, or makes it unknown. Alarms 115 and 116.
    void set(int number, std::optional<double> value);
    /// Local and common variables are kept here, system variables are not.
    bool owns(int number) const;

    /// Empty: results that depend on parameters or on the increment system are unknown.
    std::optional<EvaluationRules> rules;

  private:
    struct Part;
    Part joined(std::span<const Op> code, std::span<const Part> operands, std::uint32_t at) const;
    bool knows(int number, int column) const;
    double evaluated(std::span<const Op> code) const;
    void refuse_zero_divisor(std::span<const Op> divisor, const Op& op) const;

    /// The system variables have no values here.
    struct NoSystem final : SystemVariables {
        double get(int) override { return 0.0; }
        void set(int, double, const char*) override {}
        double parameter(int, int, int) override { return 0.0; }
    };
    NoSystem system_;
    SystemAlarm system_alarm_;
    Locals locals_;
    Memory memory_;
    std::set<int> known_;
};

}  // namespace trunnion::interpreter

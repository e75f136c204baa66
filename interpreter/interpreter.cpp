#include "interpreter/interpreter.h"

#include "interpreter/alarms.h"
#include "interpreter/runner.h"

namespace trunnion::interpreter {

Interpreter::Interpreter(ProgramSource& source, InterpreterOptions options, SystemVariables& system,
                         Print print)
    : state_(std::make_unique<State>(source, std::move(options), system, std::move(print))) {}
Interpreter::~Interpreter() = default;
Interpreter::Interpreter(Interpreter&&) noexcept = default;

void Interpreter::open(const ProgramText& program) {
    state_->start(state_->files.open(program));
}

void Interpreter::open(int o_number) {
    Section* section = state_->files.find(o_number, nullptr);
    if (!section) raise_language_alarm(76, 0, "O" + std::to_string(o_number));
    state_->start(*section);
}

const BlockWords* Interpreter::next() {
    try {
        return state_->step();
    } catch (Alarm& alarm) {
        state_->ended = true;
        if (alarm.where.line == 0) {
            const int column = alarm.where.column;
            alarm.where = where();
            if (column > 0) alarm.where.column = column;
        }
        if (alarm.block.empty()) alarm.block = block_text();
        throw;
    }
}

void Interpreter::block_moved() {
    state_->moved = state_->modal_count > 0;
}
void Interpreter::end_program() {
    state_->ended = true;
}

double Interpreter::variable(int number) const {
    return state_->memory.get(number);
}
void Interpreter::set_variable(int number, double value) {
    state_->memory.set(number, value);
}

std::vector<int> Interpreter::used_common_variables() const {
    std::vector<int> used;
    for (int slot = 0; slot < common_count; ++slot)
        if (!is_vacant(state_->memory.common[static_cast<std::size_t>(slot)]))
            used.push_back(common_number(slot));
    return used;
}

SourceRef Interpreter::where() const {
    if (state_->frames.empty()) return {};
    const Section& section = *state_->frames.back().section;
    std::string name = section.file->text.name;
    if (name.empty()) name = "O" + std::to_string(section.o_number);
    return {std::move(name), state_->current.line, 1};
}

const std::string& Interpreter::program_name() const {
    static const std::string none;
    return state_->frames.empty() ? none : state_->frames.back().section->file->text.name;
}

std::string Interpreter::block_text() const {
    if (state_->frames.empty()) return {};
    const std::string_view text = state_->text();
    const char* const first =
        text.data() + std::min<std::size_t>(state_->current.byte, text.size());
    const char* const end = find_line_end(first, text.data() + text.size());
    constexpr std::ptrdiff_t longest = 4096;  // maximum length for display
    return {first, first + std::min(longest, end - first)};
}

int Interpreter::program_number() const {
    return state_->frames.empty() ? 0 : state_->frames.back().section->o_number;
}
int Interpreter::sequence_number() const {
    return state_->sequence_number;
}
std::uint64_t Interpreter::blocks_executed() const {
    return state_->executed;
}
void Interpreter::set_increment_digits(int digits) {
    state_->options.increment_digits = digits;
    state_->rules.increments_per_unit = powers_of_ten[static_cast<std::size_t>(digits)];
}
bool Interpreter::limit_reached() const {
    return state_->limit;
}
MainEnd Interpreter::main_end() const {
    return state_->main_end;
}

}  // namespace trunnion::interpreter

#include "controller/word_sorting.h"

#include <bit>
#include <cmath>

#include "controller/alarms.h"
#include "controller/hurco_codes.h"
#include "controller/missing_codes.h"
#include "interpreter/word_rules.h"

namespace trunnion::controller {

namespace {

/// Addresses allowed in a block besides axes: all but E, N, O.
constexpr std::uint32_t known_letters =
    0x3FFFFFFU & ~(SortedWords::bit('E') | SortedWords::bit('N') | SortedWords::bit('O'));

/// U V W of a Hurco's G68.2: the Y direction of the plane.
constexpr std::uint32_t plane_vector_letters =
    SortedWords::bit('U') | SortedWords::bit('V') | SortedWords::bit('W');

/// One-shot codes that use the words of the block: of G53 and G31, say, only one can.
bool uses_words(const GCode& code) {
    return code.phase == Phase::shot && code.action != Action::accepted;
}

/// True when a block executes only the later one of the two.
bool exclude_each_other(const GCode& a, const GCode& b) {
    return a.group == b.group &&
           (a.group != ModalGroup::one_shot || (uses_words(a) && uses_words(b)));
}

void add_code(SortedWords& w, const ControlSettings& settings, const GCode* code,
              std::uint16_t column) {
    w.phases |= phase_bit(code->phase);
    for (std::size_t i = 0; i < w.code_count; ++i) {
        if (!exclude_each_other(*w.code[i], *code)) continue;
        if (settings.duplicates_alarm) raise_alarm(5074, column);
        w.code[i] = code;
        w.code_column[i] = column;
        return;
    }
    if (w.code_count == SortedWords::max_codes) raise_alarm(10, column);
    w.code_column[w.code_count] = column;
    w.code[w.code_count++] = code;
}

void drop_cycle(SortedWords& w) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < w.code_count; ++i) {
        if (w.code[i]->phase == Phase::cycle) continue;
        w.code_column[kept] = w.code_column[i];
        w.code[kept++] = w.code[i];
    }
    w.code_count = kept;
}

[[noreturn]] void refuse_g(const ControlSettings& settings, const interpreter::WordValue& word) {
    const double tenfold = word.value * 10.0;
    const bool small = tenfold >= 0.0 && tenfold < 1e4;
    const char* option = settings.is_hurco() || !small
                             ? nullptr
                             : missing_option(static_cast<int>(std::lround(tenfold)));
    if (!option) raise_alarm(10, word.column);
    refuse_option(option, word.column);
}

void add_g(SortedWords& w, const ControlSettings& settings, const interpreter::WordValue& word) {
    const GCode* code = find_g_code(word.value, settings);
    if (!code) refuse_g(settings, word);
    if (code->phase != Phase::motion) return add_code(w, settings, code, word.column);
    if (w.motion && settings.duplicates_alarm) raise_alarm(5074, word.column);
    drop_cycle(w);  // G81 G0: the cycle is not executed
    w.motion = code;
    w.motion_column = word.column;
}

void add_m(SortedWords& w, const interpreter::WordValue& word) {
    if (w.m_count == SortedWords::max_m_codes) raise_alarm(9, word.column);
    if (const auto fault = interpreter::find_m_fault(word))
        raise_alarm(fault->alarm, fault->column);
    w.m_column[w.m_count] = word.column;
    w.m[w.m_count++] = static_cast<int>(word.value + 0.5);
}

/// The control may round the value of a variable to the least input increment of the address;
/// digits of the program stay as they are.
double value_in(const Modal& modal, const interpreter::WordValue& word) {
    const double steps = modal.steps_per_unit[static_cast<std::size_t>(word.letter - 'A')];
    return word.computed && steps > 0.0 ? std::round(word.value * steps) / steps : word.value;
}

void add_letter(SortedWords& w, const Modal& modal, const interpreter::WordValue& word) {
    const std::uint32_t bit = SortedWords::bit(word.letter);
    if (word.letter == 'Z' && (w.present & bit) && modal.settings.is_hurco()) {
        if (w.more_depth_count == w.more_depths.size()) raise_alarm(9, word.column);
        w.more_depths[w.more_depth_count++] = value_in(modal, word);
        return;
    }
    if ((w.present & bit) && modal.settings.duplicates_alarm) raise_alarm(5074, word.column);
    const auto i = static_cast<std::size_t>(word.letter - 'A');
    const double largest = word.decimal_point ? modal.largest[i] : modal.largest_bare[i];
    if (std::abs(word.value) > largest) raise_alarm(3, word.column);
    w.present |= bit;
    w.value[i] = value_in(modal, word);
    w.column[i] = word.column;
    w.bare = word.decimal_point ? w.bare & ~bit : w.bare | bit;
}

void add_corner(SortedWords& w, const interpreter::WordValue& word) {
    w.corner = word.value * (word.decimal_point ? w.units.unit_mm : w.units.bare_linear);
    (word.letter == 'r' ? w.corner_radius : w.corner_chamfer) = true;
}

}  // namespace

void sort_words(const interpreter::BlockWords& block, const Modal& modal, SortedWords& words) {
    words.clear();
    words.units = modal.units;
    for (const interpreter::WordValue& word : block) {
        if (word.vacant) continue;
        switch (word.letter) {
            case 'G': add_g(words, modal.settings, word); break;
            case 'M': add_m(words, word); break;
            case 'r':
            case 'c': add_corner(words, word); break;
            default: add_letter(words, modal, word);
        }
    }
    if (words.more_depth_count != 0 && !modal.in_cycle() &&
        !(words.phases & phase_bit(Phase::cycle)))
        raise_alarm(9, words.column_of('Z'));
    std::uint32_t allowed =
        (known_letters & ~SortedWords::axis_letters) | modal.settings.axis_letters;
    if (modal.settings.is_hurco() && (words.has_code(682) || words.has_code(683)))
        allowed |= plane_vector_letters;
    if (const std::uint32_t strange = words.present & ~allowed)
        raise_alarm(9, words.column[static_cast<std::size_t>(std::countr_zero(strange))]);
    constexpr std::uint32_t ruled = SortedWords::bit('T') | SortedWords::bit('H') |
                                    SortedWords::bit('D') | SortedWords::bit('S');
    if (words.code_count == 0 && !(words.present & ruled)) return;
    const auto fault = interpreter::find_word_fault(block, modal.settings.family);
    if (!fault) return;
    if (fault->detail.empty()) raise_alarm(fault->alarm, fault->column);
    raise_alarm(fault->alarm, fault->detail, fault->column);
}

}  // namespace trunnion::controller
